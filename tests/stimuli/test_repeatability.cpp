#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

// One of everything.
Scene full_scene() {
  Scene scene = empty_scene();
  Material glossy = diffuse(0.6f), metal = diffuse(0.8f), mirror = diffuse(0.9f), glass;
  glossy.kind = Material::Kind::kGlossy;
  metal.kind = Material::Kind::kMetal;
  mirror.kind = Material::Kind::kMirror;
  glass.kind = Material::Kind::kDielectric;
  glass.absorption_per_m = {0.1f, 0.2f, 0.3f};
  scene.materials = {diffuse(0.7f), glossy, metal, mirror, glass, lamp({500, 300, 100})};
  scene.meshes = {parallelogram({-5, 0, -1}, {10, 0, 0}, {0, 10, 0}, 0),
                  sphere({-1.2f, 4, -0.3f}, 0.5f, 12, 1, true),
                  sphere({0, 4, -0.3f}, 0.5f, 12, 2, true),
                  sphere({1.2f, 4, -0.3f}, 0.5f, 12, 3),
                  sphere({0.3f, 2.5f, -0.3f}, 0.4f, 12, 4, true),
                  sphere({0, 3.5f, 1}, 0.1f, 8, 5)};
  scene.sun = Sun{Vec3(0.6f, 0, 0.8f), 0.53f, {1000, 900, 800}};
  scene.sky.kind = Sky::Kind::kDaylight;
  scene.portals = {{Vec3(-4, 1, 3), Vec3(8, 0, 0), Vec3(0, 6, 0)}};
  scene.medium = Medium{Vec3(-3, 1, -1), Vec3(3, 6, 2), 0.05f, 0.01f, 0.4f};
  return scene;
}

RenderSettings few_paths() {
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  return settings;
}

bool identical(const RenderedView& a, const RenderedView& b) {
  return a.view.colour == b.view.colour && a.view.disparity == b.view.disparity;
}

TEST(Repeatability, AnyNumberOfThreadsGivesTheSameBits) {
  RenderSettings settings = few_paths();
  settings.threads = 1;
  const auto one = render(full_scene(), small_grid(24, 18), settings);
  for (const int threads : {2, 3}) {
    settings.threads = threads;
    const auto more = render(full_scene(), small_grid(24, 18), settings);
    EXPECT_TRUE(identical(one, more)) << threads << " threads";
    EXPECT_EQ(one.stats.shadow_rays, more.stats.shadow_rays);
  }
}

TEST(Repeatability, APreparedSceneLeavesTheProcessItsThreads) {
  const auto limit = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const std::size_t before = limit();
  const PreparedScene prepared(full_scene());
  prepared.state();
  EXPECT_EQ(limit(), before);
}

TEST(Repeatability, PruningChangesNoBitWhateverASceneLacks) {
  std::vector<Scene> scenes(9, full_scene());
  scenes[1].medium.reset();
  scenes[2].sky = Sky{};
  scenes[3].sky = Sky{}, scenes[3].sun.reset();
  scenes[4].meshes.pop_back();                                                                   // no lamp
  scenes[5].meshes.erase(scenes[5].meshes.begin() + 4), scenes[5].materials[4] = diffuse(0.5f);  // no glass
  scenes[6].sun.reset(), scenes[6].sky = Sky{}, scenes[6].meshes.pop_back();  // no light at all
  scenes[7].medium->scattering_per_m = 0;
  scenes[8].max_bounces = 1;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    RenderSettings settings = few_paths();
    const auto pruned = render(scenes[i], small_grid(16, 12), settings);
    settings.prune = false;
    const auto complete = render(scenes[i], small_grid(16, 12), settings);
    EXPECT_TRUE(identical(pruned, complete)) << "scene " << i;
    EXPECT_TRUE(complete.stats.pruned.empty());
    EXPECT_EQ(pruned.stats.pruned.empty(), i == 0) << "scene " << i;
  }
}

TEST(Repeatability, PruningSaysWhatItLeftOutAndSavesRays) {
  Scene scene = full_scene();
  scene.sky = Sky{};
  scene.medium.reset();
  RenderSettings settings = few_paths();
  const auto pruned = render(scene, small_grid(16, 12), settings).stats;
  settings.prune = false;
  EXPECT_LE(pruned.shadow_rays, render(scene, small_grid(16, 12), settings).stats.shadow_rays);
  ASSERT_EQ(pruned.pruned.size(), 3u);
  EXPECT_EQ(pruned.pruned[0].stage, "sky");
  EXPECT_EQ(pruned.pruned[1].stage, "medium");
  EXPECT_EQ(pruned.pruned[2].stage, "single scattering");
}

TEST(Repeatability, SeedCameraAndNothingElseChangeTheNoise) {
  const PreparedScene prepared(full_scene());
  const ViewGrid grid = small_grid(16, 12);
  RenderSettings settings = few_paths();
  const auto first = render_view(prepared, grid, {0, 0}, settings);
  EXPECT_TRUE(identical(first, render_view(PreparedScene(full_scene()), grid, {0, 0}, settings)));
  settings.seed = 2;
  EXPECT_FALSE(identical(first, render_view(prepared, grid, {0, 0}, settings)));
}

TEST(Repeatability, NeighbouringCamerasSeeDifferentNoise) {
  // A wall of even colour under a sky looks the same from both cameras but for noise.
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.5f)};
  scene.meshes = {parallelogram({-500, 3, -500}, {1000, 0, 0}, {0, 0, 1000}, 0)};
  scene.sky = uniform_sky(1, 0);
  const PreparedScene prepared(scene);
  const auto left = render_view(prepared, small_grid(), {0, 0}, few_paths());
  const auto right = render_view(prepared, small_grid(), {1, 0}, few_paths());
  EXPECT_NE(left.view.colour, right.view.colour);
}

TEST(Repeatability, DegenerateTrianglesAndEmptyScenesAreNoTrouble) {
  Scene scene = full_scene();
  Mesh broken = parallelogram({0, 2, 0}, {0, 0, 0}, {0, 0, 1}, 5);
  broken.triangles.push_back({1, 1, 1});
  scene.meshes.push_back(broken);
  scene.meshes.push_back(Mesh{});
  const auto view = render(scene, small_grid(16, 12), few_paths()).view;
  for (const Rgb& c : view.colour.pixels()) EXPECT_TRUE(std::isfinite(c.r) && c.r >= 0);
  const auto nothing = render(empty_scene(), small_grid(), few_paths()).view;
  for (const Rgb& c : nothing.colour.pixels()) EXPECT_EQ(c, (Rgb{0, 0, 0}));
}

TEST(Repeatability, ExtremeRadianceStaysFinite) {
  for (const float scale : {1e-9f, 1e9f}) {
    Scene scene = full_scene();
    scene.materials[5].radiance_cd_m2 = {scale, scale, scale};
    scene.sun->illuminance_lx = {scale, 0, scale};
    const auto view = render(scene, small_grid(16, 12), few_paths()).view;
    for (const Rgb& c : view.colour.pixels())
      EXPECT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && c.g >= 0);
  }
}

TEST(Repeatability, ProgressRisesToOne) {
  double last = 0;
  bool rising = true;
  render_view(PreparedScene(full_scene()), small_grid(), {0, 0}, few_paths(), [&](double share) {
    rising = rising && share > last;
    last = share;
  });
  EXPECT_TRUE(rising);
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace plenolab
