#include "core/tonemap/pq_operator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

// SMPTE ST 2084:2014, section 5.2.
constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 32, kC1 = 3424.0 / 4096, kC2 = 2413.0 / 128,
                 kC3 = 2392.0 / 128, kUnit_cd_m2 = 10000;

void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw InputError(fmt::format("{} must lie in [{:g}, {:g}], not {}", name, low, high, value));
}

/// In double: single precision loses digits in x^78.8. Black stays black, though V(0) is 7e-7.
void signal_row(std::span<float> luminance, double scale, double inverse_peak_signal) {
  for (float& l : luminance)
    l = l > 0 ? static_cast<float>(std::min(pq_signal(l * scale) * inverse_peak_signal, 1.0)) : 0.0f;
}

}  // namespace

void PqOptions::validate() const {
  check_range("the peak", peak_cd_m2, 1e-6, 1e6);
  check_range("the luminance of radiance 1", cd_m2_per_unit, 1e-12, 1e12);
  check_range("the colour exponent", colour_exponent, 0, 1);
}

double pq_signal(double luminance_cd_m2) {
  const double y = std::pow(std::max(luminance_cd_m2, 0.0) / kUnit_cd_m2, kM1);
  return std::pow((kC1 + kC2 * y) / (1 + kC3 * y), kM2);
}

double pq_luminance(double signal) {
  const double v = std::pow(std::max(signal, 0.0), 1 / kM2);
  return 1e4 * std::pow(std::max(v - kC1, 0.0) / (kC2 - kC3 * v), 1 / kM1);
}

ToneMapped apply(const PqOptions& options, const SceneImage& view, int threads) {
  options.validate();
  const double inverse_peak_signal = 1 / pq_signal(options.peak_cd_m2);
  return map_rows(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts& counts) {
        buffers.a.resize(scene.size());
        luminance_row(scene, buffers.a);
        signal_row(buffers.a, options.cd_m2_per_unit, inverse_peak_signal);
        counts.clipped_high += apply_colour_ratio(scene, buffers.a, options.colour_exponent, out);
      });
}

}  // namespace plenolab
