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
  const DoubtedSource* angle = find(doubts, "field-of-view");
  ASSERT_NE(angle, nullptr);
  EXPECT_FALSE(contradicts(angle->fit));
  EXPECT_NEAR(angle->fit.uncertainty.derived[0].value, 17.28, 0.05);
  // Without the focus d_l is free to follow the angle: 2.856 mm.
  const DoubtedSource* focus = find(doubts, "focus");
  ASSERT_NE(focus, nullptr);
  EXPECT_NEAR(focus->fit.values[index_of(CalibrationParameter::kLensDistance)], 2.856, 0.01);
  ASSERT_EQ(focus->left_out.size(), 1u);
  EXPECT_GT(focus->left_out[0].predicted, 40) << "the panel would have to be seen at 2 cm";
  // Without the anchor of the pixel pitch the subimage grows: 1.152 mm, at 12 µm nominal 13.8 µm.
  const DoubtedSource* pitch = find(doubts, "anchor of p");
  ASSERT_NE(pitch, nullptr);
  EXPECT_NEAR(pitch->fit.values[0] * m.instrument.subimage_px, 1.152, 0.005);
}

TEST(CalibrationConflictTest,
     WithAppendixDAsWellNoSingleSourceReconcilesTheThesisAndPairsLeaveNothingToTest) {
  const CalibrationMeasurements m = thesis_measurements();
  EXPECT_EQ(m.records.size(), 3u) << "an angle, a focus, a scale: one reading for each printed number";
  const auto doubts = doubt_each_source(m);
  EXPECT_EQ(doubts.front().fit.degrees_of_freedom, 2);
  for (const DoubtedSource& doubt : doubts) {
    EXPECT_TRUE(contradicts(doubt.fit)) << doubt.source;
    EXPECT_EQ(doubt.source.find(" + "), std::string::npos) << doubt.source;
  }
}

TEST(CalibrationConflictTest, WithoutDegreesOfFreedomNothingAgreesAndNothingIsContradicted) {
  CalibrationMeasurements m;
  m.parameters[index_of(CalibrationParameter::kLensDistance)].role = ParameterSetting::Role::kFree;
  m.records.emplace_back(FieldOfViewRecord{19.86, 0.2});
  const CalibrationFit fit = fit_calibration(m);
  EXPECT_EQ(fit.degrees_of_freedom, 0);
  EXPECT_FALSE(fit.p_value.has_value());
  EXPECT_FALSE(contradicts(fit));
}

TEST(CalibrationConflictTest, AFixedValueIsDoubtedWhereTheReadingsDetermineTheParameterInstead) {
  using P = CalibrationParameter;
  CalibrationMeasurements m = exact_measurements(full_rig());
  m.parameters[index_of(P::kOffsetX)].role = ParameterSetting::Role::kFixed;
  m.parameters[index_of(P::kOffsetX)].nominal = 0.3;  // 0.03 in truth: a slip of the pen
  const auto doubts = doubt_each_source(m, {.starts = 2});
  ASSERT_TRUE(contradicts(doubts.front().fit));
  const DoubtedSource* offset = find(doubts, "fixed value of offset x");
  ASSERT_NE(offset, nullptr);
  EXPECT_FALSE(contradicts(offset->fit));
  ASSERT_EQ(offset->left_out.size(), 1u);
  EXPECT_EQ(offset->left_out[0].what, "offset_x_mm");
  EXPECT_NEAR(offset->left_out[0].measured, 0.3, 1e-12);
  EXPECT_NEAR(offset->left_out[0].predicted, 0.03, 1e-4);
  // The thesis' figures say nothing about offsets: doubting them would not be told by any reading.
  EXPECT_EQ(find(doubt_each_source(thesis_measurements()), "fixed value of offset x"), nullptr);
}

TEST(CalibrationConflictTest, AFewOutliersAreNoContradictionOfSources) {
  CalibrationMeasurements m = exact_measurements(anchored_rig());
  std::get<EdgeRecord>(m.records[2]).displacement_mm += 4;
  const CalibrationFit fit = fit_calibration(m);
  EXPECT_TRUE(contradicts(fit));
  EXPECT_TRUE(isolated_outliers(fit));
  EXPECT_FALSE(isolated_outliers(fit_calibration(thesis_measurements())));
}

TEST(CalibrationConflictTest, SoundReadingsDoNotContradictEachOther) {
  int contradictions = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    contradictions += contradicts(fit_calibration(simulate_measurements(full_rig(), seed), {.starts = 1}));
  EXPECT_LE(contradictions, 2);
}

TEST(CalibrationConflictTest, WhatTheRestDoesNotDetermineIsNotPredicted) {
  const auto doubts = doubt_each_source(simulate_measurements(anchored_rig(), 1));
  const DoubtedSource* pitch = find(doubts, "anchor of p");
  ASSERT_NE(pitch, nullptr);
  EXPECT_TRUE(pitch->left_out.empty());
}

}  // namespace
}  // namespace plenolab
