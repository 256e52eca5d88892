#include "core/tonemap/bilateral.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/tonemap/filters/bilateral_filter.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;
constexpr float kInverseGamma = 1 / 2.2f;
constexpr int kBins = 1024;  // of a histogram of bases, for one log10 unit

void check(bool good, const char* what, double value) {
  if (!good) throw InputError(fmt::format("{}, not {}", what, value));
}

Plane<float> log_luminance(const SceneImage& image, double floor, int threads) {
  Plane<float> logs(image.width(), image.height());
  const std::size_t width = static_cast<std::size_t>(image.width());
  const float least = static_cast<float>(floor);
  parallel_for(image.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::span<float> row(logs.row(y), width);
      luminance_row({image.row(y), width}, row);
      std::replace_if(
          row.begin(), row.end(), [](float l) { return !(l > 0); }, least);
      log10_row(row, row);
    }
  });
  return logs;
}

Plane<float> filter(const BilateralToneOptions& options, const Plane<float>& logs,
                    const std::optional<DepthGuide>& guide, int threads) {
  BilateralOptions widths;
  widths.sigma_s_px = options.sigma_s_share * std::max(logs.width(), logs.height());
  widths.sigma_value = options.sigma_log10;
  return options.exact ? bilateral_exact(logs, widths, guide, threads)
                       : bilateral_fast(logs, widths, guide, threads);
}

void subtract(Plane<float>& from, const Plane<float>& what) {
  std::transform(from.pixels().begin(), from.pixels().end(), what.pixels().begin(), from.pixels().begin(),
                 std::minus<float>());
}

void check_disparity(const SceneImage& view, const DisparityMap* disparity) {
  if (!disparity)
    throw InputError(
        "the enhanced bilateral operator needs a disparity map; give one or use the naive variant");
  if (disparity->width() != view.width() || disparity->height() != view.height())
    throw InputError(fmt::format("the disparity map of {} × {} px does not match the view of {} × {} px",
                                 disparity->width(), disparity->height(), view.width(), view.height()));
  const auto finite = [](float d) { return std::isfinite(d); };
  if (!std::all_of(disparity->pixels().begin(), disparity->pixels().end(), finite))
    throw InputError(
        "the disparity map holds NaN or infinite values; the enhanced bilateral operator needs finite ones");
}

/// No weight G_σd differs from 1 where all disparities are equal.
bool has_depth_edges(const DisparityMap& disparity) {
  const auto [low, high] = std::minmax_element(disparity.pixels().begin(), disparity.pixels().end());
  return low != disparity.pixels().end() && *low < *high;
}

/// Reads a repaired view.
BilateralLayers layers_of(const BilateralToneOptions& options, const SceneImage& image,
                          const DisparityMap* disparity, double floor, int threads, bool foreground) {
  BilateralLayers layers;
  layers.log_luminance = log_luminance(image, floor, threads);
  if (!options.enhanced || (options.prune && !has_depth_edges(*disparity))) {
    layers.base = filter(options, layers.log_luminance, std::nullopt, threads);
    return layers;
  }
  DepthGuide guide{disparity, options.sigma_d_px, DepthSide::kTwoSided};
  layers.base = filter(options, layers.log_luminance, guide, threads);
  if (!foreground) return layers;
  guide.side = DepthSide::kBackgroundTakesNothingFromForeground;
  const Plane<float> temporary = filter(options, layers.log_luminance, guide, threads);
  layers.foreground = layers.base;
  subtract(layers.foreground, temporary);
  return layers;
}

/// Layers without a base, which the target does not read. Errors are those of bilateral_layers.
BilateralLayers luminance_alone(const BilateralToneParameters& p, const SceneImage& view,
                                const DisparityMap* disparity, int threads) {
  if (p.options.enhanced) check_disparity(view, disparity);
  const RepairedView repaired(view, threads);
  BilateralLayers layers;
  layers.log_luminance = log_luminance(repaired.image(), p.floor, threads);
  return layers;
}

/// Whether the base layer cancels: base·1 + (I − base) = I.
bool keeps_luminance(const BilateralToneParameters& p) {
  return p.compression == 1 && (!p.options.enhanced || p.foreground_scale == 0);
}

void target_row(const BilateralToneParameters& p, const BilateralLayers& layers, int y,
                std::span<float> out) {
  const float compression = static_cast<float>(p.compression), scale = static_cast<float>(p.foreground_scale);
  const float brightness = static_cast<float>(p.brightness);
  const float* log = layers.log_luminance.row(y);
  if (keeps_luminance(p)) {
    std::transform(log, log + out.size(), out.begin(), [&](float v) { return v - brightness; });
    return;
  }
  const float* base = layers.base.row(y);
  const float* foreground = layers.foreground.empty() ? nullptr : layers.foreground.row(y);
  for (std::size_t x = 0; x < out.size(); ++x) {
    const float layer = foreground ? foreground[x] * scale : 0.0f;
    out[x] = base[x] * compression + layer + (log[x] - base[x]) - brightness;
  }
}

}  // namespace

void BilateralToneOptions::validate() const {
  check(sigma_s_share > 0 && sigma_s_share <= 1, "sigma_s must be a share of the larger side in (0, 1]",
        sigma_s_share);
  check(sigma_log10 > 0 && sigma_log10 <= 100, "sigma_l must lie in (0, 100] log10 units", sigma_log10);
  check(sigma_d_px > 0 && sigma_d_px <= 1e6, "sigma_d must lie in (0, 1e6] px", sigma_d_px);
  if (compression)
    check(*compression > 0 && *compression <= 1, "the compression must lie in (0, 1]", *compression);
  if (brightness) check(std::isfinite(*brightness), "the brightness must be finite", *brightness);
  if (foreground_scale)
    check(*foreground_scale >= 0 && *foreground_scale <= 4, "the foreground scale must lie in [0, 4]",
          *foreground_scale);
  check(outliers >= 0 && outliers <= 0.2, "the share of outliers must lie in [0, 0.2]", outliers);
  check(contrast >= 1.1 && contrast <= 1e6, "the contrast of bases must lie in [1.1, 1e6]", contrast);
  if (colour_exponent)
    check(*colour_exponent >= 0 && *colour_exponent <= 1, "the colour exponent must lie in [0, 1]",
          *colour_exponent);
}

double colour_exponent_of(double compression) {
  const double power = 1.48 * std::pow(compression, 0.82);
  return (1 + 1 / 1.48) * power / (1 + power) / 2.2;
}

Plane<float> BilateralLayers::detail() const {
  Plane<float> detail = log_luminance;
  subtract(detail, base);
  return detail;
}

BilateralLayers bilateral_layers(const BilateralToneOptions& options, const SceneImage& view,
                                 const DisparityMap* disparity, double floor, int threads, bool foreground) {
  options.validate();
  check(floor > 0 && std::isfinite(floor), "the log floor must be a positive luminance", floor);
  if (options.enhanced) check_disparity(view, disparity);
  const RepairedView repaired(view, threads);
  return layers_of(options, repaired.image(), disparity, floor, threads, foreground);
}

BaseHistogram measure_base(const BilateralLayers& layers) {
  if (layers.base.empty())
    throw InputError("an image without pixels has no base layer; give one of at least 1 × 1");
  const auto [low, high] = std::minmax_element(layers.base.pixels().begin(), layers.base.pixels().end());
  const auto bin_of = [](float v) { return static_cast<std::int32_t>(std::floor(v * kBins)); };
  std::vector<std::int64_t> counts(static_cast<std::size_t>(bin_of(*high) - bin_of(*low)) + 1);
  for (const float v : layers.base.pixels()) ++counts[static_cast<std::size_t>(bin_of(v) - bin_of(*low))];
  BaseHistogram bases{{}, {static_cast<double>(*low), static_cast<double>(*high)}};
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) bases.bins[bin_of(*low) + static_cast<std::int32_t>(i)] = counts[i];
  return bases;
}

BaseHistogram merge(BaseHistogram a, const BaseHistogram& b) {
  for (const auto& [bin, count] : b.bins) a.bins[bin] += count;
  a.extremes = {std::min(a.extremes.min, b.extremes.min), std::max(a.extremes.max, b.extremes.max)};
  return a;
}

BaseRange range_of(const BaseHistogram& bases, double outliers) {
  if (outliers <= 0) return bases.extremes;
  std::int64_t all = 0;
  for (const auto& [bin, count] : bases.bins) all += count;
  const double left_out = outliers * static_cast<double>(all);
  // Middle of the first bin, counted from one end, beyond what is left out.
  const auto end_of = [&](auto begin, auto end) {
    double seen = 0;
    for (auto bin = begin; bin != end; ++bin) {
      seen += static_cast<double>(bin->second);
      if (seen > left_out) return (bin->first + 0.5) / kBins;
    }
    return 0.0;
  };
  const double low = end_of(bases.bins.begin(), bases.bins.end());
  const double high = end_of(bases.bins.rbegin(), bases.bins.rend());
  const auto inside = [&](double v) { return std::clamp(v, bases.extremes.min, bases.extremes.max); };
  return {inside(low), inside(high)};
}

BilateralToneParameters fit(const BilateralToneOptions& options, const BaseRange& bases, double floor) {
  options.validate();
  const double range = bases.max - bases.min;
  BilateralToneParameters p;
  p.options = options;
  p.floor = floor;
  const double display_range = std::log10(options.contrast);
  p.compression = options.compression.value_or(range > display_range ? display_range / range : 1.0);
  p.brightness = options.brightness.value_or(p.compression * bases.max);
  p.foreground_scale = options.foreground_scale.value_or(1 - p.compression);
  p.colour_exponent = options.colour_exponent.value_or(colour_exponent_of(p.compression));
  return p;
}

Plane<float> target_log_luminance(const BilateralToneParameters& p, const BilateralLayers& layers) {
  Plane<float> target(layers.log_luminance.width(), layers.log_luminance.height());
  for (int y = 0; y < target.height(); ++y)
    target_row(p, layers, y, {target.row(y), static_cast<std::size_t>(target.width())});
  return target;
}

ToneMapped apply(const BilateralToneParameters& p, const SceneImage& view, const DisparityMap* disparity,
                 int threads) {
  const BilateralLayers layers = p.options.prune && keeps_luminance(p)
                                     ? luminance_alone(p, view, disparity, threads)
                                     : bilateral_layers(p.options, view, disparity, p.floor, threads);
  const auto body = [&](int y, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers,
                        MappingCounts& counts) {
    buffers.a.resize(scene.size());
    target_row(p, layers, y, buffers.a);
    for (float& v : buffers.a) v *= kInverseGamma;  // gamma in the log domain
    exp10_row(buffers.a, buffers.a);
    for (const Rgb& c : scene) counts.floored_pixels += luminance(c) > 0 ? 0 : 1;
    counts.clipped_high += apply_colour_ratio(scene, buffers.a, p.colour_exponent, out);
  };
  return map_rows(view, threads, body);
}

}  // namespace plenolab
