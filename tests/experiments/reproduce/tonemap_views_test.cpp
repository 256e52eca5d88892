#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/figure_tools.h"
#include "experiments/reproduce/tonemap/adaptation_pace.h"
#include "experiments/reproduce/tonemap/measures.h"
#include "experiments/reproduce/tonemap/view_figure.h"

namespace plenolab {
namespace {

constexpr int kSpacing = 10;
constexpr std::size_t kFrames = 41, kEvent = 20;

/// A change of `amount` spread evenly over `frames` frames up to and including `last`.
std::vector<double> ramp(double amount, std::size_t frames, std::size_t last) {
  std::vector<double> track(kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double done = static_cast<double>(i + frames) - static_cast<double>(last);
    track[i] = amount * std::clamp(done / static_cast<double>(frames), 0.0, 1.0);
  }
  return track;
}

TEST(AdaptationOf, AChangeAtOnceIsAbruptAndLastsOneFrame) {
  const Adaptation adaptation = adaptation_of(ramp(0.1, 1, kEvent), kEvent, kSpacing);
  EXPECT_EQ(adaptation.pace, Pace::kAbrupt);
  EXPECT_EQ(adaptation.steepest, kEvent);
  EXPECT_NEAR(adaptation.duration_frames, 1, 1e-9);
  EXPECT_NEAR(adaptation.share_before.value(), 0, 1e-9);
}

TEST(AdaptationOf, AnEvenChangeOverOneSpacingIsGradual) {
  const Adaptation adaptation = adaptation_of(ramp(-0.1, kSpacing, kEvent + 4), kEvent, kSpacing);
  EXPECT_EQ(adaptation.pace, Pace::kGradual);
  EXPECT_NEAR(adaptation.range, 0.1, 1e-9);
  EXPECT_NEAR(adaptation.duration_frames, kSpacing, 1e-6);
  EXPECT_NEAR(adaptation.share_before.value(), 0.5, 1e-6);
}

TEST(AdaptationOf, AChangeBelowOneDisplayStepIsSteadyHoweverFast) {
  EXPECT_EQ(adaptation_of(ramp(0.9 * kSmallestStep, 1, kEvent), kEvent, kSpacing).pace, Pace::kSteady);
  EXPECT_EQ(adaptation_of(ramp(1.1 * kSmallestStep, 1, kEvent), kEvent, kSpacing).pace, Pace::kAbrupt);
}

TEST(AdaptationOf, AChangeTooSlowToSeeFromFrameToFrameIsGradual) {
  const Adaptation adaptation = adaptation_of(ramp(1.5 * kSmallestStep, 3, kEvent), kEvent, kSpacing);
  EXPECT_NEAR(adaptation.duration_frames, 3, 1e-6);
  EXPECT_EQ(adaptation.pace, Pace::kGradual);
}

TEST(AdaptationOf, AChangeAheadOfTheEventCountsAsBeforeIt) {
  EXPECT_NEAR(adaptation_of(ramp(0.1, 5, kEvent - 1), kEvent, kSpacing).share_before.value(), 1, 1e-9);
}

TEST(AdaptationOf, AnEventAtTheFirstStepHasNothingBeforeIt) {
  EXPECT_FALSE(adaptation_of(ramp(0.1, 5, kEvent), 1, kSpacing).share_before.has_value());
  EXPECT_EQ(adaptation_of(std::vector<double>(3), 1, kSpacing).pace, Pace::kSteady);
}

/// One surface; the left half is seen by one key view, the right by another.
ReferenceFrame halves(int size) {
  ReferenceFrame frame{{}, SceneImage(size, size), DisparityMap(size, size), Plane<std::uint8_t>(size, size)};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) frame.contributors.at(x, y) = x < size / 2 ? 1 : 2;
  return frame;
}

TEST(BorderStepWeights, AreTheSquaredStepsAtTheBorderAlone) {
  constexpr int kSize = 12;
  Plane<float> values(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) values.at(x, y) = x < kSize / 2 ? 0.5f : 0.3f;
  const Plane<float> weights = border_step_weights(values, halves(kSize));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const bool border = x == kSize / 2 - 1 && y >= 1 && y + 1 < kSize;
      EXPECT_NEAR(weights.at(x, y), border ? 0.04f : 0.0f, 1e-6f) << x << " " << y;
    }
}

TEST(LargestSteps, AreFoundInTheFrameWhereOneMappingStepsAndTheOtherDoesNot) {
  constexpr int kSize = 40;
  DisplayImage even(kSize, kSize), stepped(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const float texture = 0.3f + 0.01f * static_cast<float>(y % 5);
      even.at(x, y) = {texture, texture, texture};
      stepped.at(x, y) = even.at(x, y) + (x < kSize / 2 ? Rgb{} : Rgb{0.1f, 0.1f, 0.1f});
    }
  const std::vector<ReferenceFrame> frames{halves(kSize), halves(kSize)};
  const StepPlace place = largest_steps(frames, std::vector{even, stepped}, std::vector{even, even});
  EXPECT_EQ(place.index, 1u);
  EXPECT_TRUE(place.box.x <= kSize / 2 - 1 && kSize / 2 - 1 < place.box.x + place.box.width);
  EXPECT_NEAR(place.sum, 0.01 * place.box.height, 1e-4);
}

TEST(RaiseContrast, SpreadsTheRangeOfLuma) {
  DisplayImage image(10, 10);
  for (std::size_t n = 0; n < image.size(); ++n) {
    const float v = n < 50 ? 0.4f : 0.6f;
    image.pixels()[n] = {v, v, v};
  }
  const DisplayImage raised = raise_contrast(image);
  EXPECT_NEAR(raised.pixels().front().r, 0, 1e-5f);
  EXPECT_NEAR(raised.pixels().back().r, 1, 1e-5f);
}

TEST(RaiseContrast, LeavesAnEvenImageAlone) {
  DisplayImage image(4, 4);
  std::fill(image.pixels().begin(), image.pixels().end(), Rgb{0.3f, 0.3f, 0.3f});
  EXPECT_EQ(raise_contrast(image).at(1, 2), (Rgb{0.3f, 0.3f, 0.3f}));
}

TEST(MarkColumn, ChangesThatColumnOnly) {
  const DisplayImage marked = mark_column(DisplayImage(5, 3), 2);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(marked.at(x, y), x == 2 ? kCutMark : Rgb{});
}

}  // namespace
}  // namespace plenolab
