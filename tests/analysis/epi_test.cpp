#include "analysis/epi.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace plenolab {
namespace {

/// Frames of a texture that moves by `slope` pixels per frame along x (or y).
std::vector<DisplayImage> moving_frames(int size, int count, double slope, EpiDirection direction) {
  std::vector<DisplayImage> frames;
  for (int f = 0; f < count; ++f) {
    DisplayImage frame(size, size);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const double p = (direction == EpiDirection::kRow ? x : y) - slope * f;
        const float v = static_cast<float>(0.5 + 0.2 * std::sin(0.35 * p) + 0.2 * std::sin(0.81 * p + 1));
        frame.at(x, y) = {v, v, v};
      }
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

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

TEST(EpiSlopes, FindTheExpectedMotionInBothDirections) {
  for (const EpiDirection direction : {EpiDirection::kRow, EpiDirection::kColumn}) {
    for (const double disparity : {0.0, 3.0, 7.5}) {
      const double expected = expected_epi_slope(disparity, 0.1);
      const std::vector<DisplayImage> frames = moving_frames(64, 40, expected, direction);
      const DisplayImage image = epi(std::span<const DisplayImage>(frames), direction, 10);
      const EpiSlopes slopes = epi_slopes(image, direction);
      const int x = direction == EpiDirection::kRow ? 30 : 20, y = direction == EpiDirection::kRow ? 20 : 30;
      EXPECT_NEAR(slopes.pixels_per_frame.at(x, y), expected, 0.02) << disparity;
      EXPECT_GT(slopes.coherence.at(x, y), 0.95f) << disparity;
    }
  }
}

TEST(EpiSlopes, AreZeroWithoutContrast) {
  const EpiSlopes slopes = epi_slopes(DisplayImage(20, 9, {0.4f, 0.4f, 0.4f}), EpiDirection::kRow);
  for (const float s : slopes.pixels_per_frame.pixels()) EXPECT_EQ(s, 0);
  for (const float c : slopes.coherence.pixels()) EXPECT_EQ(c, 0);
  EXPECT_EQ(epi_slopes(DisplayImage(1, 1), EpiDirection::kColumn).coherence.size(), 1u);
}

TEST(EpiSlopes, RefuseWidthsThatAreNotPositive) {
  EpiSlopeOptions options;
  options.outer_sigma_px = 0;
  EXPECT_THROW(epi_slopes(DisplayImage(4, 4), EpiDirection::kRow, options), InputError);
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
