#include "analysis/calibration/conflict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/calibration/setups.h"

namespace plenolab {
namespace {

const DoubtedSource* find(const std::vector<DoubtedSource>& doubts, const std::string& source) {
  const auto found = std::find_if(doubts.begin(), doubts.end(),
                                  [&](const DoubtedSource& doubt) { return doubt.source == source; });
  return found == doubts.end() ? nullptr : &*found;
}

TEST(CalibrationConflictTest, TheFiguresOfTheThesisContradictEachOther) {
  const auto doubts = doubt_each_source(thesis_measurements());
  EXPECT_EQ(doubts.front().source, "nothing");
  EXPECT_TRUE(contradicts(doubts.front().fit));
}

TEST(CalibrationConflictTest, WithoutTheMeasuredAngleTheRestExplainsWhatItShouldHaveBeen) {
  CalibrationMeasurements m = thesis_measurements();
  std::erase_if(m.records,
                [](const CalibrationRecord& r) { return std::string(kind_of(r)) == "sharpest-scale"; });
  const auto doubts = doubt_each_source(m);
  const DoubtedSource* edges = find(doubts, "edge readings");
  ASSERT_NE(edges, nullptr);
  EXPECT_FALSE(contradicts(edges->fit));
  EXPECT_NEAR(edges->fit.uncertainty.derived[0].value, 17.28, 0.05);
  // Without the focus d_l is free to follow the angle: 2.856 mm.
  const DoubtedSource* focus = find(doubts, "focus readings");
  ASSERT_NE(focus, nullptr);
  EXPECT_NEAR(focus->fit.values[index_of(CalibrationParameter::kLensDistance)], 2.856, 0.01);
  ASSERT_TRUE(focus->left_out.has_value());
  EXPECT_GT(focus->left_out->predicted, 40) << "the panel would have to be seen at 2 cm";
  // Without the anchor of the pixel pitch the subimage grows: 1.152 mm, at 12 µm nominal 13.8 µm.
  const DoubtedSource* pitch = find(doubts, "the anchor of p");
  ASSERT_NE(pitch, nullptr);
  EXPECT_NEAR(pitch->fit.values[0] * m.instrument.subimage_px, 1.152, 0.005);
}

TEST(CalibrationConflictTest, SoundReadingsDoNotContradictEachOther) {
  int contradictions = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    contradictions += contradicts(fit_calibration(simulate_measurements(full_rig(), seed), {.starts = 1}));
  EXPECT_LE(contradictions, 2);
}

TEST(CalibrationConflictTest, WhatTheRestDoesNotDetermineIsNotPredicted) {
  const auto doubts = doubt_each_source(simulate_measurements(anchored_rig(), 1));
  const DoubtedSource* pitch = find(doubts, "the anchor of p");
  ASSERT_NE(pitch, nullptr);
  EXPECT_FALSE(pitch->left_out.has_value());
}

}  // namespace
}  // namespace plenolab
