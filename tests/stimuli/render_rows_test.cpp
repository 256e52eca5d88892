#include <gtest/gtest.h>

#include "core/base/error.h"
#include "stimuli/render_cache.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

Scene lit_floor() {
  Scene scene = testing::empty_scene();
  scene.sky = testing::uniform_sky(100, 20);
  scene.materials = {testing::diffuse(0.5f)};
  scene.meshes = {testing::parallelogram({-2, 1, -1}, {4, 0, 0}, {0, 8, 0.5f}, 0)};
  return scene;
}

RenderSettings rows(int begin, int end) {
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  settings.row_begin = begin;
  settings.row_end = end;
  return settings;
}

TEST(RenderRows, AreThoseOfTheWholeViewAndTheOthersAreZero) {
  const ViewGrid grid = testing::small_grid(12, 9);
  const RenderedView whole = testing::render(lit_floor(), grid, rows(0, 0));
  const RenderedView part = testing::render(lit_floor(), grid, rows(3, 6));
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const bool inside = y >= 3 && y < 6;
      EXPECT_EQ(part.view.colour.at(x, y), inside ? whole.view.colour.at(x, y) : Rgb{});
      EXPECT_EQ(part.view.disparity.at(x, y), inside ? whole.view.disparity.at(x, y) : 0.0f);
    }
  EXPECT_EQ(part.stats.camera_rays * 3, whole.stats.camera_rays);
}

TEST(RenderRows, HaveACacheEntryOfTheirOwn) {
  const ViewGrid grid = testing::small_grid();
  EXPECT_NE(render_cache_key(lit_floor(), grid, {0, 0}, rows(0, 0)),
            render_cache_key(lit_floor(), grid, {0, 0}, rows(2, 3)));
  EXPECT_NE(render_cache_key(lit_floor(), grid, {0, 0}, rows(2, 4)),
            render_cache_key(lit_floor(), grid, {0, 0}, rows(2, 3)));
}

TEST(RenderRows, OutsideTheImageOrTheWrongWayRoundAreRefused) {
  const ViewGrid grid = testing::small_grid(4, 4);
  EXPECT_THROW(testing::render(lit_floor(), grid, rows(0, 5)), InputError);
  EXPECT_THROW(testing::render(lit_floor(), grid, rows(4, 0)), InputError);
  EXPECT_THROW(rows(3, 2).validate(), InputError);
  EXPECT_THROW(rows(-1, 2).validate(), InputError);
}

}  // namespace
}  // namespace plenolab
