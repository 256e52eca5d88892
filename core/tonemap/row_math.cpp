#include "core/tonemap/row_math.h"

#include <algorithm>
#include <cstddef>

#include "core/base/error.h"
#include "core/image/colour.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/row_math.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Vec = hn::Vec<Floats>;

constexpr float kLargest = 3.402823466e38f;

HWY_INLINE Vec C(float value) {
  return hn::Set(Floats(), value);
}

/// a·b + c in two roundings, so that instruction sets with and without fused operations agree.
HWY_INLINE Vec MulThenAdd(Vec a, Vec b, Vec c) {
  return hn::Add(hn::Mul(a, b), c);
}

/// ln(1 + f) for 1 + f in [√½, √2): polynomial of Cephes' logf (Moshier 1992).
HWY_INLINE Vec LogOfOnePlus(Vec f) {
  const Vec square = hn::Mul(f, f);
  Vec p = C(7.0376836292e-2f);
  for (const float coefficient : {-1.1514610310e-1f, 1.1676998740e-1f, -1.2420140846e-1f, 1.4249322787e-1f,
                                  -1.6668057665e-1f, 2.0000714765e-1f, -2.4999993993e-1f, 3.3333331174e-1f})
    p = MulThenAdd(p, f, C(coefficient));
  const Vec tail = hn::Sub(hn::Mul(hn::Mul(p, f), square), hn::Mul(C(0.5f), square));
  return hn::Add(f, tail);
}

/// log2 of x > 0: exponent and mantissa apart.
HWY_INLINE Vec Log2(Vec x) {
  const Floats d;
  const Ints di;
  const auto denormal = hn::Lt(x, C(1.17549435e-38f));
  const Vec normal = hn::IfThenElse(denormal, hn::Mul(x, C(16777216.0f)), x);
  // Mantissa in [√½, √2): subtracting √½'s bits makes the exponent field round at √2.
  const auto bits = hn::BitCast(di, normal);
  const auto kRootHalf = hn::Set(di, 0x3f3504f3);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, kRootHalf));
  const Vec mantissa = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const Vec whole = hn::Sub(hn::ConvertTo(d, exponent), hn::IfThenElseZero(denormal, C(24.0f)));
  return MulThenAdd(LogOfOnePlus(hn::Sub(mantissa, C(1.0f))), C(1.44269504f), whole);
}

/// 2^t: polynomial of Cephes' exp2f for the fraction in [−½, ½].
HWY_INLINE Vec Exp2(Vec t) {
  const Floats d;
  const Vec cut = hn::Min(hn::Max(t, C(-126.0f)), C(128.0f));
  const auto whole = hn::NearestInt(cut);
  const Vec f = hn::Sub(cut, hn::ConvertTo(d, whole));
  Vec p = C(1.535336188319500e-4f);
  for (const float coefficient : {1.339887440266574e-3f, 9.618437357674640e-3f, 5.550332471162809e-2f,
                                  2.402264791363012e-1f, 6.931472028550421e-1f, 1.0f})
    p = MulThenAdd(p, f, C(coefficient));
  // 2^(whole − 1)·2: the factor itself must not overflow.
  const auto scale = hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(whole, hn::Set(Ints(), 126))));
  const Vec power = hn::Min(hn::Mul(hn::Mul(p, scale), C(2.0f)), C(kLargest));
  return hn::IfThenElseZero(hn::Ge(t, C(-125.0f)), power);
}

/// out = function(x); the last vector is filled up with ones.
template <class Function>
HWY_INLINE void MapRow(const float* x, float* out, std::size_t count, const Function& function) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(function(hn::LoadU(d, x + i)), d, out + i);
  if (i == count) return;
  HWY_ALIGN float buffer[hn::MaxLanes(Floats())];
  std::fill(buffer, buffer + lanes, 1.0f);
  std::copy(x + i, x + count, buffer);
  hn::Store(function(hn::Load(d, buffer)), d, buffer);
  std::copy(buffer, buffer + (count - i), out + i);
}

void Log10Row(const float* x, float* out, std::size_t count) {
  MapRow(x, out, count, [](Vec v) { return hn::Mul(Log2(v), C(0.301029996f)); });
}

void Exp10Row(const float* x, float* out, std::size_t count) {
  MapRow(x, out, count, [](Vec v) { return Exp2(hn::Mul(v, C(3.321928095f))); });
}

void PowerRow(const float* x, float p, float* out, std::size_t count) {
  const Vec at_zero = C(p == 0 ? 1.0f : 0.0f);
  MapRow(x, out, count, [p, at_zero](Vec v) {
    const Vec power = Exp2(hn::Mul(Log2(v), C(p)));
    return hn::IfThenElse(hn::Gt(v, hn::Zero(Floats())), power, at_zero);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(Log10Row);
HWY_EXPORT(Exp10Row);
HWY_EXPORT(PowerRow);
}  // namespace

void log10_row(std::span<const float> x, std::span<float> out) {
  PLENOLAB_CHECK(x.size() == out.size(), "rows of equal length");
  HWY_DYNAMIC_DISPATCH(Log10Row)(x.data(), out.data(), x.size());
}

void exp10_row(std::span<const float> x, std::span<float> out) {
  PLENOLAB_CHECK(x.size() == out.size(), "rows of equal length");
  HWY_DYNAMIC_DISPATCH(Exp10Row)(x.data(), out.data(), x.size());
}

void power_row(std::span<const float> x, float p, std::span<float> out) {
  PLENOLAB_CHECK(x.size() == out.size() && p >= 0, "rows of equal length, exponent ≥ 0");
  HWY_DYNAMIC_DISPATCH(PowerRow)(x.data(), p, out.data(), x.size());
}

void luminance_row(std::span<const Rgb> c, std::span<float> out) {
  PLENOLAB_CHECK(c.size() == out.size(), "rows of equal length");
  std::transform(c.begin(), c.end(), out.begin(), [](const Rgb& v) { return luminance(v); });
}

}  // namespace plenolab
#endif
