#include "core/tonemap/filters/grid_layout.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace plenolab {
namespace {

/// The bins that the pixels of a square between four cells use in one layer.
struct UsedLayer {
  int layer = 0, begin = 0, end = 0;
};

using Square = std::vector<UsedLayer>;

std::vector<GridCoordinate> coordinates(int pixels, double samples_per_px) {
  std::vector<GridCoordinate> result;
  for (int i = 0; i < pixels; ++i) {
    const double u = i * samples_per_px;
    const int index = static_cast<int>(u);
    result.push_back({index, static_cast<float>(u - index)});
  }
  return result;
}

/// Adds one pixel; `last` remembers where the previous pixel went, mostly the same.
void note(Square& square, std::size_t& last, int layer, int bin) {
  if (last >= square.size() || square[last].layer != layer) {
    const auto found =
        std::find_if(square.begin(), square.end(), [&](const UsedLayer& u) { return u.layer == layer; });
    last = static_cast<std::size_t>(found - square.begin());
    if (found == square.end()) square.push_back({layer, bin, bin + 2});
  }
  square[last].begin = std::min(square[last].begin, bin);
  square[last].end = std::max(square[last].end, bin + 2);
}

/// The squares right of and below the cells of one row of cells.
void note_squares(const BilateralInput& input, const GridAxes& axes, int row, std::span<Square> squares) {
  std::vector<std::size_t> last(squares.size(), 0);
  const PixelRows pixels = pixel_rows(axes, row);
  for (int y = pixels.begin; y < pixels.end; ++y)
    for (int x = 0; x < input.width(); ++x) {
      const auto column = static_cast<std::size_t>(axes.column_of[static_cast<std::size_t>(x)].index);
      const int bin = axes.bins.at(input.range.at(x, y)).index;
      if (!input.depth) {
        note(squares[column], last[column], 0, bin);
        continue;
      }
      const GridCoordinate layer = axes.layers.at(input.depth->disparity->at(x, y));
      note(squares[column], last[column], layer.index, bin);
      if (layer.fraction > 0) note(squares[column], last[column], layer.index + 1, bin);
    }
}

/// The blocks of a cell: the union of the squares around it.
void append_blocks(std::vector<UsedLayer>& used, GridLayout& layout) {
  std::sort(used.begin(), used.end(),
            [](const UsedLayer& a, const UsedLayer& b) { return a.layer < b.layer; });
  const std::size_t first = layout.blocks.size();
  for (const UsedLayer& u : used) {
    const int begin = u.begin / kBinGroup * kBinGroup, end = (u.end + kBinGroup - 1) / kBinGroup * kBinGroup;
    if (layout.blocks.size() > first && layout.blocks.back().layer == u.layer) {
      layout.blocks.back().begin = std::min(layout.blocks.back().begin, begin);
      layout.blocks.back().end = std::max(layout.blocks.back().end, end);
    } else {
      layout.blocks.push_back({u.layer, begin, end});
    }
  }
  for (std::size_t i = first; i < layout.blocks.size(); ++i) {
    GridBlock& block = layout.blocks[i];
    block.offset = layout.floats;
    layout.floats += static_cast<std::size_t>(block.end - block.begin) * kBinFloats;
  }
}

}  // namespace

PixelRows pixel_rows(const GridAxes& axes, int row) {
  const auto before = [](const GridCoordinate& c, int r) { return c.index < r; };
  const auto begin = std::lower_bound(axes.row_of.begin(), axes.row_of.end(), row, before);
  const auto end = std::lower_bound(begin, axes.row_of.end(), row + 1, before);
  return {static_cast<int>(begin - axes.row_of.begin()), static_cast<int>(end - axes.row_of.begin())};
}

GridAxes make_axes(const BilateralInput& input, const GridSampling& sampling) {
  GridAxes axes;
  const double per_px = sampling.per_sigma_s / input.options.sigma_s_px;
  axes.column_of = coordinates(input.width(), per_px);
  axes.row_of = coordinates(input.height(), per_px);
  axes.columns = axes.column_of.back().index + 2;
  axes.rows = axes.row_of.back().index + 2;
  axes.bins = {input.range_bounds.min,
               static_cast<float>(sampling.per_sigma_value / input.options.sigma_value)};
  if (input.depth)
    axes.layers = {input.disparity_bounds.min,
                   static_cast<float>(sampling.per_sigma_d / input.depth->sigma_d_px)};
  return axes;
}

GridLayout make_layout(const BilateralInput& input, const GridAxes& axes) {
  const auto columns = static_cast<std::size_t>(axes.columns), rows = static_cast<std::size_t>(axes.rows);
  std::vector<Square> squares(columns *
                              rows);  // those right of the last column and below the last row stay empty
  parallel_for(axes.rows, 1, input.threads, [&](int begin, int end) {
    for (int row = begin; row < end; ++row)
      note_squares(input, axes, row,
                   std::span(squares).subspan(static_cast<std::size_t>(row) * columns, columns));
  });
  GridLayout layout{.columns = axes.columns, .rows = axes.rows};
  std::vector<UsedLayer> used;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      layout.first.push_back(layout.blocks.size());
      used.clear();
      for (std::size_t y = row - std::min<std::size_t>(row, 1); y <= row; ++y)
        for (std::size_t x = column - std::min<std::size_t>(column, 1); x <= column; ++x)
          used.insert(used.end(), squares[y * columns + x].begin(), squares[y * columns + x].end());
      append_blocks(used, layout);
    }
  layout.first.push_back(layout.blocks.size());
  return layout;
}

const GridBlock* find_block(std::span<const GridBlock> cell, int layer) {
  const auto found = std::lower_bound(cell.begin(), cell.end(), layer,
                                      [](const GridBlock& block, int l) { return block.layer < l; });
  return found != cell.end() && found->layer == layer ? &*found : nullptr;
}

}  // namespace plenolab
