#include "analysis/calibration/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/calibration/coordinates.h"
#include "analysis/calibration/record_fields.h"
#include "analysis/calibration/setups.h"
#include "core/base/error.h"

namespace plenolab {
namespace {

using P = CalibrationParameter;

const CalibrationEstimate& estimate(const CalibrationFit& fit, P parameter) {
  return fit.uncertainty.parameters[index_of(parameter)];
}

const CalibrationEstimate& derived(const CalibrationFit& fit, const std::string& name) {
  for (const CalibrationEstimate& e : fit.uncertainty.derived)
    if (e.name == name) return e;
  throw std::logic_error("no derived quantity " + name);
}

TEST(CalibrationFitTest, ReadingsWithoutNoiseGiveTheTruthBack) {
  const CalibrationRig rig = full_rig();
  const CalibrationFit fit = fit_calibration(exact_measurements(rig));
  ASSERT_TRUE(fit.converged) << fit.message;
  for (std::size_t i = 0; i < fit.values.size(); ++i)
    EXPECT_NEAR(fit.values[i], rig.truth[i], 1e-6 * (1 + std::abs(rig.truth[i]))) << traits_of(i).name;
  EXPECT_GE(fit.starts_agreeing, fit.starts / 2);  // some find no peak of sharpness
  EXPECT_LT(fit.chi2, 1e-9);
}

TEST(CalibrationFitTest, NoisyReadingsGiveTheTruthWithinFourDeviations) {
  const CalibrationRig rig = full_rig();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const CalibrationFit fit = fit_calibration(simulate_measurements(rig, seed));
    ASSERT_TRUE(fit.converged) << fit.message;
    for (const CalibrationEstimate& e : fit.uncertainty.parameters) {
      ASSERT_TRUE(e.determined()) << e.name;
      EXPECT_NEAR(e.value, rig.truth[index_of(*parameter_named(e.name))], 4 * *e.sd + 1e-12) << e.name;
    }
    EXPECT_GT(fit.p_value, 1e-4);
  }
}

TEST(CalibrationFitTest, DerivativesEqualCentralDifferences) {
  const CalibrationMeasurements m = exact_measurements(full_rig());
  const CalibrationCoordinates coordinates(m);
  ParameterValues x = coordinates.nominal();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.01 * static_cast<double>(i + 1);
  const Eigen::MatrixXd jacobian = whitened_jacobian(m, x);
  const auto residuals = residuals_of(m);
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < x.size(); ++i) {
    ParameterValues above = x, below = x;
    above[i] += kStep, below[i] -= kStep;
    const auto high = coordinates.geometry(above.data()), low = coordinates.geometry(below.data());
    for (std::size_t r = 0; r < residuals.size(); ++r) {
      const double difference = (prediction_of(residuals[r], m, high) - prediction_of(residuals[r], m, low)) /
                                (2 * kStep) / deviation_of(residuals[r], m);
      const double exact = jacobian(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(i));
      EXPECT_NEAR(exact, difference, 1e-5 * (1 + std::abs(exact))) << "reading " << r << ", parameter " << i;
    }
  }
}

TEST(CalibrationFitTest, WithAllLengthsFreeTheRankIsThreeOfFourAndNoLengthIsGiven) {
  const CalibrationFit fit = fit_calibration(simulate_measurements(unanchored_rig(), 1));
  EXPECT_EQ(fit.uncertainty.unknowns, 4);
  EXPECT_EQ(fit.uncertainty.rank, 3);
  EXPECT_FALSE(fit.uncertainty.condition_number.has_value());
  for (const P p : {P::kPixelPitch, P::kLensPitch, P::kLensDistance, P::kFocalLength})
    EXPECT_FALSE(estimate(fit, p).determined()) << traits_of(p).name;
  // Field of view gives w/d_l, the grid w_l/p, focus 1/d_l − 1/f.
  for (const char* name : {"fov_deg", "lens_pitch_px", "lens_pitch_over_d_l", "vergence_dpt"})
    EXPECT_TRUE(derived(fit, name).determined()) << name;
  ASSERT_EQ(fit.uncertainty.open.size(), 1u);
  EXPECT_TRUE(fit.uncertainty.open[0].exact);
  const ParameterValues& change = fit.uncertainty.open[0].change;
  EXPECT_NEAR(change[index_of(P::kPixelPitch)], change[index_of(P::kLensPitch)], 1e-9);
  EXPECT_NEAR(change[index_of(P::kPixelPitch)], change[index_of(P::kLensDistance)], 1e-9);
  EXPECT_NE(fit.uncertainty.open[0].sentence.find("cannot be told apart"), std::string::npos);
}

TEST(CalibrationFitTest, MovingAlongAnOpenDirectionLeavesEveryPredictionAsItIs) {
  const CalibrationMeasurements m = exact_measurements(unanchored_rig());
  const CalibrationFit fit = fit_calibration(m);
  // A finite move along the gauge: all of p, w_l, d_l times s, with 1/d_l − 1/f kept.
  DisplayGeometry<double> moved = fit.geometry;
  for (double* length : {&moved.pixel_pitch, &moved.lens_pitch, &moved.lens_distance}) *length *= 1.3;
  for (const CalibrationRecord& record : m.records) {
    const auto before = predict(record, fit.geometry, m.instrument);
    const auto after = predict(record, moved, m.instrument);
    for (std::size_t c = 0; c < before.size(); ++c)
      EXPECT_NEAR(before[c], after[c], 1e-9 * (1 + std::abs(before[c])));
  }
}

TEST(CalibrationFitTest, AnAnchoredPixelPitchDeterminesEveryLengthToSomeMicrometres) {
  const CalibrationFit fit = fit_calibration(simulate_measurements(anchored_rig(), 1));
  EXPECT_EQ(fit.uncertainty.rank, 4);
  ASSERT_TRUE(estimate(fit, P::kLensDistance).determined());
  ASSERT_TRUE(estimate(fit, P::kFocalLength).determined());
  // Eight readings of d_l ∝ p/displacement; f adds the error of the vergence, f²·sd(V).
  EXPECT_NEAR(*estimate(fit, P::kLensDistance).sd * 1000, 7.5, 2.5);
  EXPECT_GT(*estimate(fit, P::kFocalLength).sd, *estimate(fit, P::kLensDistance).sd);
  const auto correlation = fit.uncertainty.correlation[index_of(P::kLensDistance)][index_of(P::kFocalLength)];
  ASSERT_TRUE(correlation.has_value());
  EXPECT_NEAR(*correlation, 0.987, 0.01);
}

TEST(CalibrationFitTest, DeviationsEqualThoseOfLinearPropagationDoneByHand) {
  // One anchored p and field-of-view readings alone: d_l = n·p/(2 tan(α/2)), so that
  // sd(d_l)²/d_l² = sd(p)²/p² + (sd(α)/sin α)²/n.
  CalibrationMeasurements m;
  m.parameters[index_of(P::kPixelPitch)].role = ParameterSetting::Role::kAnchored;
  m.parameters[index_of(P::kPixelPitch)].sd = 1.2e-5;
  m.parameters[index_of(P::kLensDistance)].role = ParameterSetting::Role::kFree;
  for (int i = 0; i < 4; ++i) m.records.emplace_back(FieldOfViewRecord{19.86, 0.1});
  const CalibrationFit fit = fit_calibration(m, {.loss = CalibrationLoss::kNone});
  const double d_l = 1 / (2 * std::tan(radians(9.93)));
  EXPECT_NEAR(estimate(fit, P::kLensDistance).value, d_l, 1e-8);
  const double relative = std::hypot(1e-3, radians(0.1) / std::sin(radians(19.86)) / 2);
  EXPECT_NEAR(*estimate(fit, P::kLensDistance).sd, d_l * relative, 1e-6 * d_l);
}

TEST(CalibrationFitTest, TheThesisAngleNeedsItsPrintedDistance) {
  CalibrationMeasurements m;
  m.parameters[index_of(P::kLensDistance)].role = ParameterSetting::Role::kFree;
  m.records.emplace_back(FieldOfViewRecord{19.86, 0.1});
  EXPECT_NEAR(fit_calibration(m).values[index_of(P::kLensDistance)], 2.856, 5e-4);
  CalibrationMeasurements nominal = m;
  EXPECT_NEAR(predict(m.records[0], geometry_of(nominal_values()), m.instrument)[0], 17.28, 0.02);
}

TEST(CalibrationFitTest, NumbersAboutZeroAreJudgedAgainstAUsefulSize) {
  const auto fit_with_focus = [](double sd_dpt) {
    CalibrationMeasurements m = exact_measurements(anchored_rig());
    for (CalibrationRecord& record : m.records)
      if (auto* focus = std::get_if<FocusRecord>(&record)) focus->sd_dpt = sd_dpt;
    return fit_calibration(m, {.loss = CalibrationLoss::kNone, .starts = 1});
  };
  // Three readings: 0.4/√3 is 0.23 dpt, within a quarter of a dioptre; 3/√3 is not, although it is little
  // against 1/f = 303 dpt.
  const CalibrationFit sharp = fit_with_focus(0.4), blurred = fit_with_focus(3);
  for (const char* name : {"vergence_dpt", "focal_gap_mm"}) {
    EXPECT_TRUE(derived(sharp, name).determined()) << name;
    EXPECT_FALSE(derived(blurred, name).determined()) << name;
  }
  EXPECT_NEAR(*derived(sharp, "vergence_dpt").sd, 0.4 / std::sqrt(3.0), 1e-3);
  EXPECT_TRUE(estimate(blurred, P::kFocalLength).determined()) << "f itself is known to 1 %";
}

TEST(CalibrationFitTest, ARotationThatIsKnownToTwoDegreesIsNotKnown) {
  const auto sd_of_rotation = [](double sd_px) {
    CalibrationMeasurements m = exact_measurements(grid_rig());
    for (CalibrationRecord& record : m.records) std::get<GridRecord>(record).sd_px = sd_px;
    return estimate(fit_calibration(m, {.loss = CalibrationLoss::kNone, .starts = 1}), P::kRotation).sd;
  };
  EXPECT_TRUE(sd_of_rotation(20).has_value());
  // Σ(column² + row²) = 348 lens pitches of 83 px: 2° need 54 px.
  EXPECT_FALSE(sd_of_rotation(54).has_value());
}

TEST(CalibrationFitTest, WhatTheDataSeeDoesNotDependOnTheLoss) {
  const CalibrationMeasurements m = exact_measurements(full_rig());
  const ParameterValues x = CalibrationCoordinates(m).nominal();
  const CalibrationUncertainty plain = uncertainty_at(m, x), robust = uncertainty_at(m, x, {0.5, 0.3});
  EXPECT_EQ(plain.rank, robust.rank);
  EXPECT_EQ(plain.condition_number, robust.condition_number);
  EXPECT_EQ(plain.singular_values, robust.singular_values);
  // Of what readings alone determine the deviation is √(mean ψ²)/mean ψ′ times as large.
  const auto sd = [](const CalibrationUncertainty& u, P p) { return *u.parameters[index_of(p)].sd; };
  EXPECT_NEAR(sd(robust, P::kSharpness) / sd(plain, P::kSharpness), std::sqrt(0.3) / 0.5, 1e-9);
}

TEST(CalibrationFitTest, AParameterThatNoRecordSeesIsNamed) {
  CalibrationRig rig = grid_rig();
  rig.plan.parameters[index_of(P::kFocalLength)].role = ParameterSetting::Role::kFree;
  const CalibrationFit fit = fit_calibration(exact_measurements(rig));
  ASSERT_EQ(fit.uncertainty.open.size(), 1u);
  EXPECT_EQ(fit.uncertainty.open[0].sentence, "f is seen by no record and has no anchor.");
  EXPECT_TRUE(estimate(fit, P::kLensPitch).determined());
}

TEST(CalibrationFitTest, TwoOpenDirectionsAreToldSeparately) {
  CalibrationRig rig = grid_rig();
  for (const P p : {P::kFocalLength, P::kPixelPitch})
    rig.plan.parameters[index_of(p)].role = ParameterSetting::Role::kFree;
  const CalibrationFit fit = fit_calibration(exact_measurements(rig));
  EXPECT_EQ(fit.uncertainty.unknowns - fit.uncertainty.rank, 2);
  ASSERT_EQ(fit.uncertainty.open.size(), 2u);
  int mentions_f_alone = 0;
  for (const OpenDirection& open : fit.uncertainty.open)
    mentions_f_alone += open.sentence == "f is seen by no record and has no anchor.";
  EXPECT_EQ(mentions_f_alone, 1);
}

TEST(CalibrationFitTest, MoreUnknownsThanReadingsAreARankDeficiencyNotAnError) {
  CalibrationMeasurements m;
  for (const P p : {P::kPixelPitch, P::kLensPitch, P::kLensDistance, P::kFocalLength, P::kPupilOffset})
    m.parameters[index_of(p)].role = ParameterSetting::Role::kFree;
  m.records.emplace_back(FieldOfViewRecord{19.86, 0.1});
  const CalibrationFit fit = fit_calibration(m);
  EXPECT_EQ(fit.uncertainty.rank, 1);
  EXPECT_EQ(fit.uncertainty.unknowns, 5);
  EXPECT_EQ(fit.uncertainty.open.size(), 4u);
}

TEST(CalibrationFitTest, TenPercentOfOutliersPullLeastSquaresButNotTheRobustLosses) {
  CalibrationRig rig = anchored_rig();
  rig.plan.records.insert(rig.plan.records.end(), rig.plan.records.begin(), rig.plan.records.end());
  rig.outlier_share = 0.1;
  rig.outlier_deviations = 30;
  double plain = 0, huber = 0, cauchy = 0;
  const double truth = rig.truth[index_of(P::kLensDistance)];
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const CalibrationMeasurements m = simulate_measurements(rig, seed);
    const auto error = [&](CalibrationLoss loss) {
      return std::abs(fit_calibration(m, {.loss = loss, .starts = 1}).values[index_of(P::kLensDistance)] -
                      truth);
    };
    plain += error(CalibrationLoss::kNone);
    huber += error(CalibrationLoss::kHuber);
    cauchy += error(CalibrationLoss::kCauchy);
  }
  EXPECT_LT(huber, 0.4 * plain);
  EXPECT_LT(cauchy, 0.3 * plain);
}

TEST(CalibrationFitTest, OutliersAreNamedAndNothingElseIs) {
  CalibrationMeasurements m = exact_measurements(anchored_rig());
  std::get<EdgeRecord>(m.records[2]).displacement_mm += 4;
  const CalibrationFit fit = fit_calibration(m, {.loss = CalibrationLoss::kCauchy});
  for (const FittedReading& reading : fit.readings)
    EXPECT_EQ(reading.outlier, reading.kind == "edge" && reading.record == 2) << reading.what;
  EXPECT_LT(fit.readings[2].weight, 0.1);
}

TEST(CalibrationFitTest, TheFitStaysExactAsTheLensDistanceReachesTheFocalLengthAndPassesIt) {
  for (const double gap_mm : {1e-1, 1e-3, 1e-6, 1e-9, 0.0, -1e-3}) {
    CalibrationRig rig = anchored_rig();
    rig.truth[index_of(P::kLensDistance)] = rig.truth[index_of(P::kFocalLength)] - gap_mm;
    const CalibrationFit fit = fit_calibration(exact_measurements(rig));
    ASSERT_TRUE(fit.converged) << gap_mm;
    EXPECT_NEAR(fit.geometry.focal_gap(), gap_mm, 1e-11 + 1e-9 * std::abs(gap_mm));
    EXPECT_EQ(fit.starts_agreeing, fit.starts) << gap_mm;
  }
}

TEST(CalibrationFitTest, OffsetsOfOneSignMoveBothEdgesTheSameWay) {
  // Gauge of signs: the display shifted to the right is seen from the left, so that the grid and the edges
  // agree on one offset.
  CalibrationRig rig = full_rig();
  std::erase_if(rig.plan.records, [](const CalibrationRecord& r) {
    return std::string(kind_of(r)) == "grid" || std::string(kind_of(r)) == "sharpness";
  });
  for (const P p : {P::kOffsetY, P::kRotation, P::kSharpness, P::kSharpnessWidth, P::kLensPitch}) {
    rig.plan.parameters[index_of(p)].role = ParameterSetting::Role::kFixed;
    rig.plan.parameters[index_of(p)].nominal = rig.truth[index_of(p)];
  }
  const CalibrationFit fit = fit_calibration(exact_measurements(rig));
  EXPECT_NEAR(estimate(fit, P::kOffsetX).value, 0.03, 1e-8);
}

TEST(CalibrationFitTest, ExtremeNumbersEndInFiniteResultsOrWithoutConvergence) {
  const CalibrationMeasurements sound = simulate_measurements(full_rig(), 1);
  int fits = 0;
  const auto fit_with = [&](std::size_t record, std::size_t number, bool high) {
    CalibrationMeasurements m = sound;
    std::size_t at = 0;
    std::visit(
        [&](auto& r) {
          for_each_number(r, [&](const RecordField& field, double& value) {
            if (at++ == number) value = high ? field.high : field.low;
          });
        },
        m.records[record]);
    try {
      m.validate("extreme");
    } catch (const InputError&) {
      return;
    }
    const CalibrationFit fit = fit_calibration(m, {.starts = 1, .max_iterations = 20});
    ++fits;
    if (!fit.converged) return;
    for (const double value : fit.values)
      EXPECT_TRUE(std::isfinite(value)) << record << ", number " << number;
    EXPECT_TRUE(std::isfinite(fit.chi2)) << record << ", number " << number;
  };
  for (std::size_t record = 0; record < sound.records.size(); record += 3)
    for (std::size_t number = 0; number < 6; ++number)
      for (const bool high : {false, true}) fit_with(record, number, high);
  EXPECT_GT(fits, 100);
}

TEST(CalibrationFitTest, OptionsOutOfRangeAreRefused) {
  const CalibrationMeasurements m = exact_measurements(grid_rig());
  EXPECT_THROW(fit_calibration(m, {.loss_scale = -1}), InputError);
  EXPECT_THROW(fit_calibration(m, {.starts = 0}), InputError);
  EXPECT_THROW(fit_calibration(m, {.max_iterations = 0}), InputError);
  EXPECT_THROW(fit_calibration(m, {.outlier_deviations = 0}), InputError);
}

}  // namespace
}  // namespace plenolab
