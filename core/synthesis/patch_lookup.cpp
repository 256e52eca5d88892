// Colour, disparity and disparity range at the hits of a patch. Where four neighbouring pixels hit four
// neighbouring pixels of the key view, they are fetched and interpolated together.

#include <algorithm>
#include <cstdint>

#include "core/synthesis/patch_blend.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/synthesis/patch_lookup.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/synthesis/look_up_pixel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kTogether = 4;

using Channels = hn::CappedTag<float, 4 * kTogether>;  ///< r, g, b, disparity of as many pixels as fit
using ChannelVec = hn::Vec<Channels>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Channels()));

HWY_INLINE void LookUpOne(const PreparedView& prepared, int n, PatchView& view) {
  const Hit hit = view.hits.get(n);
  if (hit.found()) {
    LookUpPixel(prepared, hit, view.colour_disparity + 4 * n, view.range + n);
  } else {
    std::fill_n(view.colour_disparity + 4 * n, 4, 0.0f);
    view.range[n] = 0;
  }
}

/// Whether the hits from n on are neighbours in a row, away from the last column and row.
HWY_INLINE bool AreNeighbours(const PreparedView& prepared, const PatchHits& hits, int n) {
  const std::int32_t i = hits.i[n], j = hits.j[n];
  if (i < 0 || i + kTogether >= prepared.width || j + 1 >= prepared.height) return false;
  std::int32_t apart = 0;
  for (int p = 1; p < kTogether; ++p) apart |= (hits.i[n + p] - i - p) | (hits.j[n + p] - j);
  return apart == 0;
}

/// A value per pixel, repeated for its four channels; `pixels` are the indices of the pixels.
template <class Indices>
HWY_INLINE ChannelVec Spread(const float* values, Indices pixels) {
  const Channels d;
  return hn::TableLookupLanes(hn::LoadDup128(d, values), pixels);
}

HWY_INLINE void LookUpNeighbours(const PreparedView& prepared, int n, PatchView& view) {
  const Channels d;
  alignas(64) static constexpr std::int32_t kPixels[4 * kTogether] = {0, 0, 0, 0, 1, 1, 1, 1,
                                                                      2, 2, 2, 2, 3, 3, 3, 3};
  const float* corner = reinterpret_cast<const float*>(&prepared.pixels.at(view.hits.i[n], view.hits.j[n]));
  const float* below = corner + 4 * static_cast<std::size_t>(prepared.width);
  alignas(64) float range[4 * kTogether];
  for (int at = 0; at < 4 * kTogether; at += kLanes) {
    const auto pixels = hn::SetTableIndices(d, kPixels + at);
    const auto fx = Spread(view.hits.fx + n, pixels), fy = Spread(view.hits.fy + n, pixels);
    const auto has_right = hn::Gt(fx, hn::Zero(d)), has_below = hn::Gt(fy, hn::Zero(d));
    const auto c00 = hn::LoadU(d, corner + at);
    const auto c10 = hn::IfThenElse(has_right, hn::LoadU(d, corner + at + 4), c00);
    const auto c01 = hn::IfThenElse(has_below, hn::LoadU(d, below + at), c00);
    const auto c11 =
        hn::IfThenElse(has_below, hn::IfThenElse(has_right, hn::LoadU(d, below + at + 4), c01), c10);
    const auto upper = hn::Add(c00, hn::Mul(fx, hn::Sub(c10, c00)));
    const auto lower = hn::Add(c01, hn::Mul(fx, hn::Sub(c11, c01)));
    hn::Store(hn::Add(upper, hn::Mul(fy, hn::Sub(lower, upper))), d, view.colour_disparity + 4 * n + at);
    const auto high = hn::Max(hn::Max(c00, c10), hn::Max(c01, c11));
    const auto low = hn::Min(hn::Min(c00, c10), hn::Min(c01, c11));
    hn::Store(hn::Sub(high, low), d, range + at);
  }
  for (int p = 0; p < kTogether; ++p) view.range[n + p] = range[4 * p + 3];
}

void LookUp(const PreparedView& prepared, const Patch& patch, PatchView& view) {
  for (int y = 0; y < patch.height; ++y) {
    int n = y * Patch::kMaxWidth;
    const int end = n + patch.width;
    if constexpr (kLanes > 4) {
      for (; n + kTogether <= end; n += kTogether) {
        if (AreNeighbours(prepared, view.hits, n))
          LookUpNeighbours(prepared, n, view);
        else
          for (int p = 0; p < kTogether; ++p) LookUpOne(prepared, n + p, view);
      }
    }
    for (; n < end; ++n) LookUpOne(prepared, n, view);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {
HWY_EXPORT(LookUp);
}  // namespace

void look_up_patch(const PreparedView& prepared, const Patch& patch, PatchView& view) {
  HWY_DYNAMIC_DISPATCH(LookUp)(prepared, patch, view);
}

}  // namespace plenolab
#endif  // HWY_ONCE
