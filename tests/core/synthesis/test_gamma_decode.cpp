#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "core/image/colour.h"
#include "core/synthesis/gamma_decode-inl.h"

namespace plenolab {
namespace {

/// One value through the vector code of the baseline instruction set.
float decoded(float value) {
  const hwy::HWY_NAMESPACE::CappedTag<float, 1> d;
  return hwy::HWY_NAMESPACE::GetLane(HWY_NAMESPACE::DecodeGamma(d, hwy::HWY_NAMESPACE::Set(d, value)));
}

TEST(GammaDecode, IsTheInverseOfTheEncodingToOneInAMillion) {
  for (double exponent = -9; exponent <= 9; exponent += 0.0173) {
    const float value = gamma_encode(static_cast<float>(std::pow(10, exponent)));
    const double expected = std::pow(static_cast<double>(value), 2.2);
    EXPECT_NEAR(static_cast<double>(decoded(value)) / expected, 1, 1e-6) << value;
  }
}

TEST(GammaDecode, StaysFiniteAtBothEndsOfTheRange) {
  EXPECT_EQ(decoded(0), 0);
  EXPECT_EQ(decoded(1e-38f), 0);
  EXPECT_TRUE(std::isfinite(decoded(gamma_encode(std::numeric_limits<float>::max()))));
}

}  // namespace
}  // namespace plenolab
