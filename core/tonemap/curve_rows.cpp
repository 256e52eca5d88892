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

/// A point of the three lines.
class LinesMap {
 public:
  explicit LinesMap(const ThreeLines& lines)
      : lines_(lines),
        toe_(Slope(lines.low, lines.luma_low)),
        middle_(Slope(lines.high - lines.low, lines.luma_high - lines.luma_low)),
        shoulder_(Slope(1 - lines.high, 1 - lines.luma_high)) {}

  HWY_INLINE Vec operator()(Vec v) const {
    const Vec inside = MulThenAdd(C(middle_), hn::Sub(v, C(lines_.low)), C(lines_.luma_low));
    const Vec above = MulThenAdd(C(shoulder_), hn::Sub(v, C(lines_.high)), C(lines_.luma_high));
    const Vec lower = hn::IfThenElse(hn::Lt(v, C(lines_.low)), hn::Mul(C(toe_), v), inside);
    return ToUnit(hn::IfThenElse(hn::Lt(v, C(lines_.high)), lower, above));
  }

 private:
  static float Slope(float width, float height) { return width > 0 ? height / width : 0.0f; }
  ThreeLines lines_;
  float toe_, middle_, shoulder_;
};

void ThreeLinesRow(Rgb* row, const ThreeLines& lines, float exponent, std::size_t count) {
  const LinesMap map(lines);
  VisitPixels(row, count, [&](Vec r, Vec g, Vec b, std::size_t i, LaneMask) {
    const Vec luma = Luminance(r, g, b), target = map(luma);
    const auto lit = hn::Gt(luma, hn::Zero(Floats()));
    const Vec divisor = hn::IfThenElse(lit, luma, C(1.0f));
    const auto channel = [&](Vec v) {
      const Vec ratio = hn::IfThenElse(lit, hn::Div(v, divisor), C(1.0f));
      return hn::Mul(target, exponent == 1 ? ratio : Pow(ratio, exponent));
    };
    const Vec red = channel(r), green = channel(g), blue = channel(b);
    const Vec peak = hn::Max(red, hn::Max(green, blue));
    // What does not fit is drawn towards grey of the same luma until its largest channel is 1.
    const Vec kept = hn::IfThenElse(hn::Gt(peak, C(1.0f)),
                                    hn::Div(hn::Sub(C(1.0f), target), hn::Sub(peak, target)), C(1.0f));
    const auto drawn = [&](Vec v) { return ToUnit(MulThenAdd(kept, hn::Sub(v, target), target)); };
    StorePixels(drawn(red), drawn(green), drawn(blue), row, i, count);
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

void three_lines_row(std::span<Rgb> row, const ThreeLines& lines, double colour_exponent) {
  HWY_DYNAMIC_DISPATCH(ThreeLinesRow)(row.data(), lines, static_cast<float>(colour_exponent), row.size());
}

}  // namespace plenolab
#endif
