// Vectorised elementary functions and loops over rows, compiled once per instruction set (Highway). All steps
// are IEEE operations in a fixed order without fused ones, so results do not depend on the instruction set.

#if defined(PLENOLAB_FAST_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PLENOLAB_FAST_MATH_INL_H
#undef PLENOLAB_FAST_MATH_INL_H
#else
#define PLENOLAB_FAST_MATH_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "core/image/colour.h"
#include "core/image/image.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Vec = hn::Vec<Floats>;
using LaneMask = hn::Mask<Floats>;

constexpr float kLargest = 3.402823466e38f;

HWY_INLINE Vec C(float value) {
  return hn::Set(Floats(), value);
}

/// a·b + c in two roundings.
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

/// log2 of x > 0, denormal ones included.
HWY_INLINE Vec Log2(Vec x) {
  const Floats d;
  const Ints di;
  const auto denormal = hn::Lt(x, C(1.17549435e-38f));
  const Vec normal = hn::IfThenElse(denormal, hn::Mul(x, C(16777216.0f)), x);
  // Mantissa in [√½, √2): without √½'s bits the exponent field changes at √2.
  const auto bits = hn::BitCast(di, normal);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const Vec mantissa = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const Vec whole = hn::Sub(hn::ConvertTo(d, exponent), hn::IfThenElseZero(denormal, C(24.0f)));
  return MulThenAdd(LogOfOnePlus(hn::Sub(mantissa, C(1.0f))), C(1.44269504f), whole);
}

/// 2^t, at most the largest float, 0 below 2^-125: polynomial of Cephes' exp2f for the fraction in [−½, ½].
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

/// x^p for x ≥ 0, p ≥ 0.
HWY_INLINE Vec Pow(Vec x, float p) {
  const Vec power = Exp2(hn::Mul(Log2(x), C(p)));
  return hn::IfThenElse(hn::Gt(x, hn::Zero(Floats())), power, C(p == 0 ? 1.0f : 0.0f));
}

/// luminance() of colours, to the bit.
HWY_INLINE Vec Luminance(Vec r, Vec g, Vec b) {
  const Vec rg = hn::Add(hn::Mul(C(kLuminanceWeights.r), r), hn::Mul(C(kLuminanceWeights.g), g));
  return hn::Add(rg, hn::Mul(C(kLuminanceWeights.b), b));
}

HWY_INLINE LaneMask AllLanes() {
  return hn::FirstN(Floats(), hn::Lanes(Floats()));
}

/// out = function(x, valid lanes); the last vector is filled up with ones.
template <class Function>
HWY_INLINE void MapRow(const float* x, float* out, std::size_t count, const Function& function) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(function(hn::LoadU(d, x + i), AllLanes()), d, out + i);
  if (i == count) return;
  HWY_ALIGN float buffer[hn::MaxLanes(Floats())];
  std::fill(buffer, buffer + lanes, 1.0f);
  std::copy(x + i, x + count, buffer);
  hn::Store(function(hn::Load(d, buffer), hn::FirstN(d, count - i)), d, buffer);
  std::copy(buffer, buffer + (count - i), out + i);
}

/// The floats of a row of colours, three a pixel.
HWY_INLINE const float* FloatsOf(const Rgb* row) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  return &row->r;
}
HWY_INLINE float* FloatsOf(Rgb* row) {
  return &row->r;
}

/// function(r, g, b, index, valid lanes) for every vector of pixels; the last one is filled up with zeros.
template <class Function>
HWY_INLINE void VisitPixels(const Rgb* row, std::size_t count, const Function& function) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  Vec r, g, b;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::LoadInterleaved3(d, FloatsOf(row + i), r, g, b);
    function(r, g, b, i, AllLanes());
  }
  if (i == count) return;
  Rgb buffer[hn::MaxLanes(Floats())] = {};
  std::copy(row + i, row + count, buffer);
  hn::LoadInterleaved3(d, FloatsOf(buffer), r, g, b);
  function(r, g, b, i, hn::FirstN(d, count - i));
}

/// Stores the pixels from `index` on, as many as the row of `count` has.
HWY_INLINE void StorePixels(Vec r, Vec g, Vec b, Rgb* row, std::size_t index, std::size_t count) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  if (index + lanes <= count) {
    hn::StoreInterleaved3(r, g, b, d, FloatsOf(row + index));
    return;
  }
  Rgb buffer[hn::MaxLanes(Floats())];
  hn::StoreInterleaved3(r, g, b, d, FloatsOf(buffer));
  std::copy(buffer, buffer + (count - index), row + index);
}

/// Values of a row of floats from `index` on.
HWY_INLINE Vec LoadLanes(const float* row, std::size_t index, std::size_t count) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  if (index + lanes <= count) return hn::LoadU(d, row + index);
  HWY_ALIGN float buffer[hn::MaxLanes(Floats())] = {};
  std::copy(row + index, row + count, buffer);
  return hn::Load(d, buffer);
}

HWY_INLINE void StoreLanes(Vec v, float* row, std::size_t index, std::size_t count) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  if (index + lanes <= count) {
    hn::StoreU(v, d, row + index);
    return;
  }
  HWY_ALIGN float buffer[hn::MaxLanes(Floats())];
  hn::Store(v, d, buffer);
  std::copy(buffer, buffer + (count - index), row + index);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#endif
