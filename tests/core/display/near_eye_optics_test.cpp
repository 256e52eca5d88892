#include "core/display/near_eye_optics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Hansen & Klein 2016, section 3.1.
TEST(NearEyeOptics, GivesTheNumbersPrintedInTheThesis) {
  const NearEyeDisplay display;
  EXPECT_NEAR(lens_separation_mm(display), 3.2888, 5e-5);
  EXPECT_NEAR(magnification(display), 293.42, 0.005);
  EXPECT_NEAR(lens_field_of_view_deg(1, 3.29), 17.28, 0.005);
  EXPECT_NEAR(total_field_of_view_deg(display, 15), 24.2, 0.05);
  EXPECT_NEAR(total_field_of_view_deg(display, 8), 13.0, 0.05);
  EXPECT_NEAR(depth_of_field(display).near_mm, 248, 0.5);
  EXPECT_EQ(depth_of_field(display).far_mm, kInf) << "the pixel grows faster than the optical circle";
}

TEST(NearEyeOptics, GivesTheResolutionThatTheThesisTruncates) {
  const NearEyeDisplay display;
  EXPECT_NEAR(spatial_resolution_px(display, total_field_of_view_deg(display, 15)), 121.72, 0.01);
  EXPECT_NEAR(spatial_resolution_px(display, total_field_of_view_deg(display, 8)), 64.92, 0.01);
}

TEST(NearEyeOptics, ShowsThatTheMeasuredFieldOfViewNeedsAnotherSeparation) {
  EXPECT_NEAR(separation_for_field_of_view_mm(1, 19.86), 2.856, 5e-4);
  EXPECT_NEAR(lens_field_of_view_deg(1, separation_for_field_of_view_mm(1, 19.86)), 19.86, 1e-12);
}

TEST(NearEyeOptics, FulfilsTheThinLensEquationAtEveryImageDistance) {
  for (const double d0 : {40.0, 100.0, 1000.0, 1e6}) {
    const NearEyeDisplay display{.image_distance_mm = d0};
    const double d_l = lens_separation_mm(display);
    EXPECT_NEAR(1 / display.focal_length_mm, 1 / d_l - 1 / (d0 - display.eye_relief_mm), 1e-12);
    EXPECT_NEAR(magnification(display), (d0 - display.eye_relief_mm) / d_l, 1e-6 * magnification(display));
  }
  EXPECT_DOUBLE_EQ(lens_separation_mm({.image_distance_mm = kInf}), 3.3);
}

TEST(NearEyeOptics, HasNoOpticalCircleAtTheVirtualImage) {
  const NearEyeDisplay display;
  EXPECT_EQ(circle_of_confusion(display, 1000).optical_mm, 0);
  EXPECT_NEAR(circle_of_confusion(display, 1000).diameter_mm(),
              display.pixel_pitch_mm * magnification(display), 1e-9);
  const double near_mm = depth_of_field(display).near_mm;
  const CircleOfConfusion at_limit = circle_of_confusion(display, near_mm);
  EXPECT_NEAR(at_limit.optical_mm, at_limit.pixel_mm, 1e-12);
  EXPECT_GT(circle_of_confusion(display, 0.9 * near_mm).optical_mm,
            circle_of_confusion(display, 0.9 * near_mm).pixel_mm);
}

TEST(NearEyeOptics, ShowsDepthsAsTheyAreOnlyIfTheDisplayAgreesWithItsLenses) {
  const NearEyeDisplay consistent = consistent_with_thin_lenses({});
  for (const double depth : {120.0, 1000.0, 6000.0})
    EXPECT_NEAR(apparent_depth_mm(consistent, depth), depth, 1e-6 * depth);
  EXPECT_EQ(apparent_depth_mm(consistent, kInf), kInf);
  // The printed numbers: slope per mm = 0.964/(2 tan 9.93°)/d_l/Z + (1 − 0.964)/d_l.
  const double d_l = lens_separation_mm({});
  const double expected =
      1 / (0.964 / (2 * std::tan(9.93 * std::numbers::pi / 180)) / d_l / 965 + 0.036 / d_l);
  EXPECT_NEAR(apparent_depth_mm({}, 965), expected, 1e-6);
}

TEST(NearEyeOptics, SaysWhatIsWrongWithADisplay) {
  const auto message = [](NearEyeDisplay display) { return message_of([&] { display.validate(); }); };
  EXPECT_NO_THROW(NearEyeDisplay{}.validate());
  EXPECT_NE(message({.focal_length_mm = 0}).find("focal length"), std::string::npos);
  EXPECT_NE(message({.image_distance_mm = 20}).find("beyond the lenses"), std::string::npos);
  EXPECT_NE(message({.columns = 40}).find("do not fit"), std::string::npos);
  EXPECT_NE(message({.rendered_fov_deg = 180}).find("field of view"), std::string::npos);
  EXPECT_NE(message({.pixel_pitch_mm = std::nan("")}).find("pixel pitch"), std::string::npos);
}

}  // namespace
}  // namespace plenolab
