#include "metrics/tmqi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/image/colour.h"

namespace plenolab {
namespace {

std::map<std::string, double> by_name(const std::vector<Measurement>& rows) {
  std::map<std::string, double> values;
  for (const Measurement& row : rows) values[row.quantity] = row.value;
  return values;
}

struct Pair {
  SceneImage scene;
  DisplayImage mapped;
};

/// A scene over four decades and a picture of it that a Python script made alike.
Pair pattern(int width, int height) {
  Pair pair{SceneImage(width, height), DisplayImage(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wave = std::sin(0.13 * x) * std::cos(0.11 * y), fine = std::sin(1.7 * x + 0.9 * y);
      const auto hdr = static_cast<float>(std::pow(10, 2 * wave + 0.3 * fine));
      const auto luma = static_cast<float>(0.45 + 0.18 * wave + 0.08 * fine + 0.05 * std::cos(2.1 * y));
      pair.scene.at(x, y) = {hdr, hdr, hdr};
      pair.mapped.at(x, y) = {luma, luma, luma};
    }
  }
  return pair;
}

TEST(Tmqi, AgreesWithItsFormulasComputedElsewhere) {
  // Plain Python over 48×44 pixels, windows summed directly: three scales.
  const Pair images = pattern(48, 44);
  const auto rows = by_name(tmqi(images.mapped, images.scene, {}));
  EXPECT_NEAR(rows.at("tmqi_fidelity"), 0.651912538, 1e-5);
  EXPECT_NEAR(rows.at("tmqi_naturalness"), 0.950911608, 1e-5);
  EXPECT_NEAR(rows.at("tmqi"), 0.895136347, 1e-5);
}

TEST(Tmqi, ThresholdsFollowTheContrastSensitivityOfEachScale) {
  // Python: Φ of a deviation of 2 at 16, 4 and 1 cycles per degree.
  EXPECT_NEAR(tmqi_detected_deviation(2, 0), 0.9373690895, 1e-9);
  EXPECT_NEAR(tmqi_detected_deviation(2, 2), 0.9898048425, 1e-9);
  EXPECT_NEAR(tmqi_detected_deviation(2, 4), 0.1770897702, 1e-9);
  EXPECT_NEAR(tmqi_detected_deviation(0, 0), 0.00134989803, 1e-9);  // Φ(−3)
}

TEST(Tmqi, NaturalnessIsOneAtTheModesAndNothingWithoutDeviation) {
  EXPECT_NEAR(tmqi_naturalness(115.94, 64.29 * 3.4 / 12.5), 1, 1e-12);
  EXPECT_NEAR(tmqi_naturalness(100, 20), 0.8123371304, 1e-9);
  EXPECT_EQ(tmqi_naturalness(115.94, 0), 0);
  EXPECT_EQ(tmqi_naturalness(115.94, 70), 0);
}

TEST(Tmqi, DoesNotDependOnTheScaleOfTheScene) {
  const Pair images = pattern(64, 48);
  SceneImage brighter = images.scene;
  for (Rgb& c : brighter.pixels()) c = c * 1024;
  EXPECT_NEAR(by_name(tmqi(images.mapped, brighter, {})).at("tmqi"),
              by_name(tmqi(images.mapped, images.scene, {})).at("tmqi"), 1e-9);
}

TEST(Tmqi, FallsWhenStructureIsLostOrInverted) {
  const Pair images = pattern(96, 80);
  DisplayImage flat = images.mapped, inverted = images.mapped;
  for (Rgb& c : flat.pixels()) c = 0.02f * c + Rgb{0.45f, 0.45f, 0.45f};
  for (Rgb& c : inverted.pixels()) c = Rgb{0.9f, 0.9f, 0.9f} - c;
  const double good = by_name(tmqi(images.mapped, images.scene, {})).at("tmqi_fidelity");
  EXPECT_LT(by_name(tmqi(flat, images.scene, {})).at("tmqi_fidelity"), good);
  EXPECT_EQ(by_name(tmqi(inverted, images.scene, {})).at("tmqi_fidelity"), 0);
}

TEST(Tmqi, OfASceneOfOneLuminanceComparesWithNoDeviation) {
  const SceneImage even(40, 40, {7, 7, 7});
  const DisplayImage even_picture(40, 40, {0.5f, 0.5f, 0.5f});
  const auto same = by_name(tmqi(even_picture, even, {}));
  EXPECT_NEAR(same.at("tmqi_fidelity"), 1, 1e-6);
  EXPECT_EQ(same.at("tmqi_naturalness"), 0);
  EXPECT_LT(by_name(tmqi(pattern(40, 40).mapped, even, {})).at("tmqi_fidelity"), 0.5);
}

}  // namespace
}  // namespace plenolab
