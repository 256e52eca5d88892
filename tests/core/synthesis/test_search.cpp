#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "core/synthesis/key_views.h"
#include "core/synthesis/search.h"
#include "core/synthesis/synthesizer.h"
#include "test_fields.h"

namespace plenolab {
namespace {

using namespace testing_support;

CameraPosition inside_cell(const ViewGrid& grid, double s, double t) {
  return {grid.columns > 1 ? s : 0, grid.rows > 1 ? t : 0};
}

/// Compares literal search, occupancy search and vector search, pixel by pixel, bit by bit, for every key
/// view.
void expect_equal_searches(const LightField& field, CameraPosition position, SynthesisOptions options) {
  const ViewGrid& grid = field.grid();
  for (const UsedView& used : select_key_views(grid, position)) {
    const PreparedView view = prepare_view(*field.view(used.column, used.row), 1);
    const EpipolarPath path =
        make_path(grid, position, used, static_cast<double>(field.max_disparity_px()), options);
    const TileOccupancy occupancy = build_occupancy(view, path, 1);
    auto hits = std::make_unique<PatchHits>();
    for (int top = 0; top < grid.height; top += TileOccupancy::kTileHeight)
      for (int left = 0; left < grid.width; left += Patch::kMaxWidth) {
        const Patch patch{left, top, std::min(Patch::kMaxWidth, grid.width - left),
                          std::min(TileOccupancy::kTileHeight, grid.height - top)};
        SearchCounts by_pixel;
        const SearchCounts by_patch = search_patch(view, path, occupancy, patch, *hits);
        for (int y = 0; y < patch.height; ++y)
          for (int x = 0; x < patch.width; ++x) {
            SearchCounts linear_counts;
            const Hit linear = search_pixel(view, path, {}, left + x, top + y, linear_counts);
            const Hit occupied = search_pixel(view, path, occupancy.tile_of_pixel(left + x, top + y),
                                              left + x, top + y, by_pixel);
            ASSERT_EQ(linear, occupied)
                << "pixel " << left + x << ", " << top + y << " baseline " << used.b_x << ", " << used.b_y;
            const Hit vector = hits->get(y * Patch::kMaxWidth + x);
            ASSERT_EQ(linear.found(), vector.found()) << left + x << ", " << top + y;
            if (linear.found()) {
              ASSERT_EQ(linear, vector) << left + x << ", " << top + y;
            }
          }
        if (!path.is_key_view()) {
          EXPECT_EQ(by_pixel.samples, by_patch.samples);
          EXPECT_EQ(by_pixel.refine, by_patch.refine);
        }
      }
  }
}

void expect_equal_everywhere(const LightField& field) {
  for (double step : {0.25, 0.5, 1.0, 2.0, 4.0})
    for (CameraPosition at : {CameraPosition{0.5, 0.5}, CameraPosition{0.13, 0.82}, CameraPosition{1, 0.4},
                              CameraPosition{1e-12, 0}, CameraPosition{0.3, 1e-12}}) {
      SynthesisOptions options;
      options.step_px = step;
      expect_equal_searches(field, inside_cell(field.grid(), at.s, at.t), options);
    }
}

TEST(FastSearch, FindsTheLinearSearchsHitsInUnrelatedNoise) {
  expect_equal_everywhere(random_field(grid_of(2, 2, 61, 43), 12, 1));
}

TEST(FastSearch, FindsTheLinearSearchsHitsOnStepsAndSlantsWithOutliers) {
  expect_equal_everywhere(stepped_field(grid_of(2, 2, 90, 50), 20, 0.01f, 2));
}

TEST(FastSearch, FindsTheLinearSearchsHitsOnStepsWithoutOutliers) {
  expect_equal_everywhere(stepped_field(grid_of(2, 2, 90, 50), 35, 0, 3));
}

TEST(FastSearch, FindsTheLinearSearchsHitsOnEdgesOfEverySlopeAndDirection) {
  expect_equal_everywhere(ramped_field(grid_of(2, 2, 110, 80), 40, 21));
  expect_equal_everywhere(ramped_field(grid_of(2, 2, 110, 80), 6, 22));
}

TEST(FastSearch, FindsTheLinearSearchsHitsWhereRowsAreSpacedUnlikeColumns) {
  expect_equal_everywhere(stepped_field(grid_of(2, 2, 70, 60, 0.37), 20, 0.01f, 4));
  expect_equal_everywhere(stepped_field(grid_of(2, 2, 70, 60, 2.6), 9, 0.01f, 5));
}

TEST(FastSearch, FindsTheLinearSearchsHitsOnConstantMaps) {
  for (double disparity : {0.0, 0.3, 7.0, 7.37, 500.0})
    expect_equal_everywhere(plane_field(grid_of(2, 2, 40, 30), disparity));
}

TEST(FastSearch, FindsTheLinearSearchsHitsWhereDisparityExceedsTheImage) {
  expect_equal_everywhere(stepped_field(grid_of(2, 2, 33, 21), 400, 0.05f, 6));
  expect_equal_everywhere(random_field(grid_of(2, 2, 20, 20), 1e6f, 7));
  expect_equal_everywhere(random_field(grid_of(2, 2, 20, 20), 9e8f, 8));
}

TEST(FastSearch, FindsTheLinearSearchsHitsInImagesOfOneRowOrColumn) {
  expect_equal_everywhere(random_field(grid_of(2, 2, 1, 1), 5, 9));
  expect_equal_everywhere(random_field(grid_of(2, 2, 1, 37), 5, 10));
  expect_equal_everywhere(random_field(grid_of(2, 2, 300, 1), 5, 11));
  expect_equal_everywhere(random_field(grid_of(2, 2, 2, 9), 5, 12));
}

TEST(FastSearch, FindsTheLinearSearchsHitsInGridsOfOneRowOrColumn) {
  expect_equal_everywhere(stepped_field(grid_of(2, 1, 50, 30), 12, 0.01f, 13));
  expect_equal_everywhere(stepped_field(grid_of(1, 2, 50, 30), 12, 0.01f, 14));
  expect_equal_everywhere(stepped_field(grid_of(1, 1, 50, 30), 12, 0.01f, 15));
}

TEST(FastSearch, FindsTheLinearSearchsHitsForTheFixedScreen) {
  const LightField field = stepped_field(grid_of(3, 3, 60, 45, 0.8), 15, 0.01f, 16);
  for (double depth : {0.5, 3.0, 40.0})
    for (CameraPosition at : {CameraPosition{0.5, 0.5}, CameraPosition{1.9, 0.2}, CameraPosition{2, 1}}) {
      SynthesisOptions options;
      options.camera = CameraKind::kFixedScreen;
      options.screen_depth_m = depth;
      expect_equal_searches(field, at, options);
    }
}

TEST(FastSearch, LooksAtFewerSamplesThanTheLinearSearchOnSmoothSurfaces) {
  const auto field = field_of(grid_of(2, 2, 320, 200), [](int c, int r, int x, int y) {
    const bool front = x + 60 * c > 150 && x + 60 * c < 230 && y + 60 * r > 80 && y + 60 * r < 150;
    return std::pair(Rgb{1, 1, 1}, front ? 60.0f : 20 + 0.05f * static_cast<float>(y + 20 * r));
  });
  SynthesisOptions linear, fast;
  linear.search = SearchKind::kLinear;
  const auto by_linear = synthesize(field, {0.5, 0.5}, linear).statistics;
  const auto by_fast = synthesize(field, {0.5, 0.5}, fast).statistics;
  EXPECT_LT(by_fast.search_samples, by_linear.search_samples / 2);
  EXPECT_EQ(by_fast.refine_samples, by_linear.refine_samples);
}

std::size_t candidates_of_an_edge(float left, float right) {
  const ViewGrid grid = grid_of(2, 2, 320, 64);
  const auto field = field_of(grid, [=](int, int, int x, int) {
    return std::pair(Rgb{1, 1, 1}, x < 160 ? left : right);
  });
  const CameraPosition at{0.5, 0};
  const UsedView used = select_key_views(grid, at).front();
  const EpipolarPath path = make_path(grid, at, used, 60, {});
  const TileOccupancy occupancy = build_occupancy(prepare_view(*field.view(0, 0), 1), path, 1);
  std::size_t count = 0;
  for (const std::uint64_t word : occupancy.bits) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

TEST(FastSearch, LeavesOutEdgesThatNoSearchStopsAt) {
  const std::size_t one = candidates_of_an_edge(60, 5), other = candidates_of_an_edge(5, 60);
  EXPECT_GT(4 * std::max(one, other), 5 * std::min(one, other));
}

TEST(EpipolarPath, StartsOneStepBeyondTheLargestDisparityAndEndsAtExactlyZero) {
  const ViewGrid grid = grid_of(2, 2, 100, 100, 0.5);
  const UsedView view{0, 0, 0.6, 0.8, 0};
  const EpipolarPath path = make_path(grid, {0.6, 0.8}, view, 10, {});
  const double step = 1 / std::hypot(0.6, 0.4);
  EXPECT_DOUBLE_EQ(path.start, 10 + step);
  EXPECT_DOUBLE_EQ(path.disparity(1), 10);
  EXPECT_EQ(path.samples.back().d, 0);
  EXPECT_EQ(path.samples.back().fx, 0);
  for (int k = 1; k < path.last(); ++k) {
    const PathSample &a = path.samples[static_cast<std::size_t>(k - 1)],
                     &b = path.samples[static_cast<std::size_t>(k)];
    EXPECT_NEAR(std::hypot(a.ox + a.fx - b.ox - b.fx, a.oy + a.fy - b.oy - b.fy), 1, 1e-5);
  }
}

TEST(EpipolarPath, HardlyMovingPathsStillSampleTheLargestDisparityAndZero) {
  const ViewGrid grid = grid_of(2, 2, 10, 10);
  for (double b : {1e-12, 1e-150, 1e-310}) {
    const EpipolarPath path = make_path(grid, {b, 0}, {0, 0, b, 0, 1}, 25, {});
    ASSERT_GE(path.samples.size(), 2u);
    EXPECT_EQ(path.samples[path.samples.size() - 2].d, 25);
    EXPECT_EQ(path.samples.back().d, 0);
  }
}

TEST(EpipolarPath, RefusesAScreenNearerThanAnyImageCouldShow) {
  SynthesisOptions options;
  options.camera = CameraKind::kFixedScreen;
  options.screen_depth_m = 1e-9;
  EXPECT_THROW(make_path(grid_of(2, 2, 10, 10), {0.2, 0}, {0, 0, 0.2, 0, 1}, 5, options), std::runtime_error);
}

}  // namespace
}  // namespace plenolab
