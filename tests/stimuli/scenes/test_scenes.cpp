#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/colour.h"
#include "stimuli/render.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

/// How the test runner prints the parameter.
static void PrintTo(const SceneEntry& entry, std::ostream* stream) {
  *stream << entry.id;
}

namespace {

/// Scenes are modelled once for all tests.
const Scene& scene_of(const SceneEntry& entry) {
  static std::map<std::string, Scene> built;
  const auto found = built.find(entry.id);
  return found != built.end() ? found->second : built.emplace(entry.id, entry.build()).first->second;
}

std::size_t triangles_of(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
  return count;
}

std::string geometry_hash(const Scene& scene) {
  ContentHash hash;
  for (const Mesh& mesh : scene.meshes) {
    hash.add_bytes(mesh.positions_m.data(), mesh.positions_m.size() * sizeof(Vec3));
    hash.add_bytes(mesh.normals.data(), mesh.normals.size() * sizeof(Vec3));
    hash.add_bytes(mesh.uvs.data(), mesh.uvs.size() * sizeof(mesh.uvs[0]));
    hash.add_bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
  }
  return hash.hex();
}

/// A point on a triangle of a mesh, chosen at random, as the tracer would interpolate it.
SurfacePoint random_point(const Mesh& mesh, RandomStream& random) {
  const auto& t = mesh.triangles[random.next_u64() % mesh.triangles.size()];
  const float a = random.next_float(), b = (1 - a) * random.next_float(), c = 1 - a - b;
  SurfacePoint point;
  point.position_m = a * mesh.positions_m[t[0]] + b * mesh.positions_m[t[1]] + c * mesh.positions_m[t[2]];
  point.normal = mesh.normals[t[0]];
  point.u = a * mesh.uvs[t[0]][0] + b * mesh.uvs[t[1]][0] + c * mesh.uvs[t[2]][0];
  point.v = a * mesh.uvs[t[0]][1] + b * mesh.uvs[t[1]][1] + c * mesh.uvs[t[2]][1];
  return point;
}

class EveryScene : public ::testing::TestWithParam<SceneEntry> {};

TEST_P(EveryScene, CarriesTheNameOfItsEntryAndSaysWhatItProvokes) {
  const Scene& scene = scene_of(GetParam());
  EXPECT_EQ(scene.id, GetParam().id);
  EXPECT_EQ(scene.title, GetParam().title);
  EXPECT_GT(scene.description.size(), 40u);
}

TEST_P(EveryScene, CanBeRendered) {
  EXPECT_NO_THROW(validate(scene_of(GetParam())));
}

TEST_P(EveryScene, IsTheSameAtEveryCall) {
  EXPECT_EQ(geometry_hash(build_scene(GetParam().id)), geometry_hash(scene_of(GetParam())));
}

TEST_P(EveryScene, HasUnitNormalsAndCoordinatesForEveryVertex) {
  for (const Mesh& mesh : scene_of(GetParam()).meshes) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions_m.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions_m.size());
    std::size_t bad = 0;
    for (const Vec3& n : mesh.normals) bad += std::abs(n.squaredNorm() - 1) < 1e-3f ? 0u : 1u;
    for (const auto& [u, v] : mesh.uvs) bad += std::isfinite(u) && std::isfinite(v) ? 0u : 1u;
    EXPECT_EQ(bad, 0u) << "material " << mesh.material;
  }
}

TEST_P(EveryScene, StaysBelowOneAndAHalfMillionTriangles) {
  const std::size_t triangles = triangles_of(scene_of(GetParam()));
  EXPECT_GT(triangles, 10'000u);
  EXPECT_LT(triangles, 1'500'000u);
}

TEST_P(EveryScene, HasTexturesWithinTheirRanges) {
  const Scene& scene = scene_of(GetParam());
  RandomStream random(1, 0x74657874, 0);
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    for (int i = 0; i < 200; ++i) {
      const SurfacePoint point = random_point(mesh, random);
      const Rgb albedo = material.albedo ? material.albedo(point) : Rgb{};
      for (const float value : {albedo.r, albedo.g, albedo.b}) {
        ASSERT_TRUE(value >= 0 && value <= 1) << "albedo " << value << " of material " << mesh.material;
      }
      const float roughness = material.roughness ? material.roughness(point) : 1;
      ASSERT_TRUE(roughness > 0 && roughness <= 1)
          << "roughness " << roughness << " of material " << mesh.material;
      const Vec3 normal = material.normal ? material.normal(point) : point.normal;
      ASSERT_NEAR(normal.norm(), 1, 1e-3) << "material " << mesh.material;
    }
  }
}

TEST_P(EveryScene, HasPresetsThatCanBeRecorded) {
  const Scene& scene = scene_of(GetParam());
  for (const Preset preset : {Preset::kQuick, Preset::kPaper}) {
    EXPECT_NO_THROW(grid_of(scene, preset).validate());
    RenderSettings settings;
    settings.paths_per_pixel = preset_of(scene, preset).paths_per_pixel;
    EXPECT_NO_THROW(settings.validate());
  }
  EXPECT_EQ(scene.paper.columns, 17);
  EXPECT_EQ(scene.paper.rows, scene.medium || scene.id == "cellar" ? 5 : 9);
  EXPECT_GE(scene.paper.paths_per_pixel, scene.quick.paths_per_pixel);
}

/// A small picture from the middle of the grid, one path a sample.
KeyView<SceneReferred> look(const Scene& scene) {
  ViewGrid grid = grid_of(scene, Preset::kQuick);
  grid.width = 32;
  grid.height = 18;
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  return render_view(PreparedScene(scene), grid, {(grid.columns - 1) / 2.0, (grid.rows - 1) / 2.0}, settings)
      .view;
}

TEST_P(EveryScene, ShowsAHighDynamicRangeAndDisparitiesThatFitTheImage) {
  const Scene& scene = scene_of(GetParam());
  const KeyView<SceneReferred> view = look(scene);
  float brightest = 0, nearest_px = 0;
  std::size_t dim = 0;
  for (const Rgb& c : view.colour.pixels()) brightest = std::max(brightest, luminance(c));
  for (const Rgb& c : view.colour.pixels()) dim += luminance(c) < brightest / 100 ? 1u : 0u;
  for (const float d : view.disparity.pixels()) nearest_px = std::max(nearest_px, d);
  EXPECT_GT(brightest, 1000);
  EXPECT_GT(dim, 0u);
  const float full_px = nearest_px * static_cast<float>(scene.quick.width) / 32;
  EXPECT_GT(full_px, 4) << "px between neighbouring views of the quick preset";
  EXPECT_LT(full_px, static_cast<float>(scene.quick.height) / 4);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, ::testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& parameter) {
                           std::string name = parameter.param.id;
                           std::erase(name, '-');
                           return name;
                         });

TEST(SceneTable, HasUniqueIds) {
  std::set<std::string> ids;
  for (const SceneEntry& entry : scenes()) EXPECT_TRUE(ids.insert(entry.id).second) << entry.id;
}

TEST(SceneTable, ListsTheKnownIdsWhenAskedForAnUnknownOne) {
  try {
    build_scene("celar");
    FAIL() << "an unknown id was accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("celar"), std::string::npos);
    for (const SceneEntry& entry : scenes()) EXPECT_NE(message.find(entry.id), std::string::npos) << entry.id;
  }
}

TEST(CellarScene, HasAPostThatSomeCamerasOfTheQuickGridDoNotSee) {
  Scene scene = build_scene("cellar");
  scene.max_bounces = 0;  // disparity alone matters
  const ViewGrid grid = grid_of(scene, Preset::kQuick);
  const PreparedScene prepared(scene);
  ViewGrid small = grid;
  small.width = 96;
  small.height = 54;
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  // The post stands 0.9 m away: nothing else is nearer than 1 m.
  const auto pixels_of_post = [&](double column) {
    const auto view = render_view(prepared, small, {column, 1}, settings).view;
    std::size_t count = 0;
    for (const float d : view.disparity.pixels())
      count += static_cast<double>(d) > small.disparity_px(1) ? 1u : 0u;
    return count;
  };
  EXPECT_EQ(pixels_of_post(0), 0u);
  EXPECT_GT(pixels_of_post(grid.columns - 1), 54u * 10u);
}

/// Luminances of one view of the quick grid at another width, sorted; 16 paths a pixel.
std::vector<float> sorted_luminance(const PreparedScene& scene, CameraPosition at, int width) {
  ViewGrid grid = grid_of(scene.scene(), Preset::kQuick);
  grid.width = width;
  grid.height = width * 9 / 16;
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  const KeyView<SceneReferred> view = render_view(scene, grid, at, settings).view;
  std::vector<float> values;
  for (const Rgb& c : view.colour.pixels()) values.push_back(luminance(c));
  std::sort(values.begin(), values.end());
  return values;
}

float percentile(const std::vector<float>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

TEST(DunesScene, HidesTheSunByDegreesFromTheUpperToTheLowerRows) {
  Scene scene = build_scene("dunes");
  scene.max_bounces = 0;  // what is lit does not matter
  const PreparedScene prepared(scene);
  ViewGrid grid = grid_of(scene, Preset::kQuick);
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  settings.row_begin = grid.height / 5;
  settings.row_end = grid.height / 2;
  std::vector<std::size_t> samples_of_disc;
  std::vector<float> brightest;
  for (const double row : {0.0, 1.0, 2.0}) {
    const SampledView view = render_samples(prepared, grid, {2, row}, settings);
    std::size_t count = 0;
    float peak = 0;
    for (const Rgb& c : view.radiance.pixels()) {
      count += luminance(c) > 2e8f ? 1u : 0u;
      peak = std::max(peak, luminance(c));
    }
    samples_of_disc.push_back(count);
    brightest.push_back(peak);
  }
  EXPECT_GT(samples_of_disc[0], 100u);
  EXPECT_GT(samples_of_disc[1], samples_of_disc[0] / 4);
  EXPECT_LT(samples_of_disc[1], samples_of_disc[0] * 3 / 4);
  EXPECT_EQ(samples_of_disc[2], 0u);
  EXPECT_GT(brightest[2], 1e5f) << "the aureole is still seen";
}

TEST(DominoesScene, HasTheSameExtremeInDistantViewsAlthoughTheyAreNoisy) {
  const PreparedScene prepared(build_scene("dominoes"));
  std::vector<float> peaks;
  for (const CameraPosition at : {CameraPosition{0, 0}, CameraPosition{4, 2}}) {
    const std::vector<float> values = sorted_luminance(prepared, at, 64);
    peaks.push_back(values.back());
    EXPECT_GT(values.back(), 100 * percentile(values, 0.5));
  }
  EXPECT_NEAR(peaks[0], peaks[1], 0.15f * peaks[0]);
}

TEST(DeskScene, HasExtremesThatChangeBetweenNeighboursThoughItsLightDoesNot) {
  const PreparedScene prepared(build_scene("desk"));
  std::vector<float> peaks, high;
  for (const double column : {0.0, 1.0, 2.0, 3.0}) {
    const std::vector<float> values = sorted_luminance(prepared, {column, 1}, 128);
    peaks.push_back(values.back());
    high.push_back(percentile(values, 0.99));
  }
  const auto spread = [](const std::vector<float>& v) {
    const auto [least, most] = std::minmax_element(v.begin(), v.end());
    return *most / *least;
  };
  EXPECT_GT(spread(peaks), 3);
  EXPECT_LT(spread(high), 1.2f);
}

}  // namespace
}  // namespace plenolab
