#include "core/tonemap/colour_ratio.h"

#include "core/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/colour_ratio.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

/// min(luma·ratio^exponent, 1), counting what is cut.
class RatioMap {
 public:
  explicit RatioMap(float exponent) : exponent_(exponent) {}

  /// One channel that stands for `channels` equal ones.
  HWY_INLINE Vec Channel(Vec channel, Vec luminance, Vec luma, LaneMask valid, std::int64_t channels = 1) {
    const Floats d;
    const LaneMask lit = hn::Gt(luminance, hn::Zero(d));
    // Where L = 0 the ratio is 1; the divisor then only keeps the division defined.
    const Vec ratio = hn::IfThenElse(lit, hn::Div(channel, hn::IfThenElse(lit, luminance, C(1.0f))), C(1.0f));
    const Vec value = hn::Mul(luma, exponent_ == 1 ? ratio : Pow(ratio, exponent_));
    clipped_ +=
        channels * static_cast<std::int64_t>(hn::CountTrue(d, hn::And(valid, hn::Gt(value, C(1.0f)))));
    return hn::Min(value, C(1.0f));
  }

  std::int64_t clipped() const { return clipped_; }

 private:
  float exponent_;
  std::int64_t clipped_ = 0;
};

std::int64_t ColourRatioRow(const Rgb* scene, const float* luma, float exponent, Rgb* out, std::size_t count,
                            bool prune) {
  RatioMap map(exponent);
  VisitPixels(scene, count, [&](Vec r, Vec g, Vec b, std::size_t i, LaneMask valid) {
    const Vec light = Luminance(r, g, b), level = LoadLanes(luma, i, count);
    if (prune && hn::AllTrue(Floats(), hn::And(hn::Eq(r, g), hn::Eq(g, b)))) {
      r = map.Channel(r, light, level, valid, 3);
      StorePixels(r, r, r, out, i, count);
      return;
    }
    r = map.Channel(r, light, level, valid);
    g = map.Channel(g, light, level, valid);
    b = map.Channel(b, light, level, valid);
    StorePixels(r, g, b, out, i, count);
  });
  return map.clipped();
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(ColourRatioRow);
}

std::int64_t apply_colour_ratio(std::span<const Rgb> scene, std::span<const float> luma, double exponent,
                                std::span<Rgb> out, bool prune) {
  PLENOLAB_CHECK(scene.size() == luma.size() && scene.size() == out.size(), "rows of equal length");
  return HWY_DYNAMIC_DISPATCH(ColourRatioRow)(scene.data(), luma.data(), static_cast<float>(exponent),
                                              out.data(), scene.size(), prune);
}

}  // namespace plenolab
#endif
