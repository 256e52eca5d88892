#include "core/synthesis/prepared_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/image/repair.h"

namespace plenolab {
namespace {

constexpr int kRowsPerTask = 16;

float repaired_code(float v) {
  return std::isfinite(v) ? v : 0.0f;
}

Rgb blend_encode(Rgb repaired, SceneReferred) {
  return gamma_encode(repaired);
}
Rgb blend_encode(Rgb repaired, DisplayReferred) {
  return repaired;
}

template <class Referral>
std::size_t prepare_row(const KeyView<Referral>& view, int y, PreparedView& out) {
  std::size_t repaired = 0;
  float* padded = out.disparity.row(y + PreparedView::kPaddingRows) + PreparedView::kPadding;
  for (int x = 0; x < out.width; ++x) {
    const Rgb colour = view.colour.at(x, y), safe = repaired_colour(colour, out.largest_finite, Referral{});
    repaired += static_cast<std::size_t>(colour.r != safe.r) + static_cast<std::size_t>(colour.g != safe.g) +
                static_cast<std::size_t>(colour.b != safe.b);
    const float disparity = view.disparity.at(x, y);
    const bool valid = std::isfinite(disparity) && disparity >= 0;
    repaired += static_cast<std::size_t>(!valid);
    const Rgb encoded = blend_encode(safe, Referral{});
    padded[x] = valid ? disparity : 0.0f;
    out.pixels.at(x, y) = {encoded.r, encoded.g, encoded.b, padded[x]};
  }
  std::fill_n(padded - PreparedView::kPadding, PreparedView::kPadding, padded[0]);
  std::fill_n(padded + out.width, PreparedView::kPadding, padded[out.width - 1]);
  return repaired;
}

void repeat_outer_rows(PreparedView& view) {
  const auto width = static_cast<std::size_t>(view.disparity.width());
  for (int pad = 0; pad < PreparedView::kPaddingRows; ++pad) {
    std::copy_n(view.disparity.row(PreparedView::kPaddingRows), width, view.disparity.row(pad));
    std::copy_n(view.disparity.row(PreparedView::kPaddingRows + view.height - 1), width,
                view.disparity.row(PreparedView::kPaddingRows + view.height + pad));
  }
}

DisparityRange range_of(const PreparedView& view, int x0, int y0, int columns, int rows) {
  DisparityRange range{view.disparity_row(y0)[x0], view.disparity_row(y0)[x0]};
  for (int y = y0; y < std::min(y0 + rows, view.height); ++y) {
    const float* row = view.disparity_row(y);
    for (int x = x0; x < std::min(x0 + columns, view.width); ++x) {
      range.min = std::min(range.min, row[x]);
      range.max = std::max(range.max, row[x]);
    }
  }
  return range;
}

float max_quad_range_of_rows(const PreparedView& view, int begin, int end) {
  float largest = 0;
  for (int y = begin; y < end; ++y) {
    const float *upper = view.disparity_row(y), *lower = view.disparity_row(std::min(y + 1, view.height - 1));
    for (int x = 0; x < view.width; ++x) {  // the padding repeats the last column
      const float high = std::max(std::max(upper[x], upper[x + 1]), std::max(lower[x], lower[x + 1]));
      const float low = std::min(std::min(upper[x], upper[x + 1]), std::min(lower[x], lower[x + 1]));
      largest = std::max(largest, high - low);
    }
  }
  return largest;
}

void summarise(PreparedView& view, int threads) {
  constexpr int kBlock = PreparedView::kBlock;
  const int columns = (std::max(view.width - 1, 1) + kBlock - 1) / kBlock;
  const int rows = (std::max(view.height - 1, 1) + kBlock - 1) / kBlock;
  view.blocks = Plane<DisparityRange>(columns, rows);
  std::vector<float> quad_range(static_cast<std::size_t>(rows));
  parallel_for(rows, 2, threads, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < columns; ++column)
        view.blocks.at(column, row) = range_of(view, column * kBlock, row * kBlock, kBlock + 1, kBlock + 1);
      quad_range[static_cast<std::size_t>(row)] =
          max_quad_range_of_rows(view, row * kBlock, std::min((row + 1) * kBlock, view.height));
    }
  });
  view.min_disparity = view.max_disparity = view.disparity_row(0)[0];
  for (const DisparityRange& block : view.blocks.pixels()) {
    view.min_disparity = std::min(view.min_disparity, block.min);
    view.max_disparity = std::max(view.max_disparity, block.max);
  }
  view.max_quad_range = *std::max_element(quad_range.begin(), quad_range.end());
}

template <class Referral>
PreparedView prepare(const KeyView<Referral>& view, int threads) {
  PLENOLAB_CHECK(!view.colour.empty() && view.colour.width() == view.disparity.width() &&
                     view.colour.height() == view.disparity.height(),
                 fmt::format("colour {} × {}, disparity {} × {}", view.colour.width(), view.colour.height(),
                             view.disparity.width(), view.disparity.height()));
  PreparedView out;
  out.width = view.colour.width();
  out.height = view.colour.height();
  if constexpr (std::is_same_v<Referral, SceneReferred>) out.largest_finite = largest_finite(view.colour);
  out.pixels = LargePlane<ColourDisparity>(out.width, out.height);
  out.disparity =
      LargePlane<float>(out.width + 2 * PreparedView::kPadding, out.height + 2 * PreparedView::kPaddingRows);
  std::vector<std::size_t> repaired(static_cast<std::size_t>(out.height));
  parallel_for(out.height, kRowsPerTask, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) repaired[static_cast<std::size_t>(y)] = prepare_row(view, y, out);
  });
  for (std::size_t count : repaired) out.repaired_values += count;
  repeat_outer_rows(out);
  summarise(out, threads);
  return out;
}

}  // namespace

Rgb repaired_colour(Rgb c, float largest, SceneReferred) {
  return {repaired_value(c.r, largest), repaired_value(c.g, largest), repaired_value(c.b, largest)};
}

Rgb repaired_colour(Rgb c, float, DisplayReferred) {
  return {repaired_code(c.r), repaired_code(c.g), repaired_code(c.b)};
}

std::size_t PreparedView::memory_bytes() const {
  return pixels.size() * sizeof(ColourDisparity) + disparity.size() * sizeof(float) +
         blocks.size() * sizeof(DisparityRange);
}

PreparedView prepare_view(const KeyView<SceneReferred>& view, int threads) {
  return prepare(view, threads);
}
PreparedView prepare_view(const KeyView<DisplayReferred>& view, int threads) {
  return prepare(view, threads);
}

}  // namespace plenolab
