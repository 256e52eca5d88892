#include "core/tonemap/adjustment/accumulate_luma.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/adjustment/accumulate_luma.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/filters/gaussian-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using LumaTag = hn::CappedTag<float, 16>;
using LumaVec = hn::Vec<LumaTag>;

/// The pixels from x on that a vector holds; those beyond the end of the row are the last pixel again.
template <class D>
HWY_INLINE LumaVec LoadRow(D d, const float* row, int x, int width) {
  const auto left = static_cast<std::size_t>(width - x);
  if (left >= hn::Lanes(d)) return hn::LoadU(d, row + x);
  HWY_ALIGN float copy[16];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i)
    copy[i] = row[std::min(static_cast<std::size_t>(x) + i, static_cast<std::size_t>(width) - 1)];
  return hn::Load(d, copy);
}

template <class D>
HWY_INLINE void AddRow(D d, LumaVec v, float* row, int x, int width) {
  const auto left = static_cast<std::size_t>(width - x);
  if (left >= hn::Lanes(d)) return hn::StoreU(hn::Add(hn::LoadU(d, row + x), v), d, row + x);
  HWY_ALIGN float terms[16];
  hn::Store(v, d, terms);
  for (std::size_t i = 0; i < left; ++i) row[static_cast<std::size_t>(x) + i] += terms[i];
}

/// Nearest pixels of a vector of pixels in another view.
struct Found {
  hn::Mask<LumaTag> inside;
  hn::Vec<hn::RebindToSigned<LumaTag>> index;  ///< 0 where not inside
};

/// Coordinates are compared before they become integers: no disparity is too large.
HWY_INLINE Found Find(const LumaSource& source, LumaVec disparity, int x, int y) {
  const LumaTag d;
  const hn::RebindToSigned<LumaTag> di;
  const int width = source.view.luma.width(), height = source.view.luma.height();
  const LumaVec column = hn::ConvertTo(d, hn::Iota(di, x)), row = hn::Set(d, static_cast<float>(y));
  const auto nearest = [&](LumaVec p, float step) {
    return hn::Floor(hn::Add(hn::Add(p, hn::Mul(hn::Set(d, step), disparity)), hn::Set(d, 0.5f)));
  };
  const LumaVec qx = nearest(column, source.step.x), qy = nearest(row, source.step.y);
  const auto within = [&](LumaVec q, int size) {
    return hn::And(hn::Ge(q, hn::Zero(d)), hn::Lt(q, hn::Set(d, static_cast<float>(size))));
  };
  const auto inside = hn::And(hn::And(within(qx, width), within(qy, height)),
                              hn::Lt(column, hn::Set(d, static_cast<float>(width))));
  const auto ix = hn::ConvertTo(di, hn::IfThenElseZero(inside, qx));
  const auto iy = hn::ConvertTo(di, hn::IfThenElseZero(inside, qy));
  return {inside, hn::Add(hn::Mul(iy, hn::Set(di, width)), ix)};
}

std::int64_t AccumulateRow(const AdjustmentView& target, const LumaSource& source,
                           const LumaExponents& exponents, int y, LumaSums& sums) {
  const LumaTag d;
  const int width = target.luma.width();
  std::int64_t found_pixels = 0;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const LumaVec disparity = LoadRow(d, target.disparity.row(y), x, width);
    const Found found = Find(source, disparity, x, y);
    if (hn::AllFalse(d, found.inside)) continue;
    const auto at = [&](const Plane<float>& plane) { return hn::GatherIndex(d, plane.row(0), found.index); };
    const LumaVec depth = hn::Sub(at(source.view.disparity), disparity);
    const LumaVec light =
        hn::Sub(at(source.view.log_luminance), LoadRow(d, target.log_luminance.row(y), x, width));
    const LumaVec e = hn::Add(hn::Add(hn::Set(d, source.distance_exponent),
                                      hn::Mul(hn::Mul(depth, depth), hn::Set(d, exponents.disparity))),
                              hn::Mul(hn::Mul(light, light), hn::Set(d, exponents.log_luminance)));
    const LumaVec weight = hn::IfThenElseZero(found.inside, NegativeExp2(d, e));
    AddRow(d, weight, sums.weight.row(y), x, width);
    const LumaVec luma = hn::Sub(at(source.view.luma), LoadRow(d, target.luma.row(y), x, width));
    AddRow(d, hn::Mul(weight, luma), sums.difference.row(y), x, width);
    found_pixels += static_cast<std::int64_t>(hn::CountTrue(d, found.inside));
  }
  return found_pixels;
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {
HWY_EXPORT(AccumulateRow);
}  // namespace

std::int64_t accumulate_row(const AdjustmentView& target, const LumaSource& source,
                            const LumaExponents& exponents, int y, LumaSums& sums) {
  return HWY_DYNAMIC_DISPATCH(AccumulateRow)(target, source, exponents, y, sums);
}

}  // namespace plenolab
#endif  // HWY_ONCE
