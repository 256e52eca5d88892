#include "core/tonemap/adjustment/adjustment_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/tonemap/filters/bilateral_filter.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/row_math.h"

namespace plenolab {
namespace {

constexpr int kRowsAtOnce = 16;

/// Adds up what `count_row` gives for each row.
template <class CountRow>
std::int64_t count_rows(int rows, int threads, const CountRow& count_row) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(rows), 0);
  parallel_for(rows, kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) counts[static_cast<std::size_t>(y)] = count_row(y);
  });
  std::int64_t sum = 0;
  for (const std::int64_t n : counts) sum += n;
  return sum;
}

void add(PixelRepairs& sum, const PixelRepairs& more) {
  sum.nan += more.nan;
  sum.positive_infinity += more.positive_infinity;
  sum.negative += more.negative;
}

/// Fills log10 of the luminance and returns how many pixels had none.
std::int64_t take_log_luminance(const SceneImage& image, float floor, int threads, Plane<float>& out) {
  out = Plane<float>(image.width(), image.height());
  return count_rows(image.height(), threads, [&](int y) {
    const std::span<float> row(out.row(y), static_cast<std::size_t>(out.width()));
    luminance_row({image.row(y), row.size()}, row);
    std::int64_t floored = 0;
    for (float& v : row) {
      floored += v < floor;
      v = std::max(v, floor);
    }
    log10_row(row, row);
    return floored;
  });
}

/// Fills the luma and returns how many channel values were no display values.
std::int64_t take_luma(const DisplayImage& image, int threads, Plane<float>& out) {
  out = Plane<float>(image.width(), image.height());
  return count_rows(image.height(), threads, [&](int y) {
    std::int64_t repaired = 0;
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.at(x, y), v{display_value(c.r), display_value(c.g), display_value(c.b)};
      repaired += (v.r != c.r) + (v.g != c.g) + (v.b != c.b);
      out.at(x, y) = luminance(v);
    }
    return repaired;
  });
}

}  // namespace

void require_same_grid(const LightField& hdr, const DisplayLightField& tone_mapped) {
  const ViewGrid &a = hdr.grid(), &b = tone_mapped.grid();
  if (a.columns != b.columns || a.rows != b.rows || a.width != b.width || a.height != b.height)
    throw InputError(
        fmt::format("the HDR light field {} has {}×{} views of {}×{} pixels, the tone mapped one {} {}×{} "
                    "of {}×{}; give two forms of the same light field",
                    hdr.name(), a.columns, a.rows, a.width, a.height, tone_mapped.name(), b.columns, b.rows,
                    b.width, b.height));
}

float smallest_luminance(const LightField& hdr, int threads) {
  float smallest = std::numeric_limits<float>::infinity();
  for (int row = 0; row < hdr.grid().rows; ++row)
    for (int column = 0; column < hdr.grid().columns; ++column) {
      const auto view = hdr.view(column, row);
      const RepairedView repaired(view->colour, threads);
      for (const Rgb c : repaired.image().pixels())
        if (const float l = luminance(c); l > 0) smallest = std::min(smallest, l);
    }
  return std::isinf(smallest) ? 1.0f : smallest;
}

AdjustmentView read_adjustment_view(const LightField& hdr, const DisplayLightField& tone_mapped, int column,
                                    int row, float floor, int threads, KeyViewAdjustmentCounts& counts) {
  const auto scene = hdr.view(column, row);
  const auto display = tone_mapped.view(column, row);
  const RepairedView repaired(scene->colour, threads);
  AdjustmentView view;
  view.disparity = scene->disparity;
  counts.floored_pixels += take_log_luminance(repaired.image(), floor, threads, view.log_luminance);
  counts.display_repairs += take_luma(display->colour, threads, view.luma);
  add(counts.hdr_repairs, repaired.repairs());
  counts.pixels += static_cast<std::int64_t>(view.luma.size());
  return view;
}

float display_value(float v) {
  return v >= 0 ? std::min(v, 1.0f) : 0.0f;  // NaN is not ≥ 0
}

DisplayImage apply_factors(const DisplayImage& view, const Plane<float>& factors,
                           KeyViewAdjustmentCounts& counts) {
  DisplayImage out(view.width(), view.height());
  const auto scaled = [&](float v, float factor) {
    const float result = display_value(v) * factor;
    counts.clipped_high += result > 1;
    return display_value(result);  // factors around 0 may be negative by a rounding
  };
  for (int y = 0; y < view.height(); ++y)
    for (int x = 0; x < view.width(); ++x) {
      const Rgb c = view.at(x, y);
      const float factor = factors.at(x, y);
      out.at(x, y) = {scaled(c.r, factor), scaled(c.g, factor), scaled(c.b, factor)};
    }
  return out;
}

Plane<float> smooth_factors(const Plane<float>& factors, const AdjustmentView& view,
                            const KeyViewAdjustmentOptions& options, bool exact, int threads) {
  const BilateralOptions filter{
      .sigma_s_px = options.smoothing_share * std::max(factors.width(), factors.height()),
      .sigma_value = options.smoothing_sigma_log_luminance};
  const DepthGuide depth{&view.disparity, options.smoothing_sigma_d_px, DepthSide::kTwoSided};
  return (exact ? cross_bilateral_exact : cross_bilateral_fast)(factors, view.log_luminance, filter, depth,
                                                                threads);
}

ViewStep step_between(const ViewGrid& grid, int from_column, int from_row, int to_column, int to_row) {
  return {static_cast<float>(from_column - to_column),
          static_cast<float>((from_row - to_row) * grid.vertical_ratio())};
}

}  // namespace plenolab
