#include "stimuli/render_cache.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/file.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

Scene lit_scene() {
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.5f)};
  scene.meshes = {sphere({0, 3, 0}, 1, 12, 0)};
  scene.sky = uniform_sky(1e5f, 10);  // beyond the range of half floats
  return scene;
}

RenderSettings few_paths() {
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  return settings;
}

const ViewGrid kGrid{3, 2, 0.1, 0.1, 12, 8, 60};

std::filesystem::path entry(const TemporaryFolder& folder, const Scene& scene, CameraPosition at = {1, 1}) {
  return folder.path() / "test" / (render_cache_key(scene, kGrid, at, few_paths()) + ".exr");
}

TEST(RenderCache, TheSecondRequestIsReadAndEqualsTheFirst) {
  const TemporaryFolder folder;
  const PreparedScene prepared(lit_scene());
  const auto first = render_view_cached(prepared, kGrid, {1, 1}, few_paths(), folder.path());
  const auto second = render_view_cached(prepared, kGrid, {1, 1}, few_paths(), folder.path());
  EXPECT_FALSE(first.from_cache);
  EXPECT_TRUE(second.from_cache);
  EXPECT_TRUE(std::filesystem::exists(entry(folder, lit_scene())));
  EXPECT_EQ(first.rendered.view.colour, second.rendered.view.colour);
  EXPECT_EQ(first.rendered.view.disparity, second.rendered.view.disparity);
}

TEST(RenderCache, DamagedEntriesAreRenderedAgainAndReplaced) {
  const TemporaryFolder folder;
  const PreparedScene prepared(lit_scene());
  const auto first = render_view_cached(prepared, kGrid, {1, 1}, few_paths(), folder.path());
  const auto path = entry(folder, lit_scene());
  const std::string whole = read_text_file(path);
  for (const std::string& damaged :
       {std::string("no picture"), whole.substr(0, whole.size() / 2), std::string()}) {
    write_text_file(path, damaged);
    const auto again = render_view_cached(prepared, kGrid, {1, 1}, few_paths(), folder.path());
    EXPECT_FALSE(again.from_cache);
    EXPECT_EQ(first.rendered.view.colour, again.rendered.view.colour);
    EXPECT_EQ(read_text_file(path), whole);
  }
}

TEST(RenderCache, EverythingThatChangesTheResultChangesTheKey) {
  const Scene scene = lit_scene();
  const std::string key = render_cache_key(scene, kGrid, {1, 1}, few_paths());
  EXPECT_NE(key, render_cache_key(scene, kGrid, {1, 0.5}, few_paths()));
  Scene variant = scene;
  variant.variant = "roughness=0.1";
  EXPECT_NE(key, render_cache_key(variant, kGrid, {1, 1}, few_paths()));
  ViewGrid grid = kGrid;
  grid.spacing_y_m = 0.11;
  EXPECT_NE(key, render_cache_key(scene, grid, {1, 1}, few_paths()));
  RenderSettings settings = few_paths();
  settings.seed = 2;
  EXPECT_NE(key, render_cache_key(scene, kGrid, {1, 1}, settings));
  settings = few_paths();
  settings.paths_per_pixel = 32;
  EXPECT_NE(key, render_cache_key(scene, kGrid, {1, 1}, settings));
  settings = few_paths();
  settings.blocks.t1_px = 0.6;
  EXPECT_NE(key, render_cache_key(scene, kGrid, {1, 1}, settings));
}

TEST(RenderCache, ThreadsAndPruningDoNotChangeTheKey) {
  RenderSettings settings = few_paths();
  settings.threads = 2;
  settings.prune = false;
  EXPECT_EQ(render_cache_key(lit_scene(), kGrid, {1, 1}, settings),
            render_cache_key(lit_scene(), kGrid, {1, 1}, few_paths()));
}

TEST(RenderCache, ScenesHaveSourceHashesOfTheirOwn) {
  EXPECT_NE(scene_source_hash("cellar"), scene_source_hash("tunnel"));
  EXPECT_NE(scene_source_hash("cellar"), scene_source_hash("cellar-shafts"));
  EXPECT_EQ(scene_source_hash("no such scene"), scene_source_hash("nor this"));
}

TEST(RenderCache, ALightFieldTakesItsViewsFromTheCache) {
  const TemporaryFolder folder;
  const LightField field = render_light_field(lit_scene(), kGrid, few_paths(), folder.path());
  const auto view = field.view(1, 1);
  EXPECT_EQ(field.grid(), kGrid);
  EXPECT_EQ(field.unit(), RadianceUnit::kCdM2);
  EXPECT_TRUE(std::filesystem::exists(entry(folder, lit_scene())));
  EXPECT_FALSE(std::filesystem::exists(entry(folder, lit_scene(), {0, 0})));  // views are made when used
  const auto direct = render_view(PreparedScene(lit_scene()), kGrid, {1, 1}, few_paths());
  EXPECT_EQ(view->colour, direct.view.colour);
}

TEST(RenderCache, WithoutAFolderNothingIsWritten) {
  const auto view = render_view_cached(PreparedScene(lit_scene()), kGrid, {0, 0}, few_paths(), {});
  EXPECT_FALSE(view.from_cache);
  EXPECT_GT(mean_green(view.rendered.view.colour), 0);
}

}  // namespace
}  // namespace plenolab
