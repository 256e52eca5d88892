#include "core/tonemap/robust_adaptive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/curve_rows.h"
#include "core/tonemap/map_rows.h"

namespace plenolab {

namespace {

void check_share(const char* name, double value) {
  if (!(value >= 0 && value <= 0.4))
    throw InputError(fmt::format("the {} must lie in [0, 0.4], not {}", name, value));
}

constexpr double kLargestContrast = 0.9;
/// Views under even light, with small bright surfaces, have their arithmetic mean up to a decade above the
/// log average; more takes a light source.
constexpr double kWithoutGlare_log10 = 1;

/// Moves the lumas of the knots together around their centre where they would rise too fast.
void limit_slope(double most, RobustAdaptiveParameters& p) {
  if (p.luma_high - p.luma_low <= most) return;
  const double centre = (p.luma_low + p.luma_high) / 2;
  p.luma_low = centre - most / 2;
  p.luma_high = centre + most / 2;
}

/// Lowers everything between the knots by log10 units of display luminance.
void dim(double by_log10, RobustAdaptiveParameters& p) {
  p.dimming = by_log10;
  const double factor = std::pow(10, -by_log10 / 2.2);
  p.luma_low *= factor;
  p.luma_high *= factor;
}

ThreeLines lines_of(const RobustAdaptiveParameters& p) {
  return {static_cast<float>(p.knot_low), static_cast<float>(p.luma_low), static_cast<float>(p.knot_high),
          static_cast<float>(p.luma_high)};
}

}  // namespace

void RobustAdaptiveOptions::validate() const {
  validate_photoreceptor(brightness, colour_adaptation, light_adaptation);
  check_share("toe", toe);
  check_share("shoulder", shoulder);
  if (!(colour_exponent >= 0 && colour_exponent <= 1))
    throw InputError(
        fmt::format("the exponent of the colour ratio must lie in [0, 1], not {}", colour_exponent));
  if (!(max_slope >= 0.05 && max_slope <= 10))
    throw InputError(
        fmt::format("the largest slope must lie in [0.05, 10] luma per log10 unit, not {}", max_slope));
  if (!(glare >= 0 && glare <= 0.5))
    throw InputError(
        fmt::format("the effect of glare must lie in [0, 0.5] log10 units a decade, not {}", glare));
}

double log_eye_average(double eye_average, const ImageStatistics& statistics) {
  return eye_average > 0 ? std::log10(eye_average) : statistics.log_robust_average;
}

RobustAdaptiveParameters fit(const RobustAdaptiveOptions& options, const ImageStatistics& s,
                             double log_eye_average) {
  options.validate();
  RobustAdaptiveParameters p;
  // Within the range of float; statistics beyond 1e±37 keep their ratio to each other.
  const double log_average = std::clamp(s.log_robust_average, -37.0, 37.0);
  p.receptor.exposure = std::pow(10.0, -log_average);
  p.receptor.contrast = std::min(kLargestContrast, contrast_of(s.log_p1, s.log_robust_average, s.log_p99));
  p.receptor.factor = std::exp(-options.brightness);
  p.receptor.colour_adaptation = options.colour_adaptation;
  p.receptor.light_adaptation = options.light_adaptation;
  p.receptor.global = {1, 1, 1};
  p.colour_exponent = options.colour_exponent;
  p.luma_low = options.toe;
  p.luma_high = 1 - options.shoulder;
  p.knot_low = respond_to_grey(p.receptor, std::pow(10.0, s.log_p1));
  p.knot_high = respond_to_grey(p.receptor, std::pow(10.0, s.log_p99));
  limit_slope(options.max_slope * (s.log_p99 - s.log_p1), p);
  dim(options.glare * std::max(0.0, log_eye_average - s.log_robust_average - kWithoutGlare_log10), p);
  return p;
}

ToneMapped apply(const RobustAdaptiveParameters& p, const SceneImage& view, int threads) {
  const ThreeLines lines = lines_of(p);
  return map_rows(view, threads,
                  [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers&, MappingCounts&) {
                    respond_row(p.receptor, scene, out);
                    three_lines_row(out, lines, p.colour_exponent);
                  });
}

}  // namespace plenolab
