#include "analysis/calibration/coverage.h"

#include <gtest/gtest.h>

#include "analysis/calibration/setups.h"
#include "core/base/error.h"

namespace plenolab {
namespace {

// Of 400 rigs 95 ± 2.2 % hold the truth in 19 of 20 runs; four deviations of that are allowed.
constexpr int kRigs = 400;
constexpr double kLow = 0.905, kHigh = 0.99;

void expect_coverage(const CalibrationRig& rig, const CalibrationFitOptions& fit) {
  CoverageOptions options{.rigs = kRigs};
  options.fit = fit;
  options.fit.starts = 1;
  const CoverageResult result = measure_coverage(rig, options);
  EXPECT_EQ(result.converged, kRigs);
  for (const ParameterCoverage& c : result.parameters) {
    EXPECT_EQ(c.fits, kRigs) << traits_of(c.parameter).name;
    const double share = static_cast<double>(c.covered) / c.fits;
    EXPECT_GT(share, kLow) << traits_of(c.parameter).name;
    EXPECT_LT(share, kHigh) << traits_of(c.parameter).name;
    EXPECT_NEAR(c.mean_sd / c.rms_error, 1, 0.15) << traits_of(c.parameter).name;
  }
}

TEST(CalibrationCoverageTest, IntervalsOfLeastSquaresHoldTheTruthAsOftenAsTheySay) {
  expect_coverage(full_rig(), {.loss = CalibrationLoss::kNone});
}

TEST(CalibrationCoverageTest, SoDoThoseOfTheRobustLosses) {
  expect_coverage(full_rig(), {.loss = CalibrationLoss::kHuber});
  expect_coverage(anchored_rig(), {.loss = CalibrationLoss::kCauchy});
}

TEST(CalibrationCoverageTest, IsTheSameForAnyNumberOfThreads) {
  CoverageOptions one{.rigs = 40, .threads = 1}, two{.rigs = 40, .threads = 2};
  const CoverageResult a = measure_coverage(anchored_rig(), one), b = measure_coverage(anchored_rig(), two);
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    EXPECT_EQ(a.parameters[i].covered, b.parameters[i].covered);
    EXPECT_EQ(a.parameters[i].rms_error, b.parameters[i].rms_error);
  }
}

TEST(CalibrationCoverageTest, CountsNoFitForWhatIsNotDetermined) {
  for (const ParameterCoverage& c : measure_coverage(unanchored_rig(), {.rigs = 5}).parameters)
    EXPECT_EQ(c.fits, 0) << traits_of(c.parameter).name;
}

TEST(CalibrationCoverageTest, NeedsARig) {
  EXPECT_THROW(measure_coverage(full_rig(), {.rigs = 0}), InputError);
}

}  // namespace
}  // namespace plenolab
