// Views of lit scenes that say which surface each pixel shows, and the scene to walk through.
#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/direct/lit_view.h"
#include "stimuli/direct/walk_scene.h"
#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {
namespace {

/// A red wall 4 m ahead that fills the left half of the view, and a lamp 2 m ahead right of the middle.
LitScene wall_and_lamp() {
  SceneAssembler scene;
  scene.add(scene.material(diffuse(plain({0.8f, 0.1f, 0.1f}))), upright_rectangle(-20, 0, -20, 20, 4));
  Material shining = lamp({7, 8, 9});
  shining.two_sided = true;
  scene.add(scene.material(shining), upright_rectangle(0.2f, 1, -1, 1, 2));
  LitScene lit;
  scene.finish(lit.scene);
  lit.scene.id = "test";
  lit.scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = {10, 10, 10}, .ground_cd_m2 = {10, 10, 10}};
  lit.environment = [](const Vec3&) { return Rgb{1, 2, 3}; };
  return lit;
}

TEST(LitView, DepthIsPlanarAndMaterialsNameTheSurfaces) {
  const LitView view = LitViews(wall_and_lamp()).render({.fov_h_deg = 90}, 64, 36);
  for (int y = 0; y < 36; ++y) {
    EXPECT_NEAR(view.depth_m.at(0, y), 4, 1e-4);
    EXPECT_EQ(view.material.at(0, y), 0);
    EXPECT_EQ(view.material.at(63, y), -1);
    EXPECT_TRUE(std::isinf(view.depth_m.at(63, y)));
    EXPECT_EQ(view.radiance.at(63, y), (Rgb{1, 2, 3}));
  }
  // At 90° the lamp at 2 m covers the columns of x/y from 0.1 to 0.5.
  EXPECT_EQ(view.material.at(40, 18), 1);
  EXPECT_NEAR(view.depth_m.at(40, 18), 2, 1e-4);
  EXPECT_EQ(view.radiance.at(40, 18), (Rgb{7, 8, 9}));
}

TEST(LitView, SurfacesAreThoseOfTheRenderedViewForAnyThreads) {
  const LitViews views(wall_and_lamp());
  const LitCamera camera{.position_m = {0.3f, -1, 0.2f}, .forward = {0.6f, 0.8f, 0}, .fov_h_deg = 70};
  const LitView lit = views.render(camera, 50, 30, 1), bare = views.surfaces(camera, 50, 30, 2);
  EXPECT_EQ(lit.depth_m, bare.depth_m);
  EXPECT_EQ(lit.material, bare.material);
  EXPECT_TRUE(bare.radiance.empty());
}

TEST(WalkScene, IsTheSameEveryTimeWithAMaterialForEveryObject) {
  const WalkScene a = build_walk_scene(), b = build_walk_scene();
  EXPECT_NO_THROW(validate(a.lit.scene));
  EXPECT_EQ(a.objects.size(), a.lit.scene.materials.size());
  EXPECT_EQ(a.lit.scene.meshes.size(), a.objects.size()) << "no object is empty";
  ASSERT_EQ(a.lit.scene.meshes.size(), b.lit.scene.meshes.size());
  for (std::size_t i = 0; i < a.lit.scene.meshes.size(); ++i)
    EXPECT_EQ(a.lit.scene.meshes[i].positions_m, b.lit.scene.meshes[i].positions_m) << a.objects[i];
  EXPECT_EQ(a.objects, b.objects);
}

TEST(WalkScene, RoomsAreApartAndSomeObjectsReachFromOneIntoTheNext) {
  const WalkScene walk = build_walk_scene();
  const auto apart = [](const WalkRoom& a, const WalkRoom& b) {
    return ((a.min_m.array() > b.max_m.array()) || (b.min_m.array() > a.max_m.array())).any();
  };
  EXPECT_TRUE(apart(walk.rooms[0], walk.rooms[1]));
  EXPECT_TRUE(apart(walk.rooms[1], walk.rooms[2]));
  EXPECT_TRUE(apart(walk.rooms[0], walk.rooms[2]));
  int crossing = 0;
  for (const Mesh& mesh : walk.lit.scene.meshes) {
    int rooms = 0;
    for (const WalkRoom& room : walk.rooms)
      rooms += std::ranges::any_of(mesh.positions_m, [&](const Vec3& p) {
        return (p.array() >= room.min_m.array()).all() && (p.array() <= room.max_m.array()).all();
      });
    crossing += rooms > 1 ? 1 : 0;
  }
  EXPECT_EQ(crossing, 5) << "carpet, pipe, pergola, long bench, path";
}

}  // namespace
}  // namespace plenolab
