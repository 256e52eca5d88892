// Post-processing volumes: weights by place and by what is seen.
#include "core/lut/volumes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Around the camera: a room, a cupboard inside it, and a neighbouring room.
std::vector<Volume> rooms() {
  return {{"room", {-2, 0, -2}, {2, 8, 2}, 1, 1},
          {"cupboard", {-1, 4, -1}, {0, 5, 1}, 1, 0.5},
          {"next", {2, 0, -2}, {6, 8, 2}, 2, 1}};
}

double sum_of(const VolumeWeights& weights) {
  return std::accumulate(weights.volumes.begin(), weights.volumes.end(), weights.background);
}

/// Depths of all kinds, some of them no depths.
Plane<float> random_depth(int width, int height) {
  Plane<float> depth(width, height);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    RandomStream random(5, 2, i);
    const float kind = random.next_float();
    depth.pixels()[i] = kind < 0.1f    ? kInfinity
                        : kind < 0.15f ? std::numeric_limits<float>::quiet_NaN()
                        : kind < 0.2f  ? -1
                                       : 0.5f + 9 * random.next_float();
  }
  return depth;
}

TEST(Volumes, TheInnermostOfSeveralBoxesWins) {
  const auto volumes = rooms();
  EXPECT_EQ(innermost(volumes, {-0.5, 4.5, 0}), 1);
  EXPECT_EQ(innermost(volumes, {0.5, 4.5, 0}), 0);
  EXPECT_EQ(innermost(volumes, {4, 4, 0}), 2);
  EXPECT_EQ(innermost(volumes, {0, -0.001, 0}), -1);
  EXPECT_EQ(innermost(volumes, {2, 4, 0}), 0) << "boxes are closed, and the first of equals wins";
}

TEST(Volumes, LinearWeightsFallWithDistanceAndTheInnermostBoxWinsAlone) {
  const auto volumes = rooms();
  // Zhao 2019, section 2.7.2: weight 1, radius 1000: 0.5 at a distance of 500.
  const std::vector<Volume> one{{"a", {0, 0, 0}, {10, 10, 10}, 1000, 1}};
  EXPECT_DOUBLE_EQ(linear_weights(one, {5, -500, 5}).volumes[0], 0.5);
  EXPECT_DOUBLE_EQ(linear_weights(one, {5, -500, 5}).background, 0.5);
  EXPECT_DOUBLE_EQ(linear_weights(one, {5, -1000, 5}).volumes[0], 0);
  EXPECT_DOUBLE_EQ(linear_weights(one, {13, 5, 14}).volumes[0], 0.995) << "distance to a corner edge is 5";
  const VolumeWeights inside = linear_weights(volumes, {-0.5, 4.5, 0});
  EXPECT_EQ(inside.volumes, (std::vector<double>{0, 0.5, 0}));
  EXPECT_DOUBLE_EQ(inside.background, 0.5);
  // In front of both rooms: each at 0.5 m, radii 1 and 2 m.
  const VolumeWeights between = linear_weights(volumes, {2, -0.5, 0});
  EXPECT_DOUBLE_EQ(between.volumes[0], 0.5 / 1.25);
  EXPECT_DOUBLE_EQ(between.volumes[2], 0.75 / 1.25);
  EXPECT_DOUBLE_EQ(between.background, 0);
  EXPECT_DOUBLE_EQ(linear_weights({}, {0, 0, 0}).background, 1);
}

TEST(Volumes, WorldPositionsAreThoseOfThePinholeCamera) {
  const DepthCamera camera{{1, 2, 3}, {0, 1, 0}, {0, 0, 1}, 90};
  // Opening angle 90°: half the width is as far aside as the depth.
  const Point3 right_edge = camera.world_of(9, 4, 10, 10, 2);
  EXPECT_NEAR(right_edge[0], 1 + 2 * 0.9, 1e-12);
  EXPECT_NEAR(right_edge[1], 4, 1e-12);
  EXPECT_NEAR(right_edge[2], 3 + 2 * 0.1, 1e-12);
  EXPECT_LT(camera.world_of(5, 9, 10, 10, 2)[2], 3) << "rows run down";
}

TEST(Volumes, CountsAgreeWithTheLiteralAlgorithmForAnyThreadsAndStride) {
  const auto volumes = rooms();
  const DepthCamera camera{{0.3, -1, 0.2}, {0.6, 0.8, 0}, {0, 0, 1}, 75};
  for (const auto& [width, height] : {std::pair(133, 71), std::pair(1, 1), std::pair(7, 3)}) {
    const Plane<float> depth = random_depth(width, height);
    const Plane<int> owner = volume_of_pixels(depth, camera, volumes);
    for (const int stride : {1, 2, 3, 8, 1000}) {
      std::vector<std::int64_t> expected(volumes.size() + 1);
      for (int y = 0; y < height; y += stride)
        for (int x = 0; x < width; x += stride)
          ++expected[static_cast<std::size_t>((owner.at(x, y) + 4) % 4)];
      for (const int threads : {1, 2}) {
        const VolumeCounts counts = count_pixels(depth, camera, volumes, {stride, threads});
        for (std::size_t k = 0; k < volumes.size(); ++k)
          EXPECT_EQ(counts.volumes[k], expected[k]) << width << " " << stride << " " << k;
        EXPECT_EQ(counts.background, expected[3]);
      }
    }
  }
}

TEST(Volumes, CountsAreTheSameWhereverInTheWorldTheSceneLies) {
  const DepthCamera at_home{{0.3, -1, 0.2}, {0.6, 0.8, 0}, {0, 0, 1}, 75};
  const Plane<float> depth = random_depth(320, 180);
  // Coordinates of a map: UTM has northings of millions of metres.
  for (const Point3& shift : {Point3{0, 0, 0}, Point3{4.5e5, 5e6, 100}, Point3{-1e7, 1e7, 1e7}}) {
    DepthCamera camera = at_home;
    std::vector<Volume> volumes = rooms();
    for (std::size_t k = 0; k < 3; ++k) {
      camera.position_m[k] += shift[k];
      for (Volume& volume : volumes) {
        volume.min[k] += shift[k];
        volume.max[k] += shift[k];
      }
    }
    const Plane<int> literal = volume_of_pixels(depth, camera, volumes);
    const VolumeCounts counts = count_pixels(depth, camera, volumes);
    for (int v = 0; v < 3; ++v) {
      const auto expected = static_cast<double>(std::ranges::count(literal.pixels(), v));
      if (v != 1) {
        EXPECT_GT(expected, 100) << "the camera looks past the cupboard";
      }
      EXPECT_NEAR(static_cast<double>(counts.volumes[static_cast<std::size_t>(v)]), expected, 2)
          << shift[1] << " " << v;
    }
  }
}

TEST(Volumes, TheFastMapIsTheLiteralOneAndWhatIsCounted) {
  const auto volumes = rooms();
  const DepthCamera camera{{0.3, -1, 0.2}, {0.6, 0.8, 0}, {0, 0, 1}, 75};
  for (const auto& [width, height] : {std::pair(133, 71), std::pair(1, 1), std::pair(7, 3)}) {
    const Plane<float> depth = random_depth(width, height);
    const Plane<int> map = map_pixels(depth, camera, volumes, 2);
    EXPECT_EQ(map, volume_of_pixels(depth, camera, volumes));
    EXPECT_EQ(map, map_pixels(depth, camera, volumes, 1));
    const VolumeCounts counts = count_pixels(depth, camera, volumes);
    for (int v = 0; v < 3; ++v)
      EXPECT_EQ(counts.volumes[static_cast<std::size_t>(v)], std::ranges::count(map.pixels(), v));
  }
  EXPECT_TRUE(map_pixels({}, camera, volumes).empty());
  EXPECT_THROW(map_pixels(Plane<float>(2, 2), {{0, 0, 0}, {0, 2, 0}, {0, 0, 1}, 60}, volumes), InputError);
}

TEST(Volumes, BoxesBeyondThirtyTwoBitsHoldWhatTheyHold) {
  const std::vector<Volume> huge{{"huge", {-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}, 0, 1}};
  const Plane<float> far(5, 5, 3e38f);
  EXPECT_EQ(count_pixels(far, {}, huge).volumes[0], 25);
  EXPECT_EQ(map_pixels(far, {}, huge), volume_of_pixels(far, {}, huge));
}

TEST(Volumes, PixelWeightsAreSharesOfTheFrame) {
  const auto volumes = rooms();
  const DepthCamera camera{{0, 1, 0}, {0, 1, 0}, {0, 0, 1}, 20};
  Plane<float> depth(40, 20, 6.5f);  // the room's far end, behind the cupboard
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 10; ++x) depth.at(x, y) = 3.5f;  // left quarter: at y = 4.5 m, the cupboard
  for (int y = 0; y < 20; ++y)
    for (int x = 30; x < 40; ++x) depth.at(x, y) = kInfinity;
  const VolumeCounts counts = count_pixels(depth, camera, volumes);
  EXPECT_EQ(counts.volumes, (std::vector<std::int64_t>{400, 200, 0}));
  EXPECT_EQ(counts.background, 200);
  const VolumeWeights weights = pixel_weights(counts, volumes);
  EXPECT_DOUBLE_EQ(weights.volumes[0], 0.5);
  EXPECT_DOUBLE_EQ(weights.volumes[1], 0.125) << "a quarter of the pixels, weight ½";
  EXPECT_DOUBLE_EQ(weights.background, 0.375);
  EXPECT_DOUBLE_EQ(sum_of(weights), 1);
}

TEST(Volumes, ExtremesGiveTheBackgroundOrTheBoxAndNothingElse) {
  const DepthCamera camera{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 60};
  const std::vector<Volume> around{{"around", {-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}, 0, 1}};
  const std::vector<Volume> point{{"point", {0, 2, 0}, {0, 2, 0}, 1, 1}};
  const Plane<float> sky(5, 5, kInfinity), wall(5, 5, 2), far(5, 5, 3e38f);
  EXPECT_EQ(count_pixels(sky, camera, around).background, 25);
  EXPECT_EQ(count_pixels(wall, camera, around).volumes[0], 25);
  EXPECT_EQ(count_pixels(far, camera, around).background, 25);
  // The middle pixel of 5 × 5 looks straight ahead and meets the box without extent at 2 m.
  EXPECT_EQ(count_pixels(wall, camera, point).volumes[0], 1);
  EXPECT_DOUBLE_EQ(linear_weights(point, {0, 2, 0}).volumes[0], 1);
  EXPECT_DOUBLE_EQ(linear_weights(point, {0, 2.25, 0}).volumes[0], 0.75);
  EXPECT_EQ(count_pixels(wall, camera, {}).background, 25);
  EXPECT_EQ(pixel_weights(count_pixels(Plane<float>(), camera, around), around).background, 1);
}

TEST(Volumes, RefusesBoxesCamerasAndStridesThatAreNone) {
  const Plane<float> depth(2, 2, 1);
  const auto throws = [&](Volume volume, DepthCamera camera, int stride) {
    EXPECT_THROW(count_pixels(depth, camera, std::vector<Volume>{volume}, {stride, 1}), InputError);
  };
  const Volume box{"box", {0, 0, 0}, {1, 1, 1}, 0, 1};
  throws({"turned", {1, 0, 0}, {0, 1, 1}, 0, 1}, {}, 1);
  throws({"nan", {NAN, 0, 0}, {1, 1, 1}, 0, 1}, {}, 1);
  throws({"heavy", {0, 0, 0}, {1, 1, 1}, 0, 1.1}, {}, 1);
  throws({"radius", {0, 0, 0}, {1, 1, 1}, -1, 1}, {}, 1);
  throws(box, {{0, 0, 0}, {0, 2, 0}, {0, 0, 1}, 60}, 1);
  throws(box, {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, 60}, 1);
  throws(box, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 180}, 1);
  throws(box, {}, 0);
  EXPECT_THROW(linear_weights(std::vector<Volume>{box}, {NAN, 0, 0}), InputError);
}

TEST(Volumes, TheTableOfAFrameIsTheBlendOfItsVolumes) {
  const Lut warm = bake_lut(5, [](Rgb c) { return Rgb{c.r, c.g * 0.5f, 0}; });
  const Lut cold = bake_lut(5, [](Rgb c) { return Rgb{0, c.g, c.b}; });
  const Lut blend = blend_volumes({{0.25, 0.25}, 0.5}, std::vector<Lut>{warm, cold}, identity_lut(5));
  const Rgb white = blend.node(4, 4, 4);
  EXPECT_FLOAT_EQ(white.r, 0.75f);
  EXPECT_FLOAT_EQ(white.g, 0.875f);
  EXPECT_FLOAT_EQ(white.b, 0.75f);
}

}  // namespace
}  // namespace plenolab
