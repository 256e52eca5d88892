// What a key view shows at one A; compiled once per instruction set (Highway).

#if defined(PLENOLAB_LOOK_UP_PIXEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PLENOLAB_LOOK_UP_PIXEL_INL_H
#undef PLENOLAB_LOOK_UP_PIXEL_INL_H
#else
#define PLENOLAB_LOOK_UP_PIXEL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "core/synthesis/prepared_view.h"
#include "core/synthesis/search.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void LookUpPixel(const PreparedView& prepared, const Hit& hit, float* colour_disparity,
                            float* range) {
  const float* corner = reinterpret_cast<const float*>(&prepared.pixels.at(hit.i, hit.j));
  const std::size_t right = hit.fx > 0 ? 4 : 0;  // corners of zero weight repeat their neighbour
  const std::size_t below = hit.fy > 0 ? 4 * static_cast<std::size_t>(prepared.width) : 0;
  for (std::size_t n = 0; n < 4; ++n) {
    const float c00 = corner[n], c10 = corner[right + n], c01 = corner[below + n],
                c11 = corner[below + right + n];
    const float upper = c00 + hit.fx * (c10 - c00), lower = c01 + hit.fx * (c11 - c01);
    colour_disparity[n] = upper + hit.fy * (lower - upper);
    *range =
        std::max(std::max(c00, c10), std::max(c01, c11)) - std::min(std::min(c00, c10), std::min(c01, c11));
  }
}
#else
/// One pixel is one vector: r, g, b, disparity.
HWY_INLINE void LookUpPixel(const PreparedView& prepared, const Hit& hit, float* colour_disparity,
                            float* range) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 4> d;
  const float* corner = reinterpret_cast<const float*>(&prepared.pixels.at(hit.i, hit.j));
  const std::size_t right = hit.fx > 0 ? 4 : 0;  // corners of zero weight repeat their neighbour
  const std::size_t below = hit.fy > 0 ? 4 * static_cast<std::size_t>(prepared.width) : 0;
  const auto c00 = hn::Load(d, corner), c10 = hn::Load(d, corner + right);
  const auto c01 = hn::Load(d, corner + below), c11 = hn::Load(d, corner + below + right);
  const auto fx = hn::Set(d, hit.fx);
  const auto upper = hn::Add(c00, hn::Mul(fx, hn::Sub(c10, c00)));
  const auto lower = hn::Add(c01, hn::Mul(fx, hn::Sub(c11, c01)));
  hn::Store(hn::Add(upper, hn::Mul(hn::Set(d, hit.fy), hn::Sub(lower, upper))), d, colour_disparity);
  const auto high = hn::Max(hn::Max(c00, c10), hn::Max(c01, c11));
  const auto low = hn::Min(hn::Min(c00, c10), hn::Min(c01, c11));
  *range = hn::ExtractLane(hn::Sub(high, low), 3);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#endif
