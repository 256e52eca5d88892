#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/tonemap/filters/bilateral_grid.h"

namespace plenolab {

/// Position between two samples of an axis.
struct GridCoordinate {
  int index = 0;
  float fraction = 0;  ///< in [0, 1)
};

/// Evenly spaced samples from `origin` on.
struct GridAxis {
  float origin = 0;
  float samples_per_unit = 1;
  GridCoordinate at(float v) const {
    const float u = (v - origin) * samples_per_unit;
    const int index = static_cast<int>(u);
    return {index, u - static_cast<float>(index)};
  }
};

/// The four axes of a grid for one image. Columns and rows are looked up in tables.
struct GridAxes {
  std::vector<GridCoordinate> column_of, row_of;  ///< of each pixel column and row
  int columns = 0, rows = 0;                      ///< samples; one more than the largest index
  GridAxis bins, layers;
};

/// Range bins come in groups of this many, so that every interval is a whole number of vectors.
inline constexpr int kBinGroup = 4;
/// Floats of a bin: the weight and the weighted value.
inline constexpr int kBinFloats = 2;

/// The bins [begin, end) of one disparity layer in one cell.
struct GridBlock {
  int layer = 0;
  int begin = 0, end = 0;  ///< multiples of kBinGroup
  std::size_t offset = 0;  ///< of the first bin in the grid's array
};

/// Which blocks a grid has: exactly those that interpolation at the pixels reaches.
struct GridLayout {
  int columns = 0, rows = 0;
  std::vector<std::size_t> first;  ///< of each cell, row by row, in `blocks`; one more at the end
  std::vector<GridBlock> blocks;   ///< of a cell in ascending order of layers
  std::size_t floats = 0;          ///< of all blocks

  std::span<const GridBlock> cell(int column, int row) const {
    const std::size_t c =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    return {blocks.data() + first[c], first[c + 1] - first[c]};
  }
};

/// The pixel rows [begin, end) between two rows of cells.
struct PixelRows {
  int begin = 0, end = 0;
};
PixelRows pixel_rows(const GridAxes& axes, int row);

GridAxes make_axes(const BilateralInput& input, const GridSampling& sampling);
GridLayout make_layout(const BilateralInput& input, const GridAxes& axes);

/// The block of a layer in a cell; null if it has none.
const GridBlock* find_block(std::span<const GridBlock> cell, int layer);

}  // namespace plenolab
