#include "core/tonemap/reinhard_global.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

/// L_d of scene luminance; beyond the white point above 1.
void curve_row(std::span<float> luminance, float scale, float inverse_white_squared) {
  constexpr float kHuge = 1e18f;  // L_s² must stay finite
  for (float& l : luminance) {
    const float s = std::min(l * scale, kHuge);
    l = s * (1 + s * inverse_white_squared) / (1 + s);
  }
}

}  // namespace

void ReinhardGlobalOptions::validate() const {
  if (!(key > 0 && key <= 4)) throw InputError(fmt::format("the key must lie in (0, 4], not {}", key));
  if (!(white > 0 && white <= 1e9))
    throw InputError(fmt::format("the white point must lie in (0, 1e9], not {}", white));
  if (!(colour_exponent >= 0 && colour_exponent <= 1))
    throw InputError(fmt::format("the colour exponent must lie in [0, 1], not {}", colour_exponent));
}

double automatic_key(const ImageStatistics& s) {
  const double range = s.log_p99 - s.log_p1;
  if (!(range > 0)) return 0.18;
  const double average = std::clamp(s.log_average, s.log_p1, s.log_p99);
  return 0.18 * std::pow(4.0, (2 * average - s.log_p1 - s.log_p99) / range);
}

double reinhard_curve(double scaled, std::optional<double> white) {
  if (!white) return scaled / (1 + scaled);
  return scaled * (1 + scaled / (*white * *white)) / (1 + scaled);
}

ReinhardGlobalParameters fit(const ReinhardGlobalOptions& options, const ImageStatistics& statistics) {
  options.validate();
  ReinhardGlobalParameters p;
  p.key = options.automatic_key ? automatic_key(statistics) : options.key;
  p.log_average = statistics.log_average;
  if (options.white_point) p.white = options.white;
  p.colour_exponent = options.colour_exponent;
  return p;
}

ToneMapped apply(const ReinhardGlobalParameters& p, const SceneImage& view, int threads) {
  // Between the ends of float, so that neither a dark nor a bright light field gives 0·∞; its smallest values
  // have few digits, but are right for the brightest light fields.
  const float scale = static_cast<float>(std::clamp(p.key * std::pow(10.0, -p.log_average), 1e-44, 3e38));
  const float bend = p.white ? static_cast<float>(std::min(1 / (*p.white * *p.white), 1e18)) : 0.0f;
  return map_rows(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts& counts) {
        buffers.a.resize(scene.size());
        luminance_row(scene, buffers.a);
        curve_row(buffers.a, scale, bend);
        power_row(buffers.a, 1 / 2.2f, buffers.a);
        counts.clipped_high += apply_colour_ratio(scene, buffers.a, p.colour_exponent, out);
      });
}

}  // namespace plenolab
