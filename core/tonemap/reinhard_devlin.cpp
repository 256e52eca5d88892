#include "core/tonemap/reinhard_devlin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/tonemap/photoreceptor.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;

std::span<const Rgb> row_of(const Plane<Rgb>& plane, int y) {
  return {plane.row(y), static_cast<std::size_t>(plane.width())};
}

/// Luma limits of one row; of no pixels an empty interval.
LumaLimits row_limits(std::span<const Rgb> row) {
  float low = 2, high = -1;
  for (const Rgb& v : row) {
    const float luma = luminance(v);
    low = std::min(low, luma);
    high = std::max(high, luma);
  }
  return {static_cast<double>(low), static_cast<double>(high)};
}

LumaLimits enclose_all(const std::vector<LumaLimits>& rows) {
  if (rows.empty()) return {};
  return std::accumulate(rows.begin() + 1, rows.end(), rows.front(), enclose);
}

/// (V − min)/(max − min); identity for an empty interval.
class Normalisation {
 public:
  explicit Normalisation(const LumaLimits& limits) {
    if (!(limits.max > limits.min)) return;
    const double gain = 1 / (limits.max - limits.min);
    gain_ = static_cast<float>(std::min(gain, 1e30));
    offset_ = static_cast<float>(limits.min);
  }

  void map_row(std::span<Rgb> row, MappingCounts& counts) const {
    std::int64_t high = 0, low = 0;
    for (Rgb& v : row)
      for (float* channel : {&v.r, &v.g, &v.b}) {
        const float mapped = (*channel - offset_) * gain_;
        high += mapped > 1 ? 1 : 0;
        low += mapped < 0 ? 1 : 0;
        *channel = std::clamp(mapped, 0.0f, 1.0f);
      }
    counts.clipped_high += high;
    counts.clipped_low += low;
  }

 private:
  float gain_ = 1, offset_ = 0;
};

Response respond_with(const SceneImage& view, int threads, const RowBody& body) {
  ToneMapped mapped = map_rows(view, threads, body);
  Response response;
  response.repairs = mapped.counts.repairs;
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
  return respond_with(view, threads,
                      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers,
                          MappingCounts&) { respond_row(parameters, scene, out, buffers); });
}

Response respond_interpolated(std::span<const ReinhardDevlinParameters> parameters,
                              std::span<const double> weights, const SceneImage& view, int threads) {
  check_weights(parameters.size(), weights);
  return respond_with(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts&) {
        std::vector<Rgb> one(scene.size());
        std::fill(out.begin(), out.end(), Rgb{});
        for (std::size_t n = 0; n < parameters.size(); ++n) {
          respond_row(parameters[n], scene, one, buffers);
          const float w = static_cast<float>(weights[n]);
          for (std::size_t i = 0; i < out.size(); ++i) out[i] += w * one[i];
        }
      });
}

LumaLimits measure_limits(const Response& response, int threads) {
  std::vector<LumaLimits> rows(static_cast<std::size_t>(response.value.height()));
  parallel_for(response.value.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      rows[static_cast<std::size_t>(y)] = row_limits(row_of(response.value, y));
  });
  return enclose_all(rows);
}

LumaLimits measure_limits(const ReinhardDevlinParameters& parameters, const SceneImage& view, int threads) {
  const RepairedView repaired(view, threads);
  const SceneImage& image = repaired.image();
  std::vector<LumaLimits> rows(static_cast<std::size_t>(image.height()));
  parallel_for(image.height(), kRowGrain, threads, [&](int begin, int end) {
    RowBuffers buffers;
    std::vector<Rgb> response(static_cast<std::size_t>(image.width()));
    for (int y = begin; y < end; ++y) {
      respond_row(parameters, row_of(image, y), response, buffers);
      rows[static_cast<std::size_t>(y)] = row_limits(response);
    }
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
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts& counts) {
        respond_row(parameters, scene, out, buffers);
        normalisation.map_row(out, counts);
      });
}

}  // namespace plenolab
