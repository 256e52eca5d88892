#include "analysis/calibration/model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/calibration/setups.h"

namespace plenolab {
namespace {

const CalibrationInstrument kInstrument;

TEST(CalibrationModelTest, NominalLengthsAreThoseOfSection31) {
  const ParameterValues v = nominal_values();
  EXPECT_NEAR(v[index_of(CalibrationParameter::kLensDistance)], 3.2888, 5e-5);
  const auto g = geometry_of(v);
  EXPECT_NEAR(1 / g.vergence_per_mm, 965, 1e-6);
  EXPECT_NEAR(field_of_view_rad(g, kInstrument) * 180 / std::numbers::pi, 17.28, 0.02);
}

TEST(CalibrationModelTest, ATargetOnTheLineOfSightStaysWhereItIsAtEveryDepthIfTheFieldsOfViewAgree) {
  const CalibrationRig rig = target_rig(19.86);
  const auto g = geometry_of(rig.truth);
  for (const CalibrationRecord& record : rig.plan.records)
    EXPECT_NEAR(predict(record, g, rig.plan.instrument)[0], 0, 1e-9);
}

TEST(CalibrationModelTest, AndMovesWithDepthIfTheyDoNot) {
  const CalibrationRig rig = target_rig(17.28);
  const auto g = geometry_of(rig.truth);
  TargetRecord r{200, 6, 6, 300, 0, 0.05};
  const double near = predict(CalibrationRecord(r), g, rig.plan.instrument)[0];
  r.virtual_depth_mm = 2000;
  const double far = predict(CalibrationRecord(r), g, rig.plan.instrument)[0];
  EXPECT_LT(near, -1);  // a narrower display shows it nearer to the axis
  EXPECT_LT(far, near);
}

TEST(CalibrationModelTest, TargetsAppearWhereTheirRaysThroughTwoLensesMeet) {
  // By hand: the target at (X, Z) is drawn in subimage i at its place seen from the virtual camera i; the
  // chief rays of lenses 0 and 1 meet at (X', D).
  ParameterValues v = nominal_values();
  v[index_of(CalibrationParameter::kLensPitch)] = 1.01;
  const auto g = geometry_of(v);
  const double z = 300, tan_half = std::tan(radians(19.86) / 2), x = z * std::tan(radians(5));
  const double subimage = subimage_width(g, kInstrument);
  const auto slope = [&](int i) {
    const double drawn = subimage * i + subimage * (x - i) / z / (2 * tan_half);
    return (drawn - 1.01 * i) / g.lens_distance;
  };
  const double depth = 1.01 / (slope(0) - slope(1)), lateral = depth * slope(0);
  EXPECT_NEAR(light_field_vergence(g, kInstrument, subimage, z), 1 / depth, 1e-12);
  const TargetRecord r{z, 5, 4, 250, 0, 0.05};
  const double camera = -250 * std::tan(radians(4));
  const double crossing = camera + (lateral - camera) * 250 / (250 + depth);
  EXPECT_NEAR(predict(CalibrationRecord(r), g, kInstrument)[0], crossing, 1e-9);
}

TEST(CalibrationModelTest, SharpnessPeaksWhereTheLightFieldConvergesInTheFocus) {
  const auto g = geometry_of(nominal_values());
  const double scale = sharpest_scale(g, kInstrument, 500);
  const double subimage = subimage_width(g, kInstrument) / scale;
  EXPECT_NEAR(light_field_vergence(g, kInstrument, subimage, 500), g.vergence_per_mm, 1e-12);
  EXPECT_NEAR(predict(CalibrationRecord(SharpnessRecord{scale, 500, 0, 1}), g, kInstrument)[0], 1, 1e-12);
  EXPECT_NEAR(predict(CalibrationRecord(SharpnessRecord{scale + 0.01, 500, 0, 1}), g, kInstrument)[0], 0.5,
              1e-9);
}

TEST(CalibrationModelTest, TheFocalGapHasNoCancellation) {
  DisplayGeometry<double> g = geometry_of(nominal_values());
  g.vergence_per_mm = 1e-15;
  EXPECT_NEAR(g.focal_gap() / (1e-15 * g.lens_distance * g.lens_distance), 1, 1e-12);
}

TEST(CalibrationModelTest, AGridTurnedByARightAngleSwapsItsAxes) {
  ParameterValues v = nominal_values();
  v[index_of(CalibrationParameter::kRotation)] = 90;
  const auto reading = predict(CalibrationRecord(GridRecord{3, 0, 0, 0, 1}), geometry_of(v), kInstrument);
  EXPECT_NEAR(reading[0], 0, 1e-9);
  EXPECT_NEAR(reading[1], 250, 1e-9);
}

}  // namespace
}  // namespace plenolab
