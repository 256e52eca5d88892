#include "metrics/brisque.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

/// Normal deviates by the polar method of two hashed words.
double normal(std::uint64_t index) {
  const double u = unit_double(random_u64(1, 2, 2 * index)), v = unit_double(random_u64(1, 2, 2 * index + 1));
  return std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
}

DisplayImage grey(int width, int height, double (*value)(int x, int y)) {
  DisplayImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = Rgb{1, 1, 1} * static_cast<float>(std::clamp(value(x, y), 0.0, 1.0));
  return image;
}

DisplayImage white_noise() {
  return grey(256, 256,
              [](int x, int y) { return 0.5 + 0.1 * normal(static_cast<std::uint64_t>(y * 256 + x)); });
}

TEST(GeneralisedGaussian, HasKnownShapes) {
  EXPECT_NEAR(generalised_gaussian_shape(std::numbers::pi / 2), 2, 1e-6);  // normal
  EXPECT_NEAR(generalised_gaussian_shape(2), 1, 1e-6);                     // Laplace
  EXPECT_NEAR(generalised_gaussian_shape(1.0), 10, 1e-6);                  // flatter than the range
  EXPECT_NEAR(generalised_gaussian_shape(1e9), 0.2, 1e-6);                 // more peaked than the range
}

TEST(BrisqueFeatures, OfWhiteNoiseAreThoseOfIndependentNormals) {
  const BrisqueFeatures f = brisque_features(white_noise());
  EXPECT_GT(f[0], 1.9);  // shape: near the normal's 2, above it as the window's own σ divides it
  EXPECT_LT(f[0], 3);
  EXPECT_GT(f[1], 0.6);  // variance: below 1 as each pixel is part of its own window
  EXPECT_LT(f[1], 1.1);
  for (const std::size_t first : {2, 6, 10, 14}) {
    EXPECT_LT(f[first], 1.3) << "products of independent normals are peaked";
    EXPECT_LT(std::abs(f[first + 1]), 0.12) << "and their mean is near 0";
    EXPECT_GT(f[first + 2] / f[first + 3], 0.8) << "with sides alike, but that a window less";
    EXPECT_LT(f[first + 2] / f[first + 3], 2) << "its mean leaves neighbours that differ";
  }
}

TEST(BrisqueFeatures, AgreeWithAComputationElsewhere) {
  // Plain Python, windows summed directly.
  const DisplayImage image = grey(24, 20, [](int x, int y) {
    return 0.45 + 0.25 * std::sin(0.7 * x + 0.3 * y) + 0.1 * std::cos(2.3 * x - 1.1 * y) +
           0.1 * std::sin(0.05 * x * y);
  });
  const BrisqueFeatures expected{
      2.505918,  0.405142, 1.248095,  0.000248, 0.091090, 0.091292, 0.779724,  0.316769, 0.011929,
      0.348443,  1.015226, 0.162733,  0.049469, 0.204028, 1.353786, -0.078219, 0.104457, 0.048174,
      10.000000, 0.556525, 4.784078,  0.122663, 0.125444, 0.248994, 2.591409,  0.398791, 0.020611,
      0.398064,  2.144112, -0.331326, 0.433775, 0.060762, 1.615392, 0.444487,  0.020783, 0.513895};
  const BrisqueFeatures features = brisque_features(image);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(features[i], expected[i], 2e-4) << i;
}

TEST(BrisqueFeatures, DistinguishOrientation) {
  const DisplayImage stripes = grey(64, 64, [](int, int y) { return 0.5 + 0.3 * std::sin(0.9 * y); });
  const BrisqueFeatures f = brisque_features(stripes);
  EXPECT_GT(f[3], 0) << "neighbours along stripes agree";
  EXPECT_GT(f[3], f[7]) << "more than neighbours across";
}

TEST(BrisqueFeatures, OfImagesWithoutContrastAreExplicit) {
  for (const auto& [width, height] : {std::pair{40, 30}, {1, 1}, {1, 9}}) {
    const BrisqueFeatures f = brisque_features(DisplayImage(width, height, {0.3f, 0.3f, 0.3f}));
    EXPECT_EQ(f[0], 10);
    EXPECT_EQ(f[1], 0);
    EXPECT_EQ(f[2], 10);
    EXPECT_EQ(f[35], 0);
  }
}

TEST(BrisqueFeatures, NeedAWindowOfValidPixels) {
  Mask valid(20, 20, 1);
  for (int y = 3; y < 20; y += 4)
    for (int x = 0; x < 20; ++x) valid.at(x, y) = 0;
  EXPECT_NE(message_of([&] { brisque_features(DisplayImage(20, 20), &valid); }).find("7×7"),
            std::string::npos);
}

TEST(BrisquePlenolab, RisesWithNoise) {
  const auto score = [](double deviation) {
    DisplayImage image(192, 108);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double value = 0.5 + 0.3 * std::sin(0.05 * x) * std::cos(0.07 * y) + 0.02 * std::sin(0.8 * x) +
                             deviation * normal(static_cast<std::uint64_t>(y * image.width() + x));
        image.at(x, y) = Rgb{1, 1, 1} * static_cast<float>(std::clamp(value, 0.0, 1.0));
      }
    }
    return brisque_plenolab(image, {}).front().value;
  };
  const double little = score(0.01), some = score(0.04), much = score(0.16);
  EXPECT_LT(little + 5, some);
  EXPECT_LT(some + 5, much);
}

TEST(BrisqueScore, IsAWeightedSumOfStandardisedInputsAndSquares) {
  std::array<double, 36> mean{}, deviation{};
  std::array<double, 72> weights{};
  deviation.fill(2);
  weights[3] = 5;       // the input that is a mean: no logarithm
  weights[36 + 3] = 1;  // its square
  const BrisqueModel model{mean, deviation, weights, 40};
  BrisqueFeatures features{};
  features.fill(1);
  features[3] = -3;
  EXPECT_NEAR(brisque_score(model, features), 40 - 5 * 1.5 + 1.5 * 1.5, 1e-9);
  features[3] = 1e9;
  EXPECT_NEAR(brisque_score(model, features), 40 + 5 * 4 + 16, 1e-9) << "cut at four deviations";
}

}  // namespace
}  // namespace plenolab
