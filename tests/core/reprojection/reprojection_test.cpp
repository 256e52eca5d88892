#include "core/reprojection/reprojection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

CameraArray array_of(int columns, int rows, int size_px) {
  return {{columns, rows, size_px}, 0.001, 19.86};
}

/// Planar depth of a disparity in px per camera.
float depth_of(const CameraArray& array, double disparity_px) {
  return disparity_px == 0 ? kInf : static_cast<float>(array.disparity_px(1) / disparity_px);
}

/// A pattern without end, smooth over some pixels.
Rgb pattern(double x, double y) {
  const auto wave = [](double a) { return static_cast<float>(0.5 + 0.5 * std::sin(a)); };
  return {wave(0.21 * x + 0.1 * y), wave(0.13 * x - 0.23 * y), wave(0.17 * y)};
}

/// What a camera of the array sees of a plane of that disparity.
RenderedCamera see_plane(const CameraArray& array, int column, int row, double disparity_px) {
  const int n = array.layout.size_px;
  RenderedCamera camera{column, row, DisplayImage(n, n), Plane<float>(n, n, depth_of(array, disparity_px))};
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      camera.colour.at(x, y) = pattern(x + column * disparity_px, y + row * disparity_px);
  return camera;
}

std::vector<RenderedCamera> see_plane(const CameraArray& array, double disparity_px) {
  std::vector<RenderedCamera> cameras;
  for (const auto& [column, row] : corner_positions(array.layout))
    cameras.push_back(see_plane(array, column, row, disparity_px));
  return cameras;
}

/// Corner cameras (and a central one) of random colours and depths, some of them unusable.
std::vector<RenderedCamera> random_cameras(const CameraArray& array, std::uint64_t seed, bool central) {
  auto positions = corner_positions(array.layout);
  if (central) positions.push_back(central_position(array.layout));
  RandomStream random(seed, 0x72657072, 0);
  std::vector<RenderedCamera> cameras;
  for (const auto& [column, row] : positions) {
    const int n = array.layout.size_px;
    RenderedCamera camera{column, row, DisplayImage(n, n), Plane<float>(n, n)};
    for (Rgb& c : camera.colour.pixels()) c = {random.next_float(), random.next_float(), random.next_float()};
    for (float& z : camera.depth_m.pixels()) {
      const float kind = random.next_float();
      z = kind < 0.05f   ? kInf
          : kind < 0.1f  ? kNan
          : kind < 0.12f ? 0
                         : depth_of(array, 3 * random.next_double());
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

double largest_difference(const DisplayImage& image, const CameraArray& array, double disparity_px,
                          int margin) {
  double largest = 0;
  const int n = array.layout.size_px;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      if (std::min({x % n, y % n, n - 1 - x % n, n - 1 - y % n}) < margin) continue;
      const Rgb truth = pattern(x % n + (x / n) * disparity_px, y % n + (y / n) * disparity_px);
      largest = std::max(largest, static_cast<double>(std::abs(image.at(x, y).r - truth.r)));
    }
  return largest;
}

double mean_difference(const DisplayImage& image, const CameraArray& array, double disparity_px) {
  double sum = 0;
  const int n = array.layout.size_px;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb truth = pattern(x % n + (x / n) * disparity_px, y % n + (y / n) * disparity_px);
      sum += static_cast<double>(std::abs(image.at(x, y).r - truth.r));
    }
  return sum / static_cast<double>(image.size());
}

TEST(Reprojection, ReproducesAPlaneOfWholePixelsOfDisparityExactly) {
  const CameraArray array = array_of(5, 3, 24);
  for (const auto method : {ReprojectionMethod::kTwoStep, ReprojectionMethod::kOneStep}) {
    const ReprojectionResult result = reproject(array, see_plane(array, 2), {.method = method});
    // 8 px that leave one corner camera's image are in another's, all but those of the rounding of depth.
    EXPECT_LT(largest_difference(result.light_field, array, 2, 0), 2e-4);
    EXPECT_EQ(result.holes, 0);
  }
}

TEST(Reprojection, ReproducesAPlaneOfFractionalDisparityUpToInterpolation) {
  const CameraArray array = array_of(5, 3, 24);
  for (const double disparity : {0.3, 1.37}) {
    const ReprojectionResult result = reproject(array, see_plane(array, disparity));
    // Within the border pixel of a corner camera there is no neighbour to interpolate with: half a pixel of
    // the steepest slope. Elsewhere a sine of 0.23 rad/px is interpolated linearly, twice.
    EXPECT_LT(largest_difference(result.light_field, array, disparity, 2), 0.5 * 0.5 * 0.23);
    EXPECT_LT(mean_difference(result.light_field, array, disparity), 0.5 * 0.23 * 0.23 / 8);
  }
}

TEST(Reprojection, LeavesNoHolesInAPlaneOfAnyDisparity) {
  // Pixels that land up to half a pixel beside the rounded epipolar line belong to a target pixel as well.
  const CameraArray array = array_of(7, 5, 32);
  for (const double disparity : {0.37, 1.37, 2.6})
    for (const auto method : {ReprojectionMethod::kTwoStep, ReprojectionMethod::kOneStep})
      for (const bool central : {false, true}) {
        auto cameras = see_plane(array, disparity);
        const auto [column, row] = central_position(array.layout);
        if (central) cameras.push_back(see_plane(array, column, row, disparity));
        EXPECT_EQ(reproject(array, cameras, {.method = method}).holes, 0) << disparity << ' ' << central;
        EXPECT_EQ(reproject_literally(array, cameras, {.method = method}).holes, 0) << disparity;
      }
}

TEST(Reprojection, KeepsTheRenderedCamerasAsTheyAre) {
  const CameraArray array = array_of(4, 3, 10);
  const auto cameras = random_cameras(array, 5, false);
  const ReprojectionResult result = reproject(array, cameras);
  for (const RenderedCamera& camera : cameras)
    EXPECT_EQ(subimage(result.light_field, array.layout, camera.column, camera.row), camera.colour);
}

TEST(Reprojection, AgreesInOneAndTwoStepsOnConstantDepth) {
  const CameraArray array = array_of(5, 4, 20);
  for (const double disparity : {0.0, 1.0, 2.0}) {
    const auto cameras = see_plane(array, disparity);
    const ReprojectionResult one = reproject(array, cameras, {.method = ReprojectionMethod::kOneStep}),
                             two = reproject(array, cameras, {.method = ReprojectionMethod::kTwoStep});
    EXPECT_LT(largest_difference(one.light_field, array, disparity, 0), 2e-4);
    EXPECT_LT(largest_difference(two.light_field, array, disparity, 0), 2e-4);
  }
}

TEST(Reprojection, IsBitByBitTheLiteralSearch) {
  for (const auto& array : {array_of(5, 3, 17), array_of(2, 2, 8), array_of(1, 4, 9), array_of(6, 1, 9),
                            array_of(1, 1, 4), array_of(3, 3, 1), array_of(4, 7, 12)})
    for (const auto method : {ReprojectionMethod::kTwoStep, ReprojectionMethod::kOneStep})
      for (const auto fill :
           {HoleFill::kMean, HoleFill::kEdge, HoleFill::kBackground, HoleFill::kNearest, HoleFill::kBlack})
        for (const bool central : {false, true}) {
          if (central && (array.layout.columns < 3 || array.layout.rows < 3)) continue;
          const auto cameras = random_cameras(array, 7, central);
          const ReprojectionOptions options{method, fill, true, 2};
          const ReprojectionResult fast = reproject(array, cameras, options),
                                   literal = reproject_literally(array, cameras, options);
          ASSERT_EQ(fast.light_field, literal.light_field)
              << array.layout.columns << " × " << array.layout.rows;
          ASSERT_EQ(fast.disparity_px, literal.disparity_px);
          ASSERT_EQ(fast.offset_px, literal.offset_px);
          ASSERT_EQ(fast.holes, literal.holes);
        }
}

TEST(Reprojection, DoesNotDependOnTheNumberOfThreads) {
  const CameraArray array = array_of(5, 4, 16);
  const auto cameras = random_cameras(array, 3, true);
  EXPECT_EQ(reproject(array, cameras, {.threads = 1}).light_field,
            reproject(array, cameras, {.threads = 2}).light_field);
}

TEST(Reprojection, TakesTheNearestOfAllMatches) {
  // A near pixel before a far plane, seen by the left camera only, must hide the plane where it lands.
  const CameraArray array = array_of(5, 1, 20);
  auto cameras = see_plane(array, 0);
  cameras[0].colour.at(12, 7) = {1, 0, 0};
  cameras[0].depth_m.at(12, 7) = depth_of(array, 2);
  const ReprojectionResult result = reproject(array, cameras, {.record_maps = true});
  for (int column = 1; column < 4; ++column) {
    const Rgb c = result.light_field.at(column * 20 + 12 - 2 * column, 7);
    EXPECT_NEAR(c.r, 1, 1e-3f) << column;
    EXPECT_NEAR(c.g, 0, 1e-3f) << column;
    EXPECT_NEAR(result.disparity_px.at(column * 20 + 12 - 2 * column, 7), 2, 1e-4f);
  }
}

TEST(Reprojection, AssignsEveryPixelToWithinHalfAPixel) {
  const CameraArray array = array_of(6, 5, 24);
  for (const auto method : {ReprojectionMethod::kTwoStep, ReprojectionMethod::kOneStep}) {
    const ReprojectionResult result =
        reproject(array, random_cameras(array, 9, false), {.method = method, .record_maps = true});
    const float largest =
        *std::max_element(result.offset_px.pixels().begin(), result.offset_px.pixels().end());
    EXPECT_LE(largest, 0.5f);
    EXPECT_GT(largest, 0.4f);
  }
}

TEST(Reprojection, LeavesHolesWhereNoCornerCameraSees) {
  // A near stripe covers columns 8 to 11 of both cameras of the row, and what it uncovers in the middle
  // camera was hidden in neither... but columns that both hide stay empty.
  const CameraArray array = array_of(3, 1, 24);
  auto cameras = see_plane(array, 0);
  for (std::size_t i = 0; i < 2; ++i)
    for (int y = 0; y < 24; ++y)
      for (int x = 4; x < 20; ++x)
        if (i == 0 ? x >= 12 : x < 12) cameras[i].depth_m.at(x, y) = kNan;
  for (const auto fill : {HoleFill::kMean, HoleFill::kBlack}) {
    const ReprojectionResult result = reproject(array, cameras, {.holes = fill, .record_maps = true});
    EXPECT_EQ(result.holes, 0) << "each camera shows what the other does not";
  }
  for (std::size_t i = 0; i < 2; ++i)
    for (int y = 0; y < 24; ++y) cameras[i].depth_m.at(10, y) = kNan;
  const ReprojectionResult mean = reproject(array, cameras, {.holes = HoleFill::kMean, .record_maps = true});
  EXPECT_EQ(mean.holes, 24);
  EXPECT_EQ(mean.disparity_px.at(24 + 10, 5), -1);
  const Rgb expected = (cameras[0].colour.at(10, 5) + cameras[1].colour.at(10, 5)) * 0.5f;
  EXPECT_EQ(mean.light_field.at(24 + 10, 5), expected);
  EXPECT_EQ(reproject(array, cameras, {.holes = HoleFill::kBlack}).light_field.at(24 + 10, 5), Rgb{});
  const ReprojectionResult edge = reproject(array, cameras, {.holes = HoleFill::kEdge});
  EXPECT_EQ(edge.light_field.at(24 + 10, 5), edge.light_field.at(24 + 9, 5));
}

TEST(Reprojection, FillsFromTheFartherSideWhenAskedTo) {
  const CameraArray array = array_of(3, 1, 12);
  auto cameras = see_plane(array, 0);
  for (RenderedCamera& camera : cameras)
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 5; ++x) camera.depth_m.at(x, y) = depth_of(array, 0.01);
      camera.depth_m.at(5, y) = camera.depth_m.at(6, y) = kNan;
    }
  const ReprojectionResult result = reproject(array, cameras, {.holes = HoleFill::kBackground});
  EXPECT_EQ(result.light_field.at(12 + 5, 3), result.light_field.at(12 + 7, 3)) << "the side at infinity";
  EXPECT_EQ(result.light_field.at(12 + 6, 3), result.light_field.at(12 + 7, 3));
}

TEST(Reprojection, StandsExtremeInputs) {
  const CameraArray array = array_of(4, 3, 6);
  auto cameras = see_plane(array, 0.5);
  cameras[0].colour.at(2, 2) = {kNan, 0, kInf};
  cameras[1].depth_m.at(3, 3) = std::numeric_limits<float>::denorm_min();
  cameras[2].depth_m.at(3, 3) = -1;
  for (float& z : cameras[3].depth_m.pixels()) z = kNan;
  for (const auto method : {ReprojectionMethod::kTwoStep, ReprojectionMethod::kOneStep}) {
    const ReprojectionResult result = reproject(array, cameras, {.method = method});
    EXPECT_EQ(result.ignored_pixels, 1 + 1 + 36);
    for (const Rgb& c : result.light_field.pixels())
      ASSERT_TRUE(std::isfinite(c.r) && c.r >= 0 && c.r <= 1 && std::isfinite(c.g) && std::isfinite(c.b));
  }
}

TEST(Reprojection, FillsEverythingFromTheMeanIfNothingMatches) {
  const CameraArray array = array_of(3, 3, 4);
  auto cameras = see_plane(array, 0);
  for (RenderedCamera& camera : cameras)
    std::fill(camera.depth_m.pixels().begin(), camera.depth_m.pixels().end(), kNan);
  for (const auto fill : {HoleFill::kMean, HoleFill::kEdge, HoleFill::kBackground, HoleFill::kNearest}) {
    const ReprojectionResult result = reproject(array, cameras, {.holes = fill});
    EXPECT_EQ(result.holes, result.pixels);
    EXPECT_NEAR(result.light_field.at(4 + 1, 4 + 2).r, pattern(1, 2).r, 1e-6f) << "all corners agree";
  }
}

TEST(Reprojection, SaysWhatIsWrongWithItsInput) {
  const CameraArray array = array_of(4, 3, 6);
  auto cameras = see_plane(array, 1);
  EXPECT_THROW(reproject(array, std::span(cameras).first(3)), InputError) << "a corner is missing";
  cameras.push_back(cameras[0]);
  EXPECT_THROW(reproject(array, cameras), InputError) << "given twice";
  cameras.back() = {9, 0, DisplayImage(6, 6), Plane<float>(6, 6)};
  EXPECT_THROW(reproject(array, cameras), InputError) << "outside";
  cameras.back() = {1, 1, DisplayImage(5, 6), Plane<float>(6, 6)};
  EXPECT_THROW(reproject(array, cameras), InputError) << "size";
  EXPECT_THROW((CameraArray{{4, 3, 6}, 0, 19.86}.validate()), InputError);
  EXPECT_THROW((CameraArray{{4, 3, 6}, 0.001, 180}.validate()), InputError);
}

TEST(CameraArray, HasTheThesisDisparityAtTwelveCentimetres) {
  const CameraArray array;
  EXPECT_NEAR(array.disparity_px(0.12), 3.86, 0.005);
  EXPECT_NEAR(14 * array.disparity_px(0.12), 54, 0.1);
  EXPECT_EQ(array.disparity_px(std::numeric_limits<double>::infinity()), 0);
}

TEST(CameraArray, HasItsCentreWhereTheThesisCountsRow4Column8) {
  EXPECT_EQ(central_position({15, 8, 1}), (std::array{7, 3}));
}

}  // namespace
}  // namespace plenolab
