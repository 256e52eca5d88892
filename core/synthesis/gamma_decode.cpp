#include "core/synthesis/gamma_decode.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/synthesis/gamma_decode.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/synthesis/gamma_decode-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

void DecodeValues(float* values, std::size_t count) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t n = 0;
  for (; n + lanes <= count; n += lanes) hn::StoreU(DecodeGamma(d, hn::LoadU(d, values + n)), d, values + n);
  const hn::CappedTag<float, 1> one;
  for (; n < count; ++n) hn::StoreU(DecodeGamma(one, hn::LoadU(one, values + n)), one, values + n);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {
HWY_EXPORT(DecodeValues);
}  // namespace

void decode_gamma(std::span<float> values) {
  HWY_DYNAMIC_DISPATCH(DecodeValues)(values.data(), values.size());
}

}  // namespace plenolab
#endif  // HWY_ONCE
