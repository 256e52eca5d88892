#include "experiments/reproduce/claims/appearance_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "metrics/error_map.h"

namespace plenolab {
namespace {

constexpr int kLeastSpot_px = 3;

double dot(Rgb a, Rgb b) {
  return (static_cast<double>(a.r) * static_cast<double>(b.r) +
          static_cast<double>(a.g) * static_cast<double>(b.g) +
          static_cast<double>(a.b) * static_cast<double>(b.b)) /
         3;
}

TwinView render_twin(Laboratory& laboratory, const Probe& probe, CameraPosition position,
                     const std::array<LightField, 2>& fields) {
  TwinView twin;
  twin.position = position;
  for (std::size_t k = 0; k < 2; ++k) {
    SynthesisOptions options;
    options.threads = laboratory.options().threads;
    options.record_provenance = k == 0;
    NovelView<SceneReferred> novel = synthesize(fields[k], position, options);
    KeyView<SceneReferred> truth =
        laboratory.render(probe.scene, probe.grid, position, probe.paths_per_pixel, k);
    if (k == 0) {
      twin.views = contributing_views(novel, true);
      twin.disparity = std::move(truth.disparity);
    }
    twin.synthesised[k] = expose(novel.image, probe.exposure);
    twin.truth[k] = expose(truth.colour, probe.exposure);
    twin.synthesised_radiance[k] = std::move(novel.image);
    twin.truth_radiance[k] = std::move(truth.colour);
  }
  constexpr std::uint8_t kAllViews = (1u << kMaxViews) - 1;
  twin.valid = Mask(twin.views.width(), twin.views.height());
  for (std::size_t i = 0; i < twin.valid.size(); ++i)
    twin.valid.pixels()[i] = twin.views.pixels()[i] == kAllViews ? 1 : 0;
  return twin;
}

struct TileSums {
  double error = 0, noise = 0;
  int pixels = 0;
};

TileSums sum_tile(const TwinView& view, const Window& tile) {
  TileSums sums;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      if (view.valid.at(x, y) == 0) continue;
      sums.error += dot(view.synthesised[0].at(x, y) - view.truth[0].at(x, y),
                        view.synthesised[1].at(x, y) - view.truth[1].at(x, y));
      const Rgb noise = view.truth[0].at(x, y) - view.truth[1].at(x, y);
      sums.noise += dot(noise, noise) / 2;
      ++sums.pixels;
    }
  return sums;
}

double root_of_mean(std::span<const double> values) {
  return std::sqrt(std::max(0.0, mean(values)));
}

std::vector<float> values_in(const Plane<float>& luma, const Window& window) {
  std::vector<float> values;
  for (int y = window.y; y < window.y + window.height; ++y)
    values.insert(values.end(), luma.row(y) + window.x, luma.row(y) + window.x + window.width);
  return values;
}

float median_in(const Plane<float>& luma, const Window& window) {
  std::vector<float> values = values_in(luma, window);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Clears the group that (x, y) belongs to and returns its number of pixels.
int clear_group(Plane<std::uint8_t>& bright, int x, int y) {
  std::vector<std::pair<int, int>> open{{x, y}};
  bright.at(x, y) = 0;
  int pixels = 0;
  while (!open.empty()) {
    const auto [cx, cy] = open.back();
    open.pop_back();
    ++pixels;
    for (int ny = std::max(0, cy - 1); ny <= std::min(bright.height() - 1, cy + 1); ++ny)
      for (int nx = std::max(0, cx - 1); nx <= std::min(bright.width() - 1, cx + 1); ++nx)
        if (bright.at(nx, ny) != 0) {
          bright.at(nx, ny) = 0;
          open.emplace_back(nx, ny);
        }
  }
  return pixels;
}

}  // namespace

Plane<std::uint8_t> contributing_views(const NovelView<SceneReferred>& novel, bool weightless) {
  Plane<std::uint8_t> bits(novel.image.width(), novel.image.height());
  for (std::size_t i = 0; i < bits.size(); ++i)
    for (std::size_t view = 0; view < kMaxViews; ++view) {
      const CorrespondenceState state = novel.provenance.pixels()[i][view].state;
      if (state == CorrespondenceState::kUsed || (weightless && state == CorrespondenceState::kWeightZero))
        bits.pixels()[i] = static_cast<std::uint8_t>(bits.pixels()[i] | (1u << view));
    }
  return bits;
}

ViewGrid appearance_grid(const Laboratory& laboratory, double spacing_m) {
  return laboratory.scaled({2, 2, spacing_m, spacing_m, 192, 108, 60});
}

std::vector<TwinView> render_twins(Laboratory& laboratory, const Probe& probe) {
  const std::array<LightField, 2> fields{
      laboratory.render_field(probe.scene, probe.grid, probe.paths_per_pixel, 0),
      laboratory.render_field(probe.scene, probe.grid, probe.paths_per_pixel, 1)};
  std::vector<TwinView> twins;
  for (const CameraPosition position : probe.positions)
    twins.push_back(render_twin(laboratory, probe, position, fields));
  return twins;
}

TileErrors tile_errors(std::span<const TwinView> views) {
  TileErrors errors;
  int first = 0;
  for (const TwinView& view : views) {
    const int width = view.valid.width(), height = view.valid.height();
    for (int j = 0; j < kTilesY; ++j)
      for (int i = 0; i < kTilesX; ++i) {
        const Window tile{i * width / kTilesX, j * height / kTilesY, width / kTilesX, height / kTilesY};
        const TileSums sums = sum_tile(view, tile);
        if (2 * sums.pixels < tile.width * tile.height || sums.pixels == 0) continue;
        errors.tile.push_back(first + j * kTilesX + i);
        errors.error.push_back(sums.error / sums.pixels);
        errors.noise.push_back(sums.noise / sums.pixels);
      }
    first += kTilesX * kTilesY;
  }
  return errors;
}

Interval root_mean_interval(std::span<const double> squared_errors, std::uint64_t seed, int block_length) {
  return bootstrap_interval(squared_errors, root_of_mean, {.seed = seed, .block_length = block_length});
}

Interval root_mean_interval(const TileErrors& tiles, std::uint64_t seed) {
  return root_mean_interval(tiles.error, seed, kTilesX);
}

Interval root_ratio_interval(std::span<const double> numerator, std::span<const double> denominator,
                             std::uint64_t seed, int block_length) {
  PLENOLAB_CHECK(numerator.size() == denominator.size(), "ratios need paired values");
  const auto ratio = [&](std::span<const double> chosen) {
    double above = 0, below = 0;
    for (const double index : chosen) {
      above += numerator[static_cast<std::size_t>(index)];
      below += denominator[static_cast<std::size_t>(index)];
    }
    return below > 0 ? std::sqrt(std::max(0.0, above) / below) : std::numeric_limits<double>::infinity();
  };
  return bootstrap_units(numerator.size(), ratio, seed, block_length);
}

Interval root_ratio_interval(const TileErrors& numerator, const TileErrors& denominator, std::uint64_t seed) {
  std::vector<double> above, below;
  std::size_t k = 0;
  for (std::size_t i = 0; i < numerator.tile.size(); ++i) {
    while (k < denominator.tile.size() && denominator.tile[k] < numerator.tile[i]) ++k;
    if (k == denominator.tile.size() || denominator.tile[k] != numerator.tile[i]) continue;
    above.push_back(numerator.error[i]);
    below.push_back(denominator.error[k]);
  }
  return root_ratio_interval(above, below, seed, kTilesX);
}

Window window_around(const ViewGrid& grid, double x, double y, double half_width, double half_height) {
  const auto cut = [](double v, int size) { return std::clamp(static_cast<int>(std::floor(v)), 0, size); };
  const int left = cut(x - half_width, grid.width), right = cut(x + half_width + 1, grid.width);
  const int top = cut(y - half_height, grid.height), bottom = cut(y + half_height + 1, grid.height);
  return {left, top, right - left, bottom - top};
}

Plane<float> luma_of(const std::array<DisplayImage, 2>& images) {
  Plane<float> luma(images[0].width(), images[0].height());
  for (std::size_t i = 0; i < luma.size(); ++i)
    luma.pixels()[i] = luminance((images[0].pixels()[i] + images[1].pixels()[i]) * 0.5f);
  return luma;
}

int count_spots(const Plane<float>& luma, const Window& window, float height) {
  if (window.width == 0 || window.height == 0) return 0;
  const float limit = median_in(luma, window) + height;
  Plane<std::uint8_t> bright(window.width, window.height);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      bright.at(x, y) = luma.at(window.x + x, window.y + y) > limit ? 1 : 0;
  int spots = 0;
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      if (bright.at(x, y) != 0 && clear_group(bright, x, y) >= kLeastSpot_px) ++spots;
  return spots;
}

float peak_height(const Plane<float>& luma, const Window& window) {
  if (window.width == 0 || window.height == 0) return 0;
  const std::vector<float> values = values_in(luma, window);
  return *std::max_element(values.begin(), values.end()) - median_in(luma, window);
}

double autocorrelation(const Plane<float>& luma, const Window& window, double displacement_px) {
  if (window.width == 0 || window.height == 0) return 0;
  const float middle = median_in(luma, window);
  const int whole = static_cast<int>(std::floor(displacement_px));
  const double part = displacement_px - whole;
  double product = 0, power = 0;
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x) {
      const double here = static_cast<double>(luma.at(x, y) - middle);
      power += here * here;
      const int left = x + whole;
      if (left < window.x || left + 1 >= window.x + window.width) continue;
      const double there = static_cast<double>(luma.at(left, y) - middle) * (1 - part) +
                           static_cast<double>(luma.at(left + 1, y) - middle) * part;
      product += here * there;
    }
  return power > 0 ? product / power : 0;
}

ImageComparison truth_and_synthesis(const TwinView& view, const std::string& caption) {
  const ComparisonConditions conditions;
  return {caption,
          "Ground truth and synthesised view of a probe scene, and their difference",
          {{"Ground truth", view.truth[0]},
           {"Synthesised", view.synthesised[0]},
           {"Difference", error_map(view.synthesised[0], view.truth[0], conditions)}}};
}

void add_twin_comparison(ReproductionResult& result, const std::string& name, const TwinView& view,
                         const std::string& caption) {
  result.add_comparison(name, truth_and_synthesis(view, caption),
                        {view.truth_radiance[0], view.synthesised_radiance[0]});
}

std::string text_of(const Interval& interval, int digits) {
  return fmt::format("{} [{}, {}]", format_number(interval.estimate, digits),
                     format_number(interval.low, digits), format_number(interval.high, digits));
}

std::string text_of(const std::optional<Interval>& interval) {
  return interval ? text_of(*interval) : "not measurable";
}

PlotPoint plot_point(double x, const Interval& y) {
  PlotPoint point;
  point.x = x;
  point.y = y.estimate;
  point.y_low = y.low;
  point.y_high = y.high;
  return point;
}

}  // namespace plenolab
