// Decoding of the blended value, v^2.2, to one in a million; compiled once per instruction set (Highway).

#if defined(PLENOLAB_GAMMA_DECODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PLENOLAB_GAMMA_DECODE_INL_H
#undef PLENOLAB_GAMMA_DECODE_INL_H
#else
#define PLENOLAB_GAMMA_DECODE_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

/// v^2.2 = v·v·(v·z⁴) with z = v^(−1/5) by Newton steps z ← z·(1.2 − 0.2·v·z⁵), which need no division. The
/// start value divides the float's exponent by −5 through its bits (error below 8 %); the error e of a step
/// becomes 3e².
template <class D, class V>
HWY_INLINE V DecodeGamma(D d, V v) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr float kBits = 1.2f * (127.0f - 0.045f) * 8388608.0f;
  const hn::RebindToSigned<D> di;
  const auto bits = hn::ConvertTo(d, hn::BitCast(di, v));
  auto z = hn::BitCast(d, hn::ConvertTo(di, hn::Sub(hn::Set(d, kBits), hn::Mul(hn::Set(d, 0.2f), bits))));
  for (int step = 0; step < 4; ++step) {
    const auto z2 = hn::Mul(z, z);
    const auto vz5 = hn::Mul(hn::Mul(v, z), hn::Mul(z2, z2));
    z = hn::Mul(z, hn::Sub(hn::Set(d, 1.2f), hn::Mul(hn::Set(d, 0.2f), vz5)));
  }
  const auto z2 = hn::Mul(z, z);
  const auto root = hn::Mul(v, hn::Mul(z2, z2));
  const auto power = hn::Min(hn::Mul(hn::Mul(root, v), v), hn::Set(d, 3.402823466e38f));
  return hn::IfThenElseZero(hn::Gt(v, hn::Set(d, 1e-30f)), power);  // 1e-30^2.2 is below the smallest float
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#endif
