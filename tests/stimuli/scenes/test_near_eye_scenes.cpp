#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/base/content_hash.h"
#include "stimuli/direct/direct_view.h"
#include "stimuli/render.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

std::string geometry_hash(const Scene& scene) {
  ContentHash hash;
  for (const Mesh& mesh : scene.meshes)
    hash.add_bytes(mesh.positions_m.data(), mesh.positions_m.size() * sizeof(Vec3));
  return hash.hex();
}

/// A small view from the middle of the grid.
DirectView look(const Scene& scene) {
  ViewGrid grid = grid_of(scene, Preset::kQuick);
  grid.width = grid.height = 40;
  return render_direct(DirectScene(scene), grid, {7, 3});
}

TEST(NearEyeScenes, AreFoundByTheirIdsAndTheSameAtEveryCall) {
  std::set<std::string> ids;
  for (const SceneEntry& entry : scenes()) ids.insert(entry.id);
  ASSERT_EQ(near_eye_scenes().size(), 5u);
  for (const SceneEntry& entry : near_eye_scenes()) {
    EXPECT_TRUE(ids.insert(entry.id).second) << entry.id << " is there twice";
    const Scene scene = build_scene(entry.id);
    EXPECT_EQ(scene.id, entry.id);
    EXPECT_EQ(scene.title, entry.title);
    EXPECT_GT(scene.description.size(), 40u);
    EXPECT_NO_THROW(validate(scene));
    EXPECT_EQ(geometry_hash(scene), geometry_hash(entry.build()));
  }
}

TEST(NearEyeScenes, AreRecordedAsTheDisplayAsks) {
  for (const SceneEntry& entry : near_eye_scenes()) {
    const ViewGrid grid = grid_of(entry.build(), Preset::kQuick);
    EXPECT_EQ(grid.columns, 15);
    EXPECT_EQ(grid.rows, 8);
    EXPECT_DOUBLE_EQ(grid.spacing_x_m, 0.001);
    EXPECT_EQ(grid.width, grid.height);
    EXPECT_NEAR(grid.fov_h_deg, 19.86, 1e-5);
  }
}

TEST(NearEyeScenes, LieBetweenTwelveCentimetresAndSixMetresAndFillTheView) {
  for (const SceneEntry& entry : near_eye_scenes()) {
    const DirectView view = look(entry.build());
    const auto [nearest, farthest] =
        std::minmax_element(view.depth_m.pixels().begin(), view.depth_m.pixels().end());
    EXPECT_GE(*nearest, 0.12f) << entry.id;
    EXPECT_LE(*farthest, 6.001f) << entry.id;
  }
}

TEST(NearEyeScenes, EndWithExtremeOcclusionTwelveCentimetresAway) {
  const DirectView view = look(build_scene("near-eye-5"));
  EXPECT_LT(*std::min_element(view.depth_m.pixels().begin(), view.depth_m.pixels().end()), 0.125f);
}

TEST(NearEyeScenes, AreDiffuseSoThatEveryCameraSeesAPointAlike) {
  for (const SceneEntry& entry : near_eye_scenes())
    for (const Material& material : entry.build().materials)
      EXPECT_EQ(material.kind, Material::Kind::kDiffuse);
}

}  // namespace
}  // namespace plenolab
