#include <gtest/gtest.h>

#include <set>

#include "stimuli/direct/game_sequences.h"

namespace plenolab {
namespace {

constexpr int kWidth = 96, kHeight = 54;

TEST(GameSequences, AreTenInFourCategoriesAndSayWhatTheyAreNamedAfter) {
  ASSERT_EQ(game_sequences().size(), 10u);
  std::set<std::string> ids;
  std::multiset<GameLight> lights;
  for (const GameSequence& sequence : game_sequences()) {
    ids.insert(sequence.id);
    lights.insert(sequence.light);
    EXPECT_EQ(std::string(sequence.title).substr(0, 6), "after ");
  }
  EXPECT_EQ(ids.size(), 10u);
  EXPECT_EQ(lights.count(GameLight::kDarkHighContrast), 2u);
  EXPECT_EQ(lights.count(GameLight::kDarkLowContrast), 4u);
  EXPECT_EQ(lights.count(GameLight::kBrightHighContrast), 2u);
  EXPECT_EQ(lights.count(GameLight::kBrightLowContrast), 2u);
}

TEST(GameSequences, FramesLieInTheirCategoryAndAreAllAlight) {
  for (const GameSequence& sequence : game_sequences()) {
    const GameRenderer renderer(sequence.build());
    for (const int f : {0, 4, 8}) {
      const SceneImage frame = renderer.frame(f, kWidth, kHeight);
      const GameExposure exposure = exposure_of(frame);
      SCOPED_TRACE(std::string(sequence.id) + " " + std::to_string(f));
      const bool dark = sequence.light == GameLight::kDarkHighContrast ||
                        sequence.light == GameLight::kDarkLowContrast,
                 high = sequence.light == GameLight::kDarkHighContrast ||
                        sequence.light == GameLight::kBrightHighContrast;
      if (dark)
        EXPECT_LT(exposure.geometric_mean_cd_m2, kDarkBelow_cd_m2);
      else
        EXPECT_GT(exposure.geometric_mean_cd_m2, kBrightAbove_cd_m2);
      if (high)
        EXPECT_GT(exposure.range_log10, kHighContrastAbove_log10);
      else
        EXPECT_LT(exposure.range_log10, kLowContrastBelow_log10);
      for (const Rgb& c : frame.pixels()) ASSERT_TRUE(c.r > 0 && c.g > 0 && c.b > 0 && c.r < 1e6f);
    }
  }
}

TEST(GameSequences, FramesAreTheSameForAnyNumberOfThreadsAndMoveOn) {
  for (const GameSequence& sequence : game_sequences()) {
    const GameRenderer renderer(sequence.build()), again(sequence.build());
    const SceneImage first = renderer.frame(0, kWidth, kHeight, 1), same = again.frame(0, kWidth, kHeight, 3),
                     next = renderer.frame(1, kWidth, kHeight, 2);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(first.pixels()[i], same.pixels()[i]) << sequence.id;
      moved += first.pixels()[i] == next.pixels()[i] ? 0 : 1;
    }
    EXPECT_GT(moved, first.size() / 20) << sequence.id;
  }
}

TEST(GameSequences, PolishedFloorsShowWhatStandsOnThem) {
  // A shining wall before a black polished floor: looked at steeply the floor mirrors Schlick's share of it.
  LitScene lit;
  Material floor, wall;
  floor.kind = Material::Kind::kGlossy;
  floor.albedo = [](const SurfacePoint&) { return Rgb{}; };
  floor.ior = 1.5f;
  wall.kind = Material::Kind::kEmitter;
  wall.radiance_cd_m2 = {100, 100, 100};
  lit.scene.materials = {floor, wall};
  const auto quad = [](const Vec3& at, const Vec3& u, const Vec3& v, int material) {
    Mesh mesh;
    mesh.positions_m = {at, at + u, at + u + v, at + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    return mesh;
  };
  lit.scene.meshes = {quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0),
                      quad({-50, 5, 0}, {100, 0, 0}, {0, 0, 100}, 1)};
  const GameCamera camera{{0, 0, 2}, {0, 2, 0}};  // down at 45°
  const SceneImage frame = GameRenderer({lit, camera, camera, 10}).frame(0, 9, 9);
  const double share = 0.04 + 0.96 * std::pow(1 - std::sqrt(0.5), 5);
  EXPECT_NEAR(static_cast<double>(frame.at(4, 4).g), 100 * share, 0.1);
}

TEST(GameExposure, OfConstantBlackAndTwoLuminances) {
  SceneImage image(100, 10);
  EXPECT_EQ(exposure_of(image).geometric_mean_cd_m2, 0);
  for (Rgb& c : image.pixels()) c = {10, 10, 10};
  EXPECT_NEAR(exposure_of(image).geometric_mean_cd_m2, 10, 1e-5);
  EXPECT_EQ(exposure_of(image).range_log10, 0);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 100; ++x) image.at(x, y) = {1000, 1000, 1000};
  EXPECT_NEAR(exposure_of(image).geometric_mean_cd_m2, 100, 1e-3);
  EXPECT_NEAR(exposure_of(image).range_log10, 2, 1e-6);
}

}  // namespace
}  // namespace plenolab
