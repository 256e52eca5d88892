#include "metrics/consistency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"

namespace plenolab {
namespace {

constexpr int kWidth = 48, kHeight = 20;
constexpr float kDisparity = 4;

/// A wall with a smooth pattern in log luminance, seen after the camera moved by `motion`.
SceneImage wall(double motion) {
  SceneImage image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double place = x + static_cast<double>(kDisparity) * motion;
      const auto v = static_cast<float>(std::pow(10.0, 0.4 * std::sin(0.2 * place) + 0.02 * y));
      image.at(x, y) = {v, v, v};
    }
  return image;
}

/// One curve for all views: luma = 0.4 + 0.2·log10 L, plus an offset.
DisplayImage mapped(const SceneImage& hdr, float offset = 0) {
  DisplayImage image(hdr.width(), hdr.height());
  for (std::size_t n = 0; n < image.size(); ++n) {
    const float luma = 0.4f + 0.2f * std::log10(luminance(hdr.pixels()[n])) + offset;
    image.pixels()[n] = {luma, luma, luma};
  }
  return image;
}

const DisparityMap& flat() {
  static const DisparityMap map(kWidth, kHeight, kDisparity);
  return map;
}

TEST(LineChange, OneCurveForBothViewsLeavesNothingButSampling) {
  const SceneImage a = wall(0), b = wall(0.37);
  const DisplayImage mapped_a = mapped(a), mapped_b = mapped(b);
  const LineChange change = change_along_lines({mapped_a, a, flat()}, {mapped_b, b, flat()}, {0.37, 0});
  EXPECT_GT(change.share, 0.9);
  EXPECT_LT(change.rms, 5e-4);  // bilinear: |second derivative| / 8 of 0.2·0.4·sin(0.2 x)
  EXPECT_LT(std::abs(change.mean), 5e-4);
}

TEST(LineChange, ABrighterSecondMappingIsFoundWithItsSignAndSize) {
  const SceneImage a = wall(0), b = wall(0.37);
  const DisplayImage mapped_a = mapped(a), mapped_b = mapped(b, 0.05f);
  const LineChange change = change_along_lines({mapped_a, a, flat()}, {mapped_b, b, flat()}, {0.37, 0});
  EXPECT_NEAR(change.mean, 0.05, 5e-4);
  EXPECT_NEAR(change.rms, 0.05, 5e-4);
}

TEST(LineChange, MotionOfTheWrongSignFindsOtherPointsOfTheWall) {
  const SceneImage a = wall(0), b = wall(2);
  const DisplayImage mapped_a = mapped(a), mapped_b = mapped(b);
  const LineChange right = change_along_lines({mapped_a, a, flat()}, {mapped_b, b, flat()}, {2, 0});
  const LineChange wrong = change_along_lines({mapped_a, a, flat()}, {mapped_b, b, flat()}, {-2, 0});
  EXPECT_GT(right.share, 0.8);
  EXPECT_LT(wrong.share, 0.2);
}

TEST(LineChange, WhatLiesOnAFixedScreenStaysWhereItIs) {
  const SceneImage a = wall(0);
  const DisplayImage image = mapped(a);
  const ViewMotion motion{.x = 1.5, .y = 1, .screen_px = static_cast<double>(kDisparity)};
  const LineChange change = change_along_lines({image, a, flat()}, {image, a, flat()}, motion);
  EXPECT_EQ(change.share, 1);
  EXPECT_EQ(change.rms, 0);
}

TEST(LineChange, PixelsThatTheLightItselfChangesTakeNoPart) {
  const SceneImage a = wall(0);
  SceneImage b = a;
  for (int y = 0; y < kHeight / 2; ++y)
    for (int x = 0; x < kWidth; ++x) b.at(x, y) = b.at(x, y) * 1.5f;
  const DisplayImage mapped_a = mapped(a), mapped_b = mapped(b);
  const LineChange change = change_along_lines({mapped_a, a, flat()}, {mapped_b, b, flat()}, {0, 0});
  EXPECT_EQ(change.pixels, kWidth * kHeight / 2);
  EXPECT_EQ(change.rms, 0);
}

TEST(LineChange, PixelsThatAnotherSurfaceHidesTakeNoPart) {
  const SceneImage a = wall(0);
  DisparityMap nearer = flat();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 10; x < 20; ++x) nearer.at(x, y) = kDisparity + 3;
  const DisplayImage image = mapped(a);
  const LineChange change = change_along_lines({image, a, flat()}, {image, a, nearer}, {0, 0});
  // At a motion of 0 the cell of pixel 9 reaches over to pixel 10.
  EXPECT_EQ(change.pixels, (kWidth - 11) * kHeight);
}

TEST(LineChange, BlackNanAndInfinitePixelsTakeNoPartAndThreadsChangeNothing) {
  SceneImage a = wall(0);
  a.at(5, 5) = {0, 0, 0};
  a.at(6, 5) = {std::nanf(""), 1, 1};
  a.at(7, 5) = {INFINITY, 1, 1};
  const SceneImage plain = wall(0), b = wall(0.2);
  const DisplayImage image = mapped(plain), mapped_b = mapped(b);
  const LineChange one =
      change_along_lines({image, a, flat()}, {mapped_b, b, flat()}, {0.2, 0}, {.threads = 1});
  const LineChange three =
      change_along_lines({image, a, flat()}, {mapped_b, b, flat()}, {0.2, 0}, {.threads = 3});
  const LineChange all = change_along_lines({image, plain, flat()}, {mapped_b, b, flat()}, {0.2, 0});
  EXPECT_EQ(one.pixels, all.pixels - 3);
  EXPECT_TRUE(std::isfinite(one.rms));
  EXPECT_EQ(one.rms, three.rms);
  EXPECT_EQ(one.mean, three.mean);
  const SceneImage black(kWidth, kHeight);
  EXPECT_EQ(change_along_lines({image, black, flat()}, {image, black, flat()}, {0, 0}).pixels, 0);
}

/// The left half contributed by key views 1 and 2, the right half by key view 2 alone.
Plane<std::uint8_t> halves() {
  Plane<std::uint8_t> sets(kWidth, kHeight, 2);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) sets.at(x, y) = 3;
  return sets;
}

TEST(ChangeMap, HoldsTheChangesThatTheMeanIsTakenOf) {
  const SceneImage a = wall(0), b = wall(0.37);
  const DisplayImage mapped_a = mapped(a), mapped_b = mapped(b, 0.05f);
  const ConsistencyView from{mapped_a, a, flat()}, to{mapped_b, b, flat()};
  const LineChange change = change_along_lines(from, to, {0.37, 0});
  double sum = 0;
  std::int64_t pixels = 0;
  const Plane<float> changes = change_map_along_lines(from, to, {0.37, 0});
  for (const float v : changes.pixels())
    if (std::isfinite(v)) sum += static_cast<double>(v), ++pixels;
  EXPECT_EQ(pixels, change.pixels);
  EXPECT_LT(pixels, kWidth * kHeight);
  EXPECT_NEAR(sum / static_cast<double>(pixels), change.mean, 1e-6);
}

TEST(BorderChange, OneCurveAddsNothingAtBorders) {
  const SceneImage hdr = wall(0);
  const DisplayImage image = mapped(hdr);
  const BorderChange change = change_across_borders({image, hdr, flat()}, halves());
  EXPECT_EQ(change.border_pairs, kHeight);
  EXPECT_EQ(change.inside_pairs, (kWidth - 2) * kHeight + kWidth * (kHeight - 1));
  EXPECT_NEAR(change.luma_inside, 0.2 * change.log_inside, 1e-6);
  ASSERT_TRUE(change.excess().has_value());
  EXPECT_NEAR(*change.excess(), 1, 1e-3);
}

TEST(BorderChange, AStepThatOnlyTheMappedViewHasIsExcess) {
  const SceneImage hdr = wall(0.8);  // moved so that the light is steep at the border
  const float left = luminance(hdr.at(kWidth / 2 - 1, 5)), right = luminance(hdr.at(kWidth / 2, 5));
  ASSERT_GT(std::abs(std::log10(right / left)), 0.03);
  const double sign = left > right ? 1 : -1;
  DisplayImage image = mapped(hdr);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) image.at(x, y) = image.at(x, y) + Rgb{0.1f, 0.1f, 0.1f};
  const BorderChange change = change_across_borders({image, hdr, flat()}, halves());
  // The light falls by less than the step at the border, so the step only loses what the light falls.
  EXPECT_NEAR(change.luma_border, 0.1 + sign * 0.2 * change.log_border, 1e-6);
  EXPECT_NEAR(*change.excess(), change.luma_border / (0.2 * change.log_border), 1e-3 * *change.excess());
}

TEST(BorderChange, DepthEdgesAndPixelsWithoutKeyViewsTakeNoPart) {
  const SceneImage hdr = wall(0);
  const DisplayImage image = mapped(hdr);
  DisparityMap stepped = flat();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) stepped.at(x, y) = kDisparity + 1;
  const BorderChange change = change_across_borders({image, hdr, stepped}, halves());
  EXPECT_EQ(change.border_pairs, 0);
  EXPECT_FALSE(change.excess().has_value());
  const Plane<std::uint8_t> nobody(kWidth, kHeight);
  EXPECT_EQ(change_across_borders({image, hdr, flat()}, nobody).inside_pairs, 0);
}

TEST(LumaTrack, StepsAndAgreementAreThoseOfTheFrames) {
  LumaTrack track;
  for (const float level : {1.f, 10.f, 100.f, 10.f}) {
    const SceneImage hdr(4, 4, Rgb{level, level, level});
    append_frame(track, mapped(hdr), hdr);
  }
  EXPECT_NEAR(track.mean_luma[1], 0.6, 1e-6);
  EXPECT_NEAR(track.mean_log_luminance[2], 2, 1e-6);
  EXPECT_NEAR(track.largest_luma_step(), 0.2, 1e-6);
  EXPECT_NEAR(track.largest_log_step(), 1, 1e-6);
  EXPECT_NEAR(track.agreement().value(), 1, 1e-12);
  track.mean_luma = {0.5, 0.4, 0.3, 0.4};
  EXPECT_NEAR(track.agreement().value(), -1, 1e-12);
  track.mean_luma = {0.5, 0.5 + 1e-9, 0.5, 0.5 - 1e-9};
  EXPECT_FALSE(track.agreement().has_value());
  const SceneImage black(4, 4);
  append_frame(track, DisplayImage(4, 4), black);
  EXPECT_EQ(track.mean_log_luminance.size(), 4u) << "black has no log luminance";
}

TEST(Consistency, DifferentSizesAndOptionsOutOfRangeAreErrors) {
  const SceneImage hdr = wall(0), small(4, 4, Rgb{1, 1, 1});
  const DisplayImage image = mapped(hdr), small_image = mapped(small);
  const DisparityMap small_map(4, 4, 1);
  EXPECT_THROW(change_along_lines({image, hdr, small_map}, {image, hdr, flat()}, {}), InputError);
  EXPECT_THROW(change_along_lines({image, hdr, flat()}, {small_image, small, small_map}, {}), InputError);
  EXPECT_THROW(change_across_borders({image, hdr, flat()}, Plane<std::uint8_t>(4, 4)), InputError);
  EXPECT_THROW(change_along_lines({image, hdr, flat()}, {image, hdr, flat()}, {}, {.same_surface_px = 0}),
               InputError);
  EXPECT_THROW(change_across_borders({image, hdr, flat()}, halves(), {.same_light_log10 = -1}), InputError);
}

}  // namespace
}  // namespace plenolab
