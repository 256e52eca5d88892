#include "core/tonemap/photoreceptor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/photoreceptor.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

/// The receptor in single precision. V is formed of quarters, so that the sum in its denominator stays
/// finite.
class RowReceptor {
 public:
  explicit RowReceptor(const Photoreceptor& r)
      : exposure_(static_cast<float>(r.exposure)),
        contrast_(static_cast<float>(r.contrast)),
        scaled_factor_(static_cast<float>(0.25 * std::pow(r.factor, r.contrast))),
        own_colour_(static_cast<float>(r.light_adaptation * r.colour_adaptation)),
        own_luminance_(static_cast<float>(r.light_adaptation * (1 - r.colour_adaptation))) {
    for (std::size_t i = 0; i < 3; ++i)
      global_[i] = static_cast<float>((1 - r.light_adaptation) * r.global[i]);
  }

  /// Whether all channels of a pixel share one adaptation level.
  bool grey_level() const { return own_colour_ == 0 && global_[0] == global_[1] && global_[1] == global_[2]; }

  HWY_INLINE Vec Scaled(Vec value) const { return hn::Min(hn::Mul(value, C(exposure_)), C(kLargest)); }

  /// ¼·(factor·I_a)^m for channel i.
  HWY_INLINE Vec Adapted(Vec channel, Vec luminance, std::size_t i) const {
    const Vec own = MulThenAdd(C(own_colour_), channel, hn::Mul(C(own_luminance_), luminance));
    return hn::Mul(C(scaled_factor_), Pow(hn::Min(hn::Add(own, C(global_[i])), C(kLargest)), contrast_));
  }

  HWY_INLINE Vec Response(Vec channel, Vec adapted) const {
    const Vec quarter = hn::Mul(C(0.25f), channel);
    const LaneMask lit = hn::Gt(quarter, hn::Zero(Floats()));
    const Vec sum = hn::IfThenElse(lit, hn::Add(quarter, adapted), C(1.0f));
    return hn::IfThenElseZero(lit, hn::Div(quarter, sum));
  }

 private:
  float exposure_, contrast_, scaled_factor_;
  float own_colour_, own_luminance_;  // weights of C[i] and L in I_a
  float global_[3];                   // (1 − l)·I_global
};

LumaRange RespondRow(const Photoreceptor& receptor, const Rgb* scene, Rgb* out, std::size_t count) {
  const Floats d;
  const RowReceptor row(receptor);
  const bool grey = row.grey_level();
  Vec low = C(2.0f), high = C(-1.0f);
  VisitPixels(scene, count, [&](Vec r, Vec g, Vec b, std::size_t i, LaneMask valid) {
    const Vec light = row.Scaled(Luminance(r, g, b));
    r = row.Scaled(r), g = row.Scaled(g), b = row.Scaled(b);
    const Vec shared = row.Adapted(r, light, 0);
    r = row.Response(r, shared);
    g = row.Response(g, grey ? shared : row.Adapted(g, light, 1));
    b = row.Response(b, grey ? shared : row.Adapted(b, light, 2));
    StorePixels(r, g, b, out, i, count);
    const Vec luma = Luminance(r, g, b);
    low = hn::Min(low, hn::IfThenElse(valid, luma, low));
    high = hn::Max(high, hn::IfThenElse(valid, luma, high));
  });
  return {hn::GetLane(hn::MinOfLanes(d, low)), hn::GetLane(hn::MaxOfLanes(d, high))};
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(RespondRow);
}

LumaRange respond_row(const Photoreceptor& receptor, std::span<const Rgb> scene, std::span<Rgb> out) {
  PLENOLAB_CHECK(scene.size() == out.size(), "rows of equal length");
  return HWY_DYNAMIC_DISPATCH(RespondRow)(receptor, scene.data(), out.data(), scene.size());
}

double respond_to_grey(const Photoreceptor& r, double luminance) {
  const double c = r.exposure * luminance;
  if (!(c > 0)) return 0;
  const double level = r.light_adaptation * c + (1 - r.light_adaptation) * r.global[0];
  return c / (c + std::pow(r.factor * level, r.contrast));
}

double contrast_of(double log_min, double log_average, double log_max) {
  const double range = log_max - log_min;
  const double k = range > 0 ? std::clamp((log_max - log_average) / range, 0.0, 1.0) : 0.5;
  return 0.3 + 0.7 * std::pow(k, 1.4);
}

void validate_photoreceptor(double brightness, double colour_adaptation, double light_adaptation) {
  if (!(std::abs(brightness) <= 8))
    throw InputError(fmt::format("the brightness must lie in [-8, 8], not {}", brightness));
  if (!(colour_adaptation >= 0 && colour_adaptation <= 1))
    throw InputError(fmt::format("the colour adaptation must lie in [0, 1], not {}", colour_adaptation));
  if (!(light_adaptation >= 0 && light_adaptation <= 1))
    throw InputError(fmt::format("the light adaptation must lie in [0, 1], not {}", light_adaptation));
}

}  // namespace plenolab
#endif
