// DRIM and the feature metric on a photograph, where the folder of outside data has one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "core/image/colour.h"
#include "core/image/repair.h"
#include "core/io/image_file.h"
#include "metrics/drim.h"
#include "metrics/tmqi.h"

namespace plenolab {
namespace {

/// 256 × 256 pixels from the middle of the photograph, in cd/m² about a log average of 100.
class Photograph : public testing::Test {
 protected:
  void SetUp() override {
    const char* outside = std::getenv("PLENOLAB_OUTSIDE_DATA");
    if (outside == nullptr) GTEST_SKIP() << "set PLENOLAB_OUTSIDE_DATA to a folder that holds hdr/";
    const std::filesystem::path file = std::filesystem::path(outside) / "hdr/Desk.exr";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " does not exist";
    SceneImage image = read_scene_image(file);
    repair(image);
    scene_ = SceneImage(kSize, kSize);
    double log_sum = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        scene_.at(x, y) = image.at((image.width() - kSize) / 2 + x, (image.height() - kSize) / 2 + y);
        log_sum += std::log(std::max(1e-6f, luminance(scene_.at(x, y))));
      }
    const auto scale = static_cast<float>(100 / std::exp(log_sum / (kSize * kSize)));
    for (Rgb& c : scene_.pixels()) c = scale * c;
    light_ = scene_luminance(scene_, 1);
  }

  template <class Change>
  std::map<std::string, double> compare(Change change) const {
    Plane<float> test = light_;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) test.at(x, y) = change(x, y);
    std::map<std::string, double> values;
    for (const Measurement& m : drim_measurements(drim_maps(test, light_, {}))) values[m.quantity] = m.value;
    return values;
  }

  float blurred(int x, int y, int radius) const {
    float sum = 0;
    int count = 0;
    for (int v = std::max(0, y - radius); v <= std::min(kSize - 1, y + radius); ++v)
      for (int u = std::max(0, x - radius); u <= std::min(kSize - 1, x + radius); ++u, ++count)
        sum += light_.at(u, v);
    return sum / static_cast<float>(count);
  }

  static constexpr int kSize = 256;
  SceneImage scene_;
  Plane<float> light_;
};

TEST_F(Photograph, OfItselfHasNoDistortion) {
  EXPECT_EQ(compare([&](int x, int y) { return light_.at(x, y); }).at("drim_mean_total"), 0);
}

TEST_F(Photograph, BlurredLosesContrast) {
  const auto rows = compare([&](int x, int y) { return blurred(x, y, 5); });
  EXPECT_GT(rows.at("drim_share_loss"), 0.15);
  EXPECT_GT(rows.at("drim_mean_loss"), 5 * rows.at("drim_mean_amplification"));
}

TEST_F(Photograph, WithAddedTextureGainsContrast) {
  const auto rows = compare([&](int x, int y) {
    return light_.at(x, y) *
           (1 + 0.2f * std::sin(1.0f * static_cast<float>(x)) * std::sin(0.8f * static_cast<float>(y)));
  });
  EXPECT_GT(rows.at("drim_share_amplification"), 0.2);
  EXPECT_GT(rows.at("drim_mean_amplification"), 5 * rows.at("drim_mean_loss"));
}

TEST_F(Photograph, InvertedReversesContrast) {
  const auto rows = compare([&](int x, int y) { return 1e4f / std::max(1.0f, light_.at(x, y)); });
  EXPECT_GT(rows.at("drim_share_reversal"), 0.3);
  EXPECT_GT(rows.at("drim_mean_reversal"), rows.at("drim_mean_loss"));
}

TEST_F(Photograph, TenTimesBrighterHardlyChanges) {
  const auto rows = compare([&](int x, int y) { return 10 * light_.at(x, y); });
  EXPECT_LT(rows.at("drim_share_any"), 0.05);
}

TEST_F(Photograph, WellExposedScoresBetterThanTooDark) {
  const float exposure = exposure_from(scene_);
  EXPECT_GT(tmqi(expose(scene_, exposure), scene_, {}).front().value,
            tmqi(expose(scene_, exposure / 64), scene_, {}).front().value);
}

}  // namespace
}  // namespace plenolab
