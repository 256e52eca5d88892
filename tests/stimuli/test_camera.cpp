#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

RenderSettings few_paths() {
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  return settings;
}

// A wall at distance z that fills the image.
Scene wall_scene(float z) {
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.5f)};
  scene.meshes = {parallelogram({-10 * z, z, -10 * z}, {20 * z, 0, 0}, {0, 0, 20 * z}, 0)};
  return scene;
}

// Centre of brightness in pixels.
std::array<double, 2> centroid(const SceneImage& image) {
  double sum = 0, x_sum = 0, y_sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const double w = static_cast<double>(image.at(x, y).g);
      sum += w, x_sum += w * (x + 0.5), y_sum += w * (y + 0.5);
    }
  return {x_sum / sum, y_sum / sum};
}

TEST(Camera, AFrontoParallelPlaneHasTheDisparityOfTheGrid) {
  const ViewGrid grid{5, 3, 0.13, 0.2, 16, 9, 53};
  for (const float z : {0.5f, 3.0f, 700.0f}) {
    const auto view = render(wall_scene(z), grid, few_paths(), {1.5, 0.25}).view;
    for (const float d : view.disparity.pixels())
      EXPECT_NEAR(d / grid.disparity_px(static_cast<double>(z)), 1, 2e-6);
  }
}

TEST(Camera, ATiltedPlaneAveragesInverseDepth) {
  // Depth z = z0 + k·x in camera space: 1/z is linear in the image, so its average over a pixel is its value
  // at the centre: with X = (column − w/2)/f, 1/z = (1 − k·X)/z0. Averages of z would differ.
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.5f)};
  const float k = 0.8f, z0 = 4;
  scene.meshes = {parallelogram({-40, z0 - 40 * k, -50}, {80, 80 * k, 0}, {0, 0, 100}, 0)};
  const ViewGrid grid{1, 1, 0.1, 0.1, 12, 4, 40};
  RenderSettings settings;
  settings.paths_per_pixel = 1024;
  const auto view = render(scene, grid, settings).view;
  const double focal = 6 / std::tan(20 * std::numbers::pi / 180);
  for (int x = 0; x < 12; ++x) {
    const double inverse = (1 - static_cast<double>(k) * (x + 0.5 - 6) / focal) / static_cast<double>(z0);
    EXPECT_NEAR(view.disparity.at(x, 2) / (focal * 0.1 * inverse), 1, 2e-4) << "column " << x;
  }
}

TEST(Camera, SkyHasDisparityZero) {
  Scene scene = empty_scene();
  scene.sky = uniform_sky(5, 5);
  const auto view = render(scene, small_grid(), few_paths()).view;
  for (const float d : view.disparity.pixels()) EXPECT_EQ(d, 0);
  for (const Rgb& c : view.colour.pixels()) EXPECT_EQ(c, (Rgb{5, 5, 5}));
}

TEST(Camera, WaterIsTheFirstSurfaceAndTheMediumIsNone) {
  Scene scene = wall_scene(4);
  scene.sky = uniform_sky(5, 5);
  Material glass;
  glass.kind = Material::Kind::kDielectric;
  scene.materials.push_back(glass);
  scene.meshes.push_back(parallelogram({-50, 2, -50}, {100, 0, 0}, {0, 0, 100}, 1));
  scene.medium = Medium{Vec3(-50, 0.5f, -50), Vec3(50, 1, 50), 0.1f, 0.1f, 0};
  const ViewGrid grid = small_grid();
  const auto view = render(scene, grid, few_paths()).view;
  EXPECT_NEAR(view.disparity.at(3, 3) / grid.disparity_px(2), 1, 1e-5);
}

TEST(Camera, RightIsRightAndRowZeroIsTheTop) {
  Scene scene = empty_scene();
  scene.materials = {lamp({1, 1, 1})};
  scene.meshes = {sphere({0.5f, 4, 1.0f}, 0.2f, 12, 0)};
  const ViewGrid grid{3, 3, 0.3, 0.2, 64, 64, 60};
  const auto [x, y] = centroid(render(scene, grid, few_paths(), {1, 1}).view.colour);
  EXPECT_GT(x, 34);
  EXPECT_LT(y, 30);
}

TEST(Camera, AnObjectMovesAgainstTheCameraByItsDisparity) {
  Scene scene = empty_scene();
  scene.materials = {lamp({1, 1, 1})};
  scene.meshes = {parallelogram({-0.4f, 4, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, 0)};
  const ViewGrid grid{3, 3, 0.3, 0.2, 64, 64, 60};
  RenderSettings settings;
  settings.paths_per_pixel = 64;
  settings.blocks.t1_px = 1e6;  // antialiased edges, so that the centroid is exact
  const PreparedScene prepared(scene);
  const auto at = [&](CameraPosition p) {
    return centroid(render_view(prepared, grid, p, settings).view.colour);
  };
  const auto middle = at({1, 1}), right = at({2, 1}), below = at({1, 2}), between = at({1.25, 1});
  const double d = grid.disparity_px(4);
  EXPECT_NEAR(right[0], middle[0] - d, 0.03);
  EXPECT_NEAR(between[0], middle[0] - 0.25 * d, 0.03);
  EXPECT_NEAR(right[1], middle[1], 0.03);
  EXPECT_NEAR(below[1], middle[1] - d * grid.vertical_ratio(),
              0.03);  // the camera went down, the object goes up
}

TEST(Camera, TheGridIsCentredOnTheScenesCamera) {
  Scene scene = empty_scene();
  scene.camera.centre_m = {3, 0, 7};
  scene.materials = {lamp({1, 1, 1})};
  scene.meshes = {sphere({3, 4, 7}, 0.2f, 12, 0)};
  const auto [x, y] =
      centroid(render(scene, {4, 2, 0.3, 0.2, 64, 48, 60}, few_paths(), {1.5, 0.5}).view.colour);
  EXPECT_NEAR(x, 32, 0.2);
  EXPECT_NEAR(y, 24, 0.2);
}

TEST(Camera, ThePresetsOfASceneBecomeGrids) {
  Scene scene = empty_scene();
  scene.paper = {17, 9, 0.05, 0.06, 960, 540, 256};
  scene.camera.fov_h_deg = 70;
  EXPECT_EQ(grid_of(scene, Preset::kPaper), (ViewGrid{17, 9, 0.05, 0.06, 960, 540, 70}));
}

TEST(Camera, SamplesReducedByHandEqualTheView) {
  Scene scene = wall_scene(3);
  scene.sky = uniform_sky(5, 5);
  scene.meshes.push_back(parallelogram({-0.3f, 1, -0.2f}, {0.5f, 0, 0.1f}, {0, 0, 0.6f}, 0));
  const ViewGrid grid = small_grid(16, 12);
  const PreparedScene prepared(scene);
  const auto samples = render_samples(prepared, grid, {0, 0}, few_paths());
  const auto view = render_view(prepared, grid, {0, 0}, few_paths()).view;
  const auto reduced = preprocess_blocks(samples.radiance, samples.disparity_px);
  EXPECT_EQ(reduced.colour, view.colour);
  EXPECT_EQ(reduced.disparity, view.disparity);
}

TEST(Camera, SettingsOutOfRangeAreRefused) {
  const Scene scene = wall_scene(3);
  RenderSettings settings;
  settings.paths_per_pixel = 20;
  EXPECT_THROW(render(scene, small_grid(), settings), InputError);
  EXPECT_THROW(render(scene, ViewGrid{0, 1}), InputError);
  EXPECT_THROW(render(scene, small_grid(), few_paths(), {std::nan(""), 0}), InputError);
}

}  // namespace
}  // namespace plenolab
