#include "analysis/epi.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace plenolab {
namespace {

TEST(Epi, StacksTheSameLineOfEveryFrame) {
  std::vector<SceneImage> frames(3, SceneImage(4, 5));
  for (int f = 0; f < 3; ++f) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 4; ++x) {
        frames[static_cast<std::size_t>(f)].at(x, y) = {static_cast<float>(f), static_cast<float>(x),
                                                        static_cast<float>(y)};
      }
    }
  }
  const SceneImage rows = epi(std::span<const SceneImage>(frames), EpiDirection::kRow, 2);
  ASSERT_EQ(rows.width(), 4);
  ASSERT_EQ(rows.height(), 3);
  EXPECT_EQ(rows.at(3, 1), (Rgb{1, 3, 2}));
  const SceneImage columns = epi(std::span<const SceneImage>(frames), EpiDirection::kColumn, 1);
  ASSERT_EQ(columns.width(), 3);
  ASSERT_EQ(columns.height(), 5);
  EXPECT_EQ(columns.at(2, 4), (Rgb{2, 1, 4}));
}

TEST(Epi, RefusesNoFramesDifferentSizesAndLinesOutside) {
  const std::vector<DisplayImage> none, differing{DisplayImage(3, 3), DisplayImage(4, 3)},
      one{DisplayImage(3, 2)};
  EXPECT_THROW(epi(std::span<const DisplayImage>(none), EpiDirection::kRow, 0), InputError);
  EXPECT_THROW(epi(std::span<const DisplayImage>(differing), EpiDirection::kRow, 0), InputError);
  EXPECT_THROW(epi(std::span<const DisplayImage>(one), EpiDirection::kRow, 2), InputError);
  EXPECT_NO_THROW(epi(std::span<const DisplayImage>(one), EpiDirection::kColumn, 2));
  EXPECT_THROW(epi(std::span<const DisplayImage>(one), EpiDirection::kColumn, -1), InputError);
}

TEST(ExpectedEpiSlope, FollowsAPointThroughTheFrames) {
  // Correspondences of views at s and s + 0.1 (the right one later): q = p + (F_p - F_q)·disp.
  constexpr double kDisparity = 30, kStep = 0.1;
  std::vector<DisplayImage> frames(5, DisplayImage(24, 1));
  for (int f = 0; f < 5; ++f)
    frames[static_cast<std::size_t>(f)].at(20 + static_cast<int>(std::lround(-kStep * f * kDisparity)), 0) = {
        1, 1, 1};
  const DisplayImage image = epi(std::span<const DisplayImage>(frames), EpiDirection::kRow, 0);
  const EpiLine line{20.5, 0, expected_epi_slope(kDisparity, kStep), {1, 0, 0}};
  const DisplayImage drawn = draw_epi_lines(image, EpiDirection::kRow, std::span(&line, 1));
  for (const Rgb& c : drawn.pixels()) EXPECT_NE(c, (Rgb{1, 1, 1})) << "a point is left beside the line";
  EXPECT_DOUBLE_EQ(expected_epi_slope(kDisparity, kStep, 2), -6);
}

TEST(EpiLines, PassThroughTheirPointWithTheirSlope) {
  const DisplayImage drawn = draw_epi_lines(DisplayImage(40, 11), EpiDirection::kRow,
                                            std::vector<EpiLine>{{20.5, 5, -2, {1, 0, 0}}});
  for (int frame = 0; frame < 11; ++frame)
    EXPECT_EQ(drawn.at(20 - 2 * (frame - 5), frame), (Rgb{1, 0, 0})) << frame;
  EXPECT_EQ(drawn.at(0, 0), Rgb{});
  const DisplayImage vertical = draw_epi_lines(DisplayImage(11, 40), EpiDirection::kColumn,
                                               std::vector<EpiLine>{{20.5, 5, 1, {1, 0, 0}}});
  for (int frame = 0; frame < 11; ++frame) EXPECT_EQ(vertical.at(frame, 15 + frame), (Rgb{1, 0, 0})) << frame;
}

TEST(StretchedEpi, RepeatsFramesOnly) {
  DisplayImage image(2, 2);
  image.at(0, 1) = {1, 1, 1};
  const DisplayImage rows = stretch_epi(image, EpiDirection::kRow, 3);
  EXPECT_EQ(rows.width(), 2);
  EXPECT_EQ(rows.height(), 6);
  EXPECT_EQ(rows.at(0, 3), (Rgb{1, 1, 1}));
  EXPECT_EQ(rows.at(0, 2), Rgb{});
  EXPECT_EQ(stretch_epi(image, EpiDirection::kColumn, 3).width(), 6);
  EXPECT_THROW(stretch_epi(image, EpiDirection::kRow, 0), InputError);
}

}  // namespace
}  // namespace plenolab
