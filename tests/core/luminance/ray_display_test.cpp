#include "core/luminance/ray_display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "core/base/error.h"
#include "tests/core/luminance/ray_fixtures.h"

namespace plenolab {
namespace {

using Kind = LensArrayDisplayOptions::Kind;
constexpr DisplaySpace kPlane{.x_min_m = -0.5, .x_max_m = 0.5, .y_min_m = -0.3, .y_max_m = 0.3};

struct Named {
  const char* name;
  std::unique_ptr<RayDisplay> display;
};

std::vector<Named> displays() {
  std::vector<Named> all;
  const auto add = [&](const char* name, auto display) {
    all.push_back({name, std::make_unique<decltype(display)>(std::move(display))});
  };
  add("projectors", small_projectors());
  add("one projector", small_projectors(1));
  add("arc",
      ProjectorDisplay(
          {.projectors = 9, .width = 20, .height = 10, .layout = ProjectorDisplayOptions::Layout::kArc}));
  add("views", MultiViewDisplay({.views = 5, .width = 16, .height = 9}));
  add("interleaved",
      MultiViewDisplay({.views = 5, .width = 40, .height = 9, .interleaved = true, .shift_px_per_row = 2}));
  add("lenticular", LensArrayDisplay({.width = 96, .height = 12, .lenses_across = 12}));
  add("slanted", LensArrayDisplay({.width = 100, .height = 12, .lenses_across = 12, .slant_lenses = 2.5}));
  add("barrier",
      LensArrayDisplay({.kind = Kind::kParallaxBarrier, .width = 96, .height = 12, .lenses_across = 12}));
  add("full parallax", LensArrayDisplay({.kind = Kind::kFullParallax,
                                         .space = kPlane,
                                         .width = 64,
                                         .height = 36,
                                         .lenses_across = 8,
                                         .lenses_down = 6}));
  return all;
}

template <class Body>
void for_each_ray(const RayDisplay& display, const Body& body) {
  const RayCount size = display.size();
  for (int k = 0; k < size.images; ++k)
    for (int u = 0; u < size.width; ++u)
      for (int v = 0; v < size.height; ++v) body(Ray{k, u, v});
}

bool holds(const std::vector<Ray>& rays, const Ray& ray) {
  return std::find(rays.begin(), rays.end(), ray) != rays.end();
}

TEST(RayDisplay, EveryRayIsAmongThoseOfItsOwnScreenPoint) {
  for (const auto& [name, display] : displays())
    for_each_ray(*display, [&, &name = name, &display = display](const Ray& ray) {
      const ScreenPoint point = display->screen_point(ray);
      std::vector<Ray> rays;
      display->rays_at(point, rays);
      // A slanted lens that the edge of the screen cuts has its middle outside, at the edge there is another.
      if (point.across > 0 && point.across < 1) {
        EXPECT_TRUE(holds(rays, ray)) << name << ": " << ray.image << ' ' << ray.u << ' ' << ray.v;
      }
    });
}

TEST(RayDisplay, WeightsAreOneAtTheirOwnPositionAndNothingBeyondTheReach) {
  for (const auto& [name, display] : displays())
    for_each_ray(*display, [&, &name = name, &display = display](const Ray& ray) {
      const ObserverPosition at = display->position(ray);
      EXPECT_NEAR(display->weight(ray, at), 1, 1e-12) << name;
      for (const double side : {-1.0, 1.0})
        EXPECT_EQ(display->weight(ray, {at.x_m + side * 1.001 * display->reach_m(), at.y_m}), 0) << name;
    });
}

TEST(RayDisplay, ColumnsOfADisplayInColumnsShareEverything) {
  for (const auto& [name, display] : displays()) {
    if (!display->in_columns()) continue;
    for_each_ray(*display, [&, &name = name, &display = display](const Ray& ray) {
      const Ray top{ray.image, ray.u, 0};
      EXPECT_EQ(display->position(ray).x_m, display->position(top).x_m) << name;
      EXPECT_EQ(display->position(ray).y_m, 0) << name;
    });
  }
}

TEST(RayDisplay, EveryObserverSeesLightAtEveryPointOfTheScreen) {
  // The barrier's boxes and the lenses' profiles touch, the projectors' line is long enough (P).
  for (const auto& [name, display] : displays()) {
    const PinholeSize size = display->resolution();
    const ObserverSamples samples = samples_of(*display, 23, 7);
    const int edge = display->in_columns() ? 0 : 1;  // the edge of the screen cuts slanted lenses
    std::vector<Ray> rays;
    for (int j = 0; j < samples.size(); ++j)
      for (int a = edge; a < size.width - edge; ++a) {
        rays.clear();
        display->rays_at(size.middle(a, size.height / 2), rays);
        double sum = 0;
        for (const Ray& ray : rays) sum += display->weight(ray, samples.position(j));
        EXPECT_GT(sum, 0) << name << " at " << samples.position(j).x_m << " m, column " << a;
      }
  }
}

TEST(ProjectorDisplay, HasTheGeometryOfTheSpecification) {
  const ProjectorDisplay display({});
  EXPECT_NEAR(display.options().half_line_m(), 1.6531, 5e-5);
  EXPECT_NEAR(display.projector_x_m(0), -display.projector_x_m(95), 1e-12);
  EXPECT_EQ(display.size().total(), 22'118'400u);
  // X = s + (s − p)·Z/D with s half a pixel right of the screen's left edge.
  const double s = -0.645 / 2 + 0.5 * 0.645 / 640;
  EXPECT_NEAR(display.position({0, 0, 0}).x_m, s + (s + display.options().half_line_m()) * 4, 1e-12);
  EXPECT_NEAR(display.spread_m(7), 2 * display.options().half_line_m() / 95 * 4, 1e-12);
  EXPECT_NEAR(display.weight({3, 5, 0}, {display.position({3, 5, 0}).x_m + display.spread_m(3) / 2, 0}), 0.5,
              1e-12);
}

TEST(ProjectorDisplay, RaysMeetAtTheirProjector) {
  const ProjectorDisplay display({});
  for (const Ray ray : {Ray{0, 0, 0}, {40, 320, 100}, {95, 639, 359}}) {
    const double s = (display.screen_point(ray).across - 0.5) * 0.645, x = display.position(ray).x_m;
    EXPECT_NEAR(s - (x - s) / 2 * 0.5, display.projector_x_m(ray.image), 1e-12);
  }
}

TEST(ProjectorDisplay, SumsOfWeightsRippleByTwelvePercentBeforeTheyAreNormalised) {
  const ProjectorDisplay display({.width = 64, .height = 1});
  double low = 1e9, high = 0;
  for (double x = -1; x < 1; x += 0.001) {
    double sum = 0;
    for (int k = 0; k < 96; ++k) sum += display.weight({k, 32, 0}, {x, 0});
    low = std::min(low, sum), high = std::max(high, sum);
  }
  EXPECT_NEAR(high / low - 1, 0.12, 0.01);
}

TEST(ProjectorDisplay, OnAnArcHasEqualAnglesAndWiderSpreadsTowardsItsEnds) {
  const ProjectorDisplay display({.projectors = 9, .layout = ProjectorDisplayOptions::Layout::kArc});
  const auto angle = [&](int k) { return std::atan2(display.projector_x_m(k), 0.5); };
  for (int k = 2; k < 9; ++k) EXPECT_NEAR(angle(k) - angle(k - 1), angle(1) - angle(0), 1e-12);
  EXPECT_GT(display.spread_m(0), display.spread_m(4));
}

TEST(MultiViewDisplay, ShowsEachViewToItsOwnCellOnly) {
  const MultiViewDisplay display(
      {.views = 4, .width = 16, .height = 2, .interleaved = true, .shift_px_per_row = 1});
  EXPECT_EQ(display.view_of({0, 3, 1}), 0);
  const ObserverSamples views = samples_of(display, 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(display.weight({0, 2, 0}, views.position(i)), i == 2 ? 1 : 0);
}

TEST(LensArrayDisplay, TurnsThePictureBelowALensAround) {
  const LensArrayDisplay display({.width = 96, .height = 2, .lenses_across = 12});
  EXPECT_GT(display.position({0, 8, 0}).x_m, display.position({0, 15, 0}).x_m);
  EXPECT_NEAR(display.position({0, 8, 0}).x_m, 0.5 - 1.0 / 16, 1e-12);
  const LensArrayDisplay full({.kind = Kind::kFullParallax,
                               .space = kPlane,
                               .width = 64,
                               .height = 36,
                               .lenses_across = 8,
                               .lenses_down = 6});
  EXPECT_LT(full.position({0, 0, 0}).y_m, full.position({0, 0, 5}).y_m);
  EXPECT_GT(full.position({0, 0, 0}).x_m, full.position({0, 7, 0}).x_m);
}

TEST(ObserverSamples, AreTheMiddlesOfCellsThatCoverTheRange) {
  const ObserverSamples samples{1000, 1, -5, 5, 0, 0};
  EXPECT_NEAR(samples.position(0).x_m, -4.995, 1e-12);
  EXPECT_NEAR(samples.position(999).x_m, 4.995, 1e-12);
  for (const int j : {0, 1, 499, 999}) EXPECT_EQ(samples.nearest(samples.position(j)), j);
  EXPECT_EQ(samples.nearest({-5.0001, 0}), -1);
  EXPECT_EQ(samples.nearest({-5, 0}), 0);
  EXPECT_EQ(samples.nearest({5, 0}), 999);
  EXPECT_EQ(samples.nearest({5.0001, 0}), -1);
  EXPECT_EQ(samples.nearest({std::nan(""), 0}), -1);
}

TEST(MultiViewDisplay, ObserversAtBothEndsOfTheRangeSeeTheOutermostViews) {
  const MultiViewDisplay display(
      {.space = {.x_min_m = -0.5, .x_max_m = 0.5}, .views = 4, .width = 3, .height = 2});
  EXPECT_EQ(display.weight({0, 1, 1}, {-0.5, 0}), 1);
  EXPECT_EQ(display.weight({3, 1, 1}, {0.5, 0}), 1);
  EXPECT_EQ(display.weight({3, 1, 1}, {0.5001, 0}), 0);
}

TEST(RayDisplay, SaysInASentenceWhatIsWrong) {
  EXPECT_THROW(ProjectorDisplay({.projectors = 0}), InputError);
  EXPECT_THROW(ProjectorDisplay({.projector_distance_m = 0}), InputError);
  EXPECT_THROW(ProjectorDisplay({.space = kPlane}), InputError);
  EXPECT_THROW(MultiViewDisplay({.views = 20, .width = 10, .interleaved = true}), InputError);
  EXPECT_THROW(LensArrayDisplay({.kind = Kind::kFullParallax}), InputError);
  EXPECT_THROW(LensArrayDisplay({.width = 10, .lenses_across = 11}), InputError);
  EXPECT_THROW(samples_of(small_projectors(), 0), InputError);
  EXPECT_THROW((ObserverSamples{10, 2}).validate(), InputError);
}

}  // namespace
}  // namespace plenolab
