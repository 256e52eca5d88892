#include "core/tonemap/reinhard_devlin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/curve_rows.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;

std::span<const Rgb> row_of(const Plane<Rgb>& plane, int y) {
  return {plane.row(y), static_cast<std::size_t>(plane.width())};
}

/// Limits of all rows; of no pixels {0, 1}.
LumaLimits enclose_all(const std::vector<LumaRange>& rows) {
  LumaRange all;
  for (const LumaRange& row : rows) {
    all.min = std::min(all.min, row.min);
    all.max = std::max(all.max, row.max);
  }
  if (all.max < all.min) return {};
  return {static_cast<double>(all.min), static_cast<double>(all.max)};
}

/// (V − min)/(max − min); identity for an empty interval.
class Normalisation {
 public:
  explicit Normalisation(const LumaLimits& limits) {
    if (!(limits.max > limits.min)) return;
    gain_ = static_cast<float>(std::min(1 / (limits.max - limits.min), 1e30));
    offset_ = static_cast<float>(limits.min);
  }

  void map_row(std::span<Rgb> row, MappingCounts& counts) const {
    const CutCounts cut = normalise_row(row, offset_, gain_);
    counts.clipped_high += cut.high;
    counts.clipped_low += cut.low;
  }

 private:
  float gain_ = 1, offset_ = 0;
};

/// Luma range of a row that is not fresh from respond_row.
LumaRange range_of(std::span<const Rgb> row, std::vector<float>& luma) {
  luma.resize(row.size());
  luminance_row(row, luma);
  LumaRange range;
  for (const float v : luma) {
    range.min = std::min(range.min, v);
    range.max = std::max(range.max, v);
  }
  return range;
}

/// Fills a response row by row with body(scene row, response row, buffers), which returns the range of luma.
using ResponseBody =
    std::function<LumaRange(std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers)>;

Response respond_with(const SceneImage& view, int threads, const ResponseBody& body) {
  std::vector<LumaRange> ranges(static_cast<std::size_t>(view.height()));
  ToneMapped mapped =
      map_rows(view, threads,
               [&](int y, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers,
                   MappingCounts&) { ranges[static_cast<std::size_t>(y)] = body(scene, out, buffers); });
  Response response;
  response.repairs = mapped.counts.repairs;
  response.limits = enclose_all(ranges);
  response.value = std::move(mapped.image);
  return response;
}

void check_weights(std::size_t parameters, std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const bool negative = std::any_of(weights.begin(), weights.end(), [](double w) { return !(w >= 0); });
  if (parameters == 0 || parameters != weights.size() || negative || !(std::abs(sum - 1) <= 1e-6))
    throw InputError(fmt::format(
        "{} tone mappings cannot be interpolated with {} weights of sum {}; give each a weight ≥ 0, sum 1",
        parameters, weights.size(), sum));
}

}  // namespace

void ReinhardDevlinOptions::validate() const {
  validate_photoreceptor(brightness, colour_adaptation, light_adaptation);
  if (contrast && !(*contrast >= 0.1 && *contrast <= 1))
    throw InputError(fmt::format("the contrast m must lie in [0.1, 1], not {}", *contrast));
  if (!(exposure > 0 && exposure <= 1e9))
    throw InputError(fmt::format("the exposure must lie in (0, 1e9], not {}", exposure));
}

void validate(const LumaLimits& manual) {
  if (!(manual.min >= 0 && manual.min < manual.max && manual.max <= 1))
    throw InputError(fmt::format("luma limits must satisfy 0 ≤ min < max ≤ 1, not min {} and max {}",
                                 manual.min, manual.max));
}

LumaLimits enclose(const LumaLimits& a, const LumaLimits& b) {
  return {std::min(a.min, b.min), std::max(a.max, b.max)};
}

double automatic_contrast(const ImageStatistics& s) {
  return contrast_of(s.log_min, s.log_average, s.log_max);
}

ReinhardDevlinParameters fit(const ReinhardDevlinOptions& options, const ImageStatistics& statistics) {
  options.validate();
  ReinhardDevlinParameters p;
  p.exposure = options.exposure;
  p.contrast = options.contrast.value_or(automatic_contrast(statistics));
  p.factor = std::exp(-options.brightness);
  p.colour_adaptation = options.colour_adaptation;
  p.light_adaptation = options.light_adaptation;
  const double c = options.colour_adaptation;
  for (std::size_t i = 0; i < 3; ++i)
    p.global[i] =
        options.exposure * (c * statistics.average_colour[i] + (1 - c) * statistics.average_luminance);
  return p;
}

Response respond(const ReinhardDevlinParameters& parameters, const SceneImage& view, int threads) {
  return respond_with(view, threads, [&](std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers&) {
    return respond_row(parameters, scene, out);
  });
}

Response respond_interpolated(std::span<const ReinhardDevlinParameters> parameters,
                              std::span<const double> weights, const SceneImage& view, int threads) {
  check_weights(parameters.size(), weights);
  const auto blend_row = [&](std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers) {
    std::vector<Rgb> one(scene.size());
    std::fill(out.begin(), out.end(), Rgb{});
    for (std::size_t n = 0; n < parameters.size(); ++n) {
      respond_row(parameters[n], scene, one);
      const float w = static_cast<float>(weights[n]);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] += w * one[i];
    }
    return range_of(out, buffers.a);
  };
  return respond_with(view, threads, blend_row);
}

LumaLimits measure_limits(const ReinhardDevlinParameters& parameters, const SceneImage& view, int threads) {
  const RepairedView repaired(view, threads);
  const SceneImage& image = repaired.image();
  std::vector<LumaRange> rows(static_cast<std::size_t>(image.height()));
  parallel_for(image.height(), kRowGrain, threads, [&](int begin, int end) {
    std::vector<Rgb> response(static_cast<std::size_t>(image.width()));
    for (int y = begin; y < end; ++y)
      rows[static_cast<std::size_t>(y)] = respond_row(parameters, row_of(image, y), response);
  });
  return enclose_all(rows);
}

ToneMapped normalise(Response response, const LumaLimits& limits, int threads) {
  ToneMapped mapped;
  mapped.counts.repairs = response.repairs;
  static_cast<Plane<Rgb>&>(mapped.image) = std::move(response.value);
  DisplayImage& image = mapped.image;
  const Normalisation normalisation(limits);
  std::vector<MappingCounts> counts(static_cast<std::size_t>(image.height()));
  parallel_for(image.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      normalisation.map_row({image.row(y), static_cast<std::size_t>(image.width())},
                            counts[static_cast<std::size_t>(y)]);
  });
  for (const MappingCounts& row : counts) mapped.counts += row;
  return mapped;
}

ToneMapped apply(const ReinhardDevlinParameters& parameters, const LumaLimits& limits, const SceneImage& view,
                 int threads) {
  const Normalisation normalisation(limits);
  return map_rows(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers&, MappingCounts& counts) {
        respond_row(parameters, scene, out);
        normalisation.map_row(out, counts);
      });
}

}  // namespace plenolab
