#include "core/display/retina.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/display/subimages.h"

namespace plenolab {
namespace {

/// What every lens of a consistent display shows of a bright bar of `half_width_mm` at `depth_mm` from the
/// lenses, x = 0, before black.
DisplayImage panel_with_bar(const NearEyeDisplay& display, double depth_mm, double half_width_mm) {
  DisplayImage panel(display.panel_width, display.panel_height);
  const double separation = lens_separation_mm(display);
  for (int x = 0; x < panel.width(); ++x) {
    const double at_mm = (x + 0.5 - panel.width() / 2.0) * display.pixel_pitch_mm;
    const double lens = std::floor(at_mm / display.lens_pitch_mm + display.columns / 2.0);
    if (lens < 0 || lens >= display.columns) continue;
    const double centre = (lens + 0.5 - display.columns / 2.0) * display.lens_pitch_mm;
    const double seen_at = centre + (at_mm - centre) / separation * depth_mm;
    if (std::abs(seen_at) > half_width_mm) continue;
    for (int y = 0; y < panel.height(); ++y) panel.at(x, y) = {1, 1, 1};
  }
  return panel;
}

/// Standard deviation, in degrees, of the light of the middle row over the direction.
double spread_deg(const DisplayImage& retina, double fov_deg) {
  double weight = 0, first = 0, second = 0;
  const int y = retina.height() / 2;
  for (int x = 0; x < retina.width(); ++x) {
    const double slope = std::tan(fov_deg * std::numbers::pi / 360) * (2 * (x + 0.5) / retina.width() - 1);
    const double light = std::pow(static_cast<double>(retina.at(x, y).r), 2.2);
    weight += light, first += light * slope, second += light * slope * slope;
  }
  return std::sqrt(second / weight - first * first / weight / weight) * 180 / std::numbers::pi;
}

constexpr double kFov = 6;

double bar_spread(double depth_from_eye_mm, double focus_mm, double half_angle_deg = 0.25) {
  const NearEyeDisplay display = consistent_with_thin_lenses({});
  const double half_width = depth_from_eye_mm * std::tan(half_angle_deg * std::numbers::pi / 180);
  const DisplayImage panel = panel_with_bar(display, depth_from_eye_mm - display.eye_relief_mm, half_width);
  const Eye eye{.pupil_mm = 4, .focus_mm = focus_mm, .field_of_view_deg = kFov};
  return spread_deg(retinal_image(panel, display, eye, {.width = 400, .pupil_samples = 200}), kFov);
}

TEST(Retina, ShowsAPointOfTheVirtualImageSharplyWhereTheEyeFocusesOnIt) {
  // A bar of ±0.25° has a standard deviation of 0.25/√3 = 0.144°; a panel pixel is 0.2° wide.
  const double sharp = bar_spread(1000, 1000);
  EXPECT_NEAR(sharp, 0.25 / std::sqrt(3.0), 0.06);
  EXPECT_GT(bar_spread(1000, 250), 1.5 * sharp) << "focused nearer";
}

TEST(Retina, IsSharpestWhereTheSceneIsEvenOffTheVirtualImage) {
  // Accommodation cues: a bar at 30 cm is sharper for an eye focused there than at 1 m, although all light
  // comes from a virtual image at 1 m; and the other way round.
  EXPECT_LT(bar_spread(300, 300), bar_spread(300, 1000));
  EXPECT_LT(bar_spread(1000, 1000), bar_spread(1000, 300));
}

TEST(Retina, BlursAsMuchAsThePupilAndTheDefocusSay) {
  // Focused at F, a point at D spreads over an angle of pupil·|1/D − 1/F|: a disc of diameter a has a
  // standard deviation of a/4 along one axis. Lenses sample the pupil at few places, hence the tolerance.
  const double sharp = bar_spread(1000, 1000), blurred = bar_spread(1000, 200);
  const double diameter_deg = 4 * (1 / 200.0 - 1 / 1000.0) * 180 / std::numbers::pi;
  EXPECT_NEAR(std::sqrt(blurred * blurred - sharp * sharp), diameter_deg / 4, 0.35 * diameter_deg / 4);
}

TEST(Retina, SeesAnEvenPanelEvenlyThroughAPinhole) {
  NearEyeDisplay display = consistent_with_thin_lenses({});
  DisplayImage panel(display.panel_width, display.panel_height);
  for (Rgb& c : panel.pixels()) c = {0.5f, 0.25f, 1};
  const DisplayImage retina =
      retinal_image(panel, display, {.pupil_mm = 0, .field_of_view_deg = 20}, {.width = 60});
  EXPECT_EQ(retina.width(), 60);
  EXPECT_EQ(retina.height(), 32);
  for (const Rgb& c : retina.pixels()) {
    ASSERT_NEAR(c.r, 0.5f, 1e-4f);
    ASSERT_NEAR(c.g, 0.25f, 1e-4f);
    ASSERT_NEAR(c.b, 1.0f, 1e-4f);
  }
}

TEST(Retina, DoesNotDependOnTheNumberOfThreads) {
  const NearEyeDisplay display = consistent_with_thin_lenses({});
  const DisplayImage panel = panel_with_bar(display, 500, 20);
  EXPECT_EQ(retinal_image(panel, display, {}, {.width = 50, .threads = 1}),
            retinal_image(panel, display, {}, {.width = 50, .threads = 2}));
}

TEST(Retina, RefusesEyesThatCannotSee) {
  const NearEyeDisplay display;
  EXPECT_THROW((Eye{.z_mm = 40}.validate(display)), InputError);
  EXPECT_THROW((Eye{.focus_mm = 20}.validate(display)), InputError);
  EXPECT_THROW((Eye{.pupil_mm = -1}.validate(display)), InputError);
  EXPECT_THROW(retinal_image(DisplayImage(10, 10), display, {}), InputError);
}

}  // namespace
}  // namespace plenolab
