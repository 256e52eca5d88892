// Pictures of which every part takes the table of its own volume.
#include "core/lut/mixed_image.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/lut/grade.h"
#include "core/lut/volumes.h"

namespace plenolab {
namespace {

Plane<int> row_of(const std::vector<int>& values) {
  Plane<int> row(static_cast<int>(values.size()), 1);
  std::ranges::copy(values, row.row(0));
  return row;
}

DisplayImage random_picture(int width, int height) {
  DisplayImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    RandomStream random(4, 4, i);
    image.pixels()[i] = {random.next_float(), random.next_float(), random.next_float()};
  }
  return image;
}

TEST(MixedImage, AnObjectTakesTheVolumeOfMostOfItsPixels) {
  const Plane<int> volume = row_of({0, 0, 1, 1, 1, -1, -1, 0});
  const Plane<int> object = row_of({3, 3, 3, 0, 0, 0, -1, -1});
  EXPECT_EQ(volume_of_objects(volume, object, 2), row_of({0, 0, 0, 1, 1, 1, -1, 0}));
}

TEST(MixedImage, OfEqualVolumesTheFirstWinsAndTheBackgroundBeforeAll) {
  EXPECT_EQ(volume_of_objects(row_of({1, 0}), row_of({5, 5}), 2), row_of({0, 0}));
  EXPECT_EQ(volume_of_objects(row_of({1, -1}), row_of({5, 5}), 2), row_of({-1, -1}));
}

TEST(MixedImage, ObjectsOfOnePixelLeaveEveryPixelAsItIs) {
  const Plane<int> volume = row_of({2, 0, -1, 1});
  EXPECT_EQ(volume_of_objects(volume, row_of({0, 1, 2, 3}), 3), volume);
  EXPECT_EQ(volume_of_objects(volume, row_of({-1, -1, -1, -1}), 3), volume);
  EXPECT_TRUE(volume_of_objects({}, {}, 3).empty());
}

TEST(MixedImage, EveryPixelIsGradedByTheTableOfItsVolumeForAnyThreads) {
  const DisplayImage picture = random_picture(37, 41);
  const std::vector<Lut> luts{bake_lut(9,
                                       [](Rgb c) {
                                         return Rgb{c.g, c.b, c.r};
                                       }),
                              bake_lut(17, [](Rgb c) { return c * 1.5f; })};
  const std::vector<PreparedLut> tables{PreparedLut(luts[0]), PreparedLut(luts[1])};
  const Lut identity = identity_lut(5);
  const PreparedLut background(identity);
  // Runs of one to seven pixels of a volume, and whole rows.
  Plane<int> volume(37, 41);
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 37; ++x) volume.at(x, y) = x / (1 + y % 7) % 3 - 1;
  std::fill_n(volume.row(5), 37, 1);
  const DisplayImage mixed = grade_mixed(picture, volume, tables, background, 1);
  EXPECT_EQ(grade_mixed(picture, volume, tables, background, 2), mixed);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const int v = volume.pixels()[i];
    const Lut& lut = v < 0 ? identity : luts[static_cast<std::size_t>(v)];
    const Rgb literal = cut_to_unit(sample_lut(lut, picture.pixels()[i], LutInterpolation::kTetrahedral));
    EXPECT_NEAR(mixed.pixels()[i].r, literal.r, 1e-6);
    EXPECT_NEAR(mixed.pixels()[i].g, literal.g, 1e-6);
    EXPECT_NEAR(mixed.pixels()[i].b, literal.b, 1e-6);
  }
}

TEST(MixedImage, RefusesMapsOfOtherSizes) {
  EXPECT_THROW(volume_of_objects(Plane<int>(2, 3), Plane<int>(3, 2), 1), InputError);
  EXPECT_THROW(grade_mixed(DisplayImage(2, 3), Plane<int>(2, 2), {}, PreparedLut(identity_lut(2))),
               InputError);
}

TEST(MixedImage, DepthsThatAreNoneTakeTheBackground) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(),
                  kNan = std::numeric_limits<float>::quiet_NaN();
  // The volume holds the camera and everything around it.
  const std::vector<Volume> around{{"around", {-100, -100, -100}, {100, 100, 100}, 0, 1}};
  Plane<float> depth(6, 1, 3);
  depth.at(1, 0) = kInfinity;
  depth.at(2, 0) = kNan;
  depth.at(3, 0) = 0;
  depth.at(4, 0) = -2;
  const Plane<int> volume = volume_of_pixels(depth, {}, around);
  EXPECT_EQ(volume, row_of({0, -1, -1, -1, -1, 0}));
  const VolumeCounts counts = count_pixels(depth, {}, around);
  EXPECT_EQ(counts.volumes[0], 2);
  EXPECT_EQ(counts.background, 4);
  // An object part of which has no depth goes with the rest of it.
  EXPECT_EQ(volume_of_objects(volume, row_of({1, -1, 1, 1, -1, 1}), 1), row_of({-1, -1, -1, -1, -1, -1}))
      << "two against two: the background";
}

TEST(MixedImage, VolumesWithoutExtentAndVolumesInEachOtherAreNoSpecialCase) {
  const DepthCamera camera;
  const std::vector<Volume> nested{{"outer", {-9, -9, -9}, {9, 9, 9}, 0, 1},
                                   {"plane", {-9, 4, -9}, {9, 4, 9}, 0, 1},
                                   {"inner", {-1, 3, -1}, {1, 5, 1}, 0, 1}};
  const Plane<float> wall(5, 5, 4), nearer(5, 5, 3.5f);
  const Plane<int> on_plane = volume_of_pixels(wall, camera, nested),
                   before = volume_of_pixels(nearer, camera, nested);
  EXPECT_EQ(on_plane.at(2, 2), 1) << "a box without content is the smallest";
  EXPECT_EQ(before.at(2, 2), 2);
  EXPECT_EQ(before.at(0, 2), 0);
  // The camera stands in the outer volume alone: linear weights know nothing of what is seen.
  EXPECT_EQ(linear_weights(nested, camera.position_m).volumes, (std::vector<double>{1, 0, 0}));
}

}  // namespace
}  // namespace plenolab
