#include "core/tonemap/curve_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/curve_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

HWY_INLINE Vec ToUnit(Vec v) {
  return hn::Min(hn::Max(v, hn::Zero(Floats())), C(1.0f));
}

CutCounts NormaliseRow(Rgb* row, float offset, float gain, std::size_t count) {
  const Floats d;
  CutCounts cut;
  MapRow(FloatsOf(row), FloatsOf(row), 3 * count, [&](Vec v, LaneMask valid) {
    const Vec mapped = hn::Mul(hn::Sub(v, C(offset)), C(gain));
    cut.high += static_cast<std::int64_t>(hn::CountTrue(d, hn::And(valid, hn::Gt(mapped, C(1.0f)))));
    cut.low += static_cast<std::int64_t>(hn::CountTrue(d, hn::And(valid, hn::Lt(mapped, hn::Zero(d)))));
    return ToUnit(mapped);
  });
  return cut;
}

void ThreeLinesRow(Rgb* row, const ThreeLines& lines, std::size_t count) {
  const auto slope = [](float width, float height) { return width > 0 ? height / width : 0.0f; };
  const float toe = slope(lines.low, lines.luma_low);
  const float middle = slope(lines.high - lines.low, lines.luma_high - lines.luma_low);
  const float shoulder = slope(1 - lines.high, 1 - lines.luma_high);
  MapRow(FloatsOf(row), FloatsOf(row), 3 * count, [&](Vec v, LaneMask) {
    const Vec inside = MulThenAdd(C(middle), hn::Sub(v, C(lines.low)), C(lines.luma_low));
    const Vec above = MulThenAdd(C(shoulder), hn::Sub(v, C(lines.high)), C(lines.luma_high));
    const Vec lower = hn::IfThenElse(hn::Lt(v, C(lines.low)), hn::Mul(C(toe), v), inside);
    return ToUnit(hn::IfThenElse(hn::Lt(v, C(lines.high)), lower, above));
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(NormaliseRow);
HWY_EXPORT(ThreeLinesRow);
}  // namespace

CutCounts normalise_row(std::span<Rgb> row, float offset, float gain) {
  return HWY_DYNAMIC_DISPATCH(NormaliseRow)(row.data(), offset, gain, row.size());
}

void three_lines_row(std::span<Rgb> row, const ThreeLines& lines) {
  HWY_DYNAMIC_DISPATCH(ThreeLinesRow)(row.data(), lines, row.size());
}

}  // namespace plenolab
#endif
