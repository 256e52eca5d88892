#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/synthesis/patch_blend.h"
#include "core/synthesis/synthesizer.h"
#include "test_fields.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

using namespace testing_support;

void expect_finite(const SceneImage& image) {
  for (const Rgb& c : image.pixels()) {
    ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
    ASSERT_TRUE(c.r >= 0 && c.g >= 0 && c.b >= 0);
  }
}

template <class Referral>
void expect_same(const NovelView<Referral>& a, const NovelView<Referral>& b) {
  EXPECT_TRUE(a.image == b.image);
  EXPECT_TRUE(a.visible_views == b.visible_views);
  EXPECT_TRUE(a.unseen == b.unseen);
  EXPECT_TRUE(a.restored == b.restored);
}

SynthesisOptions without_pruning() {
  SynthesisOptions options;
  options.prune = false;
  return options;
}

TEST(Synthesis, OnAKeyViewReproducesThatViewBitByBit) {
  const LightField field = stepped_field(grid_of(3, 3, 50, 40), 14, 0.02f, 31);
  for (CameraPosition at :
       {CameraPosition{0, 0}, CameraPosition{1, 1}, CameraPosition{2, 1}, CameraPosition{2, 2}})
    for (bool prune : {true, false}) {
      SynthesisOptions options;
      options.prune = prune;
      const auto view = synthesize(field, at, options);
      EXPECT_TRUE(view.image == field.view(static_cast<int>(at.s), static_cast<int>(at.t))->colour);
      EXPECT_EQ(view.unseen_pixels + view.restored_pixels, 0u);
      ASSERT_EQ(view.views.size(), 1u);
      EXPECT_EQ(view.pruned.empty(), !prune);
    }
}

TEST(Synthesis, VeryNearAKeyViewTendsToThatView) {
  const LightField field = plane_field(grid_of(2, 2, 40, 30), 6);
  const auto view = synthesize(field, {1e-12, 1e-12});
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      EXPECT_NEAR(view.image.at(x, y).r, field.view(0, 0)->colour.at(x, y).r, 1e-5);
}

TEST(Synthesis, ReproducesAFrontoParallelPlaneAtAnyDisparity) {
  for (double ratio : {1.0, 0.6})
    for (double disparity : {0.0, 0.4, 1.0, 3.7, 12.0}) {
      const ViewGrid grid = grid_of(2, 2, 64, 48, ratio);
      const LightField field = plane_field(grid, disparity);
      for (CameraPosition at : {CameraPosition{0.5, 0.5}, CameraPosition{0.2, 0.9}, CameraPosition{0.7, 0}}) {
        const auto view = synthesize(field, at);
        EXPECT_EQ(view.unseen_pixels, 0u);
        for (int y = 0; y < grid.height; ++y)
          for (int x = 0; x < grid.width; ++x) {
            const Rgb expected = plane_colour(grid, at, x + 0.5, y + 0.5, disparity);
            ASSERT_NEAR(view.image.at(x, y).r, expected.r, 0.012) << disparity << " at " << x << ", " << y;
          }
      }
    }
}

TEST(Synthesis, PlaneAtDisparityZeroIsReproducedWithoutInterpolation) {
  const ViewGrid grid = grid_of(2, 2, 30, 20);
  const auto view = synthesize(plane_field(grid, 0), {0.3, 0.6});
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      EXPECT_EQ(view.visible_views.at(x, y), 4);
      EXPECT_NEAR(view.image.at(x, y).g, plane_colour(grid, {0, 0}, x + 0.5, y + 0.5, 0).g, 2e-6);
    }
}

TEST(Synthesis, IsTheSameForAnyNumberOfThreads) {
  const LightField field = stepped_field(grid_of(2, 2, 300, 90), 25, 0.01f, 32);
  SynthesisOptions options;
  options.threads = 1;
  const auto one = synthesize(field, {0.4, 0.3}, options);
  for (int threads : {2, 3, 7}) {
    options.threads = threads;
    const auto many = synthesize(field, {0.4, 0.3}, options);
    expect_same(one, many);
    EXPECT_EQ(one.statistics.search_samples, many.statistics.search_samples);
    EXPECT_EQ(one.statistics.occluded, many.statistics.occluded);
  }
}

TEST(Synthesis, IsTheSameWithLinearAndFastSearch) {
  for (double step : {0.25, 1.0, 4.0}) {
    const LightField field = stepped_field(grid_of(2, 2, 130, 60, 1.2), 22, 0.01f, 33);
    SynthesisOptions linear, fast;
    linear.step_px = fast.step_px = step;
    linear.search = SearchKind::kLinear;
    expect_same(synthesize(field, {0.37, 0.81}, linear), synthesize(field, {0.37, 0.81}, fast));
  }
}

TEST(Synthesis, IsTheSameWithAndWithoutPruning) {
  const ViewGrid grid = grid_of(2, 2, 70, 50);
  const auto smooth = field_of(grid, [](int c, int r, int x, int y) {
    return std::pair(noise_colour(34, pixel_index(c, r, x, y)), 3 + 0.05f * static_cast<float>(x));
  });
  const auto shallow = field_of(grid, [](int c, int r, int x, int y) {
    const std::uint64_t n = pixel_index(c, r, x, y);
    return std::pair(noise_colour(35, n), 0.2f * noise(36, n));
  });
  for (const LightField& field :
       {smooth, shallow, plane_field(grid, 0), plane_field(grid, 0.7), plane_field(grid, 9)})
    for (SearchKind search : {SearchKind::kLinear, SearchKind::kFast})
      for (CameraPosition at :
           {CameraPosition{0.5, 0.5}, CameraPosition{0.02, 0.01}, CameraPosition{1, 0.5}}) {
        SynthesisOptions pruned, full = without_pruning();
        pruned.search = full.search = search;
        const auto a = synthesize(field, at, pruned), b = synthesize(field, at, full);
        expect_same(a, b);
        EXPECT_FALSE(a.pruned.empty());
        EXPECT_TRUE(b.pruned.empty());
        EXPECT_EQ(a.statistics.used, b.statistics.used);
      }
}

TEST(Synthesis, LeavesNothingOutWhereEveryStageCanMatter) {
  EXPECT_TRUE(synthesize(stepped_field(grid_of(2, 2, 60, 40), 20, 0.01f, 37), {0.4, 0.6}).pruned.empty());
}

TEST(Synthesis, StaysFiniteForExtremeRadiance) {
  const auto field = field_of(grid_of(2, 2, 40, 30), [](int c, int r, int x, int y) {
    const std::uint64_t n = pixel_index(c, r, x, y);
    const float value = n % 7 == 0 ? 0.0f : std::pow(10.0f, 18 * noise(38, n) - 9);
    return std::pair(Rgb{value, 1e9f, x == 20 && y == 15 ? std::numeric_limits<float>::max() : 1e-9f},
                     5 * noise(39, n));
  });
  expect_finite(synthesize(field, {0.3, 0.7}).image);
}

TEST(Synthesis, KeepsConstantRadianceFromTheSmallestToTheLargest) {
  for (float radiance : {1e-9f, 1.0f, 1e9f, 0.0f}) {
    const auto field = field_of(grid_of(2, 2, 30, 20), [&](int c, int r, int x, int y) {
      return std::pair(Rgb{radiance, radiance, radiance}, 4 * noise(40, pixel_index(c, r, x, y)));
    });
    const auto view = synthesize(field, {0.3, 0.7});
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 30; ++x)
        if (view.unseen.at(x, y) == 0) {
          ASSERT_NEAR(view.image.at(x, y).r, radiance, 4e-6f * radiance);
        }
  }
}

TEST(Synthesis, RepairsNonFiniteAndNegativeValuesAndSaysHowMany) {
  auto broken = field_of(grid_of(2, 2, 20, 10), [](int c, int r, int x, int y) {
    Rgb colour{1, 1, 1};
    if (x == 3 && y == 4) colour = {std::nanf(""), INFINITY, -1};
    return std::pair(colour, noise(41, pixel_index(c, r, x, y)));
  });
  for (CameraPosition at : {CameraPosition{0.5, 0.5}, CameraPosition{0, 0}}) {
    const auto view = synthesize(broken, at);
    expect_finite(view.image);
    EXPECT_EQ(view.repaired_values, 3 * view.views.size());
  }
  EXPECT_EQ(synthesize(broken, {0, 0}).image.at(3, 4), (Rgb{0, 1, 0}))
      << "+Inf counts as the largest value there is";
}

TEST(Synthesis, RefusesAPositionOutsideTheGridAndNamesIt) {
  const LightField field = plane_field(grid_of(2, 2, 8, 8), 1);
  for (CameraPosition at : {CameraPosition{1.01, 0}, CameraPosition{0, -0.5}, CameraPosition{NAN, 0}})
    EXPECT_THROW(synthesize(field, at), InputError);
  const std::string message = message_of([&] { synthesize(field, {1.25, 0}); });
  EXPECT_NE(message.find("1.25"), std::string::npos) << message;
}

TEST(SynthesisOptions, RefuseEachValueOutOfRange) {
  const auto refuses = [](auto change) {
    SynthesisOptions options;
    change(options);
    EXPECT_THROW(options.validate(), InputError);
  };
  SynthesisOptions().validate();
  refuses([](auto& o) { o.step_px = 0.2; });
  refuses([](auto& o) { o.step_px = NAN; });
  refuses([](auto& o) { o.disocclusion_px = 0; });
  refuses([](auto& o) { o.occlusion_margin_px = -0.1; });
  refuses([](auto& o) { o.border_fraction = 0.6; });
  refuses([](auto& o) { o.border_delta = -1; });
  refuses([](auto& o) { o.key_views = 3; });
  refuses([](auto& o) { o.camera = CameraKind::kFixedScreen; });
  refuses([](auto& o) { o.threads = -1; });
}

TEST(Synthesis, UsesFewerKeyViewsOnRequest) {
  const LightField field = plane_field(grid_of(2, 2, 40, 30), 4);
  for (int count : {1, 2, 4}) {
    SynthesisOptions options;
    options.key_views = count;
    const auto view = synthesize(field, {0.3, 0.4}, options);
    EXPECT_EQ(view.views.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(view.statistics.searches, static_cast<std::uint64_t>(count) * 40 * 30);
  }
}

TEST(Synthesis, StatesOfAllCorrespondencesAddUp) {
  const auto view = synthesize(stepped_field(grid_of(2, 2, 90, 70), 20, 0.02f, 42), {0.6, 0.3});
  const SynthesisStatistics& s = view.statistics;
  EXPECT_EQ(s.searches, 4u * 90 * 70);
  EXPECT_EQ(s.used + s.out_of_frustum + s.disoccluded + s.occluded + s.restored + s.weight_zero, s.searches);
  EXPECT_GT(s.disoccluded, 0u);
  EXPECT_GT(s.occluded, 0u);
}

TEST(Synthesis, RecordsWhatBecameOfEveryCorrespondence) {
  const LightField field = stepped_field(grid_of(2, 2, 60, 40), 15, 0.02f, 43);
  SynthesisOptions options;
  const auto plain = synthesize(field, {0.6, 0.3}, options);
  options.record_provenance = true;
  const auto uncounted = synthesize(field, {0.6, 0.3}, options);
  options.count_probes = true;
  const auto recorded = synthesize(field, {0.6, 0.3}, options);
  expect_same(plain, uncounted);
  expect_same(plain, recorded);
  EXPECT_EQ(plain.statistics.search_samples, recorded.statistics.search_samples);
  std::uint64_t probes = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      float weight = 0;
      int used = 0;
      for (const Correspondence& c : recorded.provenance.at(x, y)) {
        weight += c.weight;
        probes += c.probes;
        used += c.state == CorrespondenceState::kUsed || c.state == CorrespondenceState::kWeightZero ? 1 : 0;
        EXPECT_NE(c.state, CorrespondenceState::kNotUsed);
      }
      EXPECT_NEAR(weight, recorded.unseen.at(x, y) != 0 ? 0 : 1, 1e-5);
      EXPECT_EQ(used, recorded.visible_views.at(x, y));
    }
  EXPECT_EQ(probes, recorded.statistics.search_samples + recorded.statistics.refine_samples);
}

TEST(FixedScreen, FromTheGridCentreIsTheShiftedFrustum) {
  const LightField field = stepped_field(grid_of(4, 2, 60, 40), 12, 0.01f, 44);
  SynthesisOptions fixed;
  fixed.camera = CameraKind::kFixedScreen;
  fixed.screen_depth_m = 2;
  expect_same(synthesize(field, {1.5, 0.5}, fixed), synthesize(field, {1.5, 0.5}));
}

TEST(FixedScreen, ThePlaneOfTheScreenStandsStill) {
  const ViewGrid grid = grid_of(3, 3, 80, 60, 0.7);
  const double disparity = 6;
  const LightField field = plane_field(grid, disparity);
  SynthesisOptions options;
  options.camera = CameraKind::kFixedScreen;
  options.screen_depth_m = grid.depth_m(disparity);
  for (CameraPosition at : {CameraPosition{0.4, 1.3}, CameraPosition{1.7, 0.6}, CameraPosition{1, 1}}) {
    const auto view = synthesize(field, at, options);
    for (int y = 12; y < 48; ++y)
      for (int x = 12; x < 68; ++x) {
        const Rgb expected = plane_colour(grid, {1, 1}, x + 0.5, y + 0.5, disparity);
        ASSERT_NEAR(view.image.at(x, y).r, expected.r, 0.012) << x << ", " << y;
      }
  }
}

TEST(Synthesis, DisplayReferredViewsAreBlendedAsTheyAre) {
  const ViewGrid grid = grid_of(2, 1, 20, 10);
  std::vector<KeyView<DisplayReferred>> views(2);
  for (std::size_t n = 0; n < 2; ++n) {
    const float v = n == 0 ? 0.2f : 0.8f;
    views[n] = {DisplayImage(20, 10, {v, v, v}), DisparityMap(20, 10)};
  }
  const auto field =
      DisplayLightField::from_views(grid, RadianceUnit::kRelative, "display", std::move(views));
  SynthesisOptions options;
  options.border_weight = BorderWeight::kNone;
  const auto view = synthesize(field, {0.25, 0}, options);
  for (const Rgb& c : view.image.pixels()) EXPECT_NEAR(c.r, 0.35f, 1e-6);
}

TEST(Restoration, TakesTheFarthestOfThePixelsAroundACorrespondence) {
  KeyView<SceneReferred> view{SceneImage(3, 2), DisparityMap(3, 2, 9)};
  view.disparity.at(1, 1) = 2;
  view.disparity.at(2, 0) = 1;
  const PreparedView prepared = prepare_view(view, 1);
  EXPECT_EQ(background_pixel(prepared, {0, 0, 0.4f, 0.4f}), (Hit{1, 1, 0, 0}));
  EXPECT_EQ(background_pixel(prepared, {1, 0, 0.4f, 0.4f}), (Hit{2, 0, 0, 0}));
  EXPECT_EQ(background_pixel(prepared, {0, 0, 0.6f, 0}), (Hit{1, 0, 0, 0}));
}

/// A square of disparity 12 in front of a background of disparity 2, seen from everywhere.
LightField occluder_field(const ViewGrid& grid, double left, double right, double top, double bottom) {
  return field_of(grid, [=](int c, int r, int x, int y) {
    const double u = x + 0.5 + c * 12, v = y + 0.5 + r * 12;
    const bool front = u >= left && u < right && v >= top && v < bottom;
    return std::pair(front ? Rgb{1, 0, 0} : Rgb{0, 1, 0}, front ? 12.0f : 2.0f);
  });
}

TEST(Synthesis, AConvexOccluderLeavesAtMostARimOfOnePixelUnseen) {
  const ViewGrid grid = grid_of(2, 2, 100, 80);
  const LightField field = occluder_field(grid, 40, 70, 30, 60);
  SynthesisOptions options;
  options.restore = false;
  for (CameraPosition at : {CameraPosition{0.5, 0.5}, CameraPosition{0.3, 0.8}}) {
    const auto view = synthesize(field, at, options);
    const double left = 40 - 12 * at.s, right = 70 - 12 * at.s, top = 30 - 12 * at.t, bottom = 60 - 12 * at.t;
    for (int y = 0; y < grid.height; ++y)
      for (int x = 0; x < grid.width; ++x) {
        if (view.unseen.at(x, y) == 0) continue;
        const double outside =
            std::max({left - (x + 0.5), x + 0.5 - right, top - (y + 0.5), y + 0.5 - bottom});
        EXPECT_LE(std::abs(outside), 1.5) << x << ", " << y;
      }
    EXPECT_EQ(view.image.at(static_cast<int>(0.5 * (left + right)), static_cast<int>(0.5 * (top + bottom))).g,
              0);
  }
}

}  // namespace
}  // namespace plenolab
