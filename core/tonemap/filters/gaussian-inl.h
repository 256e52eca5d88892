// Weights of Gaussians in vectors; compiled once per instruction set (Highway).

#if defined(PLENOLAB_GAUSSIAN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PLENOLAB_GAUSSIAN_INL_H
#undef PLENOLAB_GAUSSIAN_INL_H
#else
#define PLENOLAB_GAUSSIAN_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

/// 2^−e for e ≥ 0, relative error below 2.5e-7, exactly 1 for e = 0, and 0 from e = 126 on (infinity
/// included). Multiplications and additions are kept apart, so that every instruction set gives the same
/// bits.
template <class D, class V>
HWY_INLINE V NegativeExp2(D d, V e) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto kept = hn::Lt(e, hn::Set(d, 126.0f));
  const V x = hn::IfThenElseZero(kept, hn::Neg(e));
  const auto whole = hn::NearestInt(x);
  const V f = hn::Sub(x, hn::ConvertTo(d, whole));  // in [−1/2, 1/2]
  // 2^f = Σ (f ln 2)^k / k!; the first term left out is below 1.2e-7.
  V p = hn::Set(d, 1.5403530e-4f);
  for (const float c : {1.3333558e-3f, 9.6181291e-3f, 5.5504109e-2f, 2.4022651e-1f, 6.9314718e-1f, 1.0f})
    p = hn::Add(hn::Mul(p, f), hn::Set(d, c));
  const V power = hn::BitCast(d, hn::Add(hn::BitCast(di, p), hn::ShiftLeft<23>(whole)));
  return hn::IfThenElseZero(kept, power);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#endif
