#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"
#include "core/image/colour.h"
#include "core/tonemap/adjustment/key_view_adjustment.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

constexpr int kWidth = 48, kHeight = 30;

/// A light field before and after tone mapping.
struct Fields {
  ViewGrid grid;
  std::vector<KeyView<SceneReferred>> hdr;
  std::vector<KeyView<DisplayReferred>> display;

  Fields(int columns, int rows) {
    grid = {.columns = columns, .rows = rows, .width = kWidth, .height = kHeight};
    const auto views = static_cast<std::size_t>(columns * rows);
    hdr.assign(views, {SceneImage(kWidth, kHeight, {1, 1, 1}), DisparityMap(kWidth, kHeight, 2)});
    display.assign(views,
                   {DisplayImage(kWidth, kHeight, {0.5f, 0.5f, 0.5f}), DisparityMap(kWidth, kHeight, 2)});
  }

  LightField scene() const { return LightField::from_views(grid, RadianceUnit::kRelative, "hdr", hdr); }
  DisplayLightField mapped() const {
    return DisplayLightField::from_views(grid, RadianceUnit::kRelative, "mapped", display);
  }

  struct Result {
    std::vector<DisplayImage> views;
    KeyViewAdjustmentCounts counts;
  };
  Result adjusted(const KeyViewAdjustmentOptions& options = {}, const KeyViewAdjustmentRun& run = {}) const {
    Result result;
    result.counts = adjust_key_views(
        scene(), mapped(), options,
        [&](int column, int row, const DisplayImage& view) {
          EXPECT_EQ(static_cast<std::size_t>(row * grid.columns + column), result.views.size());
          result.views.push_back(view);
        },
        run);
    return result;
  }
};

float random_float(std::uint64_t purpose, std::uint64_t view, int x, int y) {
  return unit_float(random_u64(purpose, view, static_cast<std::uint64_t>(y * kWidth + x)));
}

/// A textured plane, discs before it and a tone mapping that differs from view to view.
Fields uneven_fields(int columns, int rows) {
  Fields f(columns, rows);
  for (std::size_t v = 0; v < f.hdr.size(); ++v) {
    const int column = static_cast<int>(v) % columns, row = static_cast<int>(v) / columns;
    const float gain = 0.6f + 0.4f * unit_float(random_u64(1, 2, v));
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double near_x = x + 5.0 * column - 20, near_y = y + 5.0 * row - 15;
        const double d = std::hypot(near_x, near_y) < 7 ? 5 : 0.5 + y * 0.05;
        const double u = x + d * column, w = y + d * row;
        const double l = std::pow(10.0, std::sin(0.3 * u + d) + 0.5 * std::cos(0.2 * w)) *
                         (1 + 0.05 * static_cast<double>(random_float(3, v, x, y)));
        f.hdr[v].disparity.at(x, y) = static_cast<float>(d);
        const float radiance = static_cast<float>(l),
                    q = gain * std::pow(radiance / (radiance + 1), 1 / 2.2f);
        f.hdr[v].colour.at(x, y) = {radiance, 0.8f * radiance, 0.6f * radiance};
        f.display[v].colour.at(x, y) = {q, 0.9f * q, 0.8f * q};
      }
  }
  return f;
}

double largest_difference(const DisplayImage& a, const DisplayImage& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb d = a.pixels()[i] - b.pixels()[i];
    for (const float c : {d.r, d.g, d.b}) largest = std::max(largest, std::abs(static_cast<double>(c)));
  }
  return largest;
}

TEST(KeyViewAdjustment, LeavesAConstantLightFieldAsItIs) {
  const Fields f(5, 3);
  const auto result = f.adjusted();
  ASSERT_EQ(result.views.size(), 15u);
  for (const DisplayImage& view : result.views) EXPECT_EQ(view, f.display[0].colour);
  EXPECT_EQ(result.counts.pixels, 15 * kWidth * kHeight);
  EXPECT_EQ(result.counts.clipped_high + result.counts.kept_dark + result.counts.floored_pixels, 0);
}

TEST(KeyViewAdjustment, LeavesIdenticalViewsAtInfinityAsTheyAre) {
  Fields f = uneven_fields(4, 2);
  for (std::size_t v = 0; v < f.hdr.size(); ++v) {
    f.hdr[v] = f.hdr[0];
    f.hdr[v].disparity = DisparityMap(kWidth, kHeight, 0);
    f.display[v] = f.display[0];
  }
  for (const DisplayImage& view : f.adjusted().views) EXPECT_EQ(view, f.display[0].colour);
}

TEST(KeyViewAdjustment, LeavesASingleViewAsItIs) {
  const Fields f = uneven_fields(1, 1);
  EXPECT_EQ(f.adjusted().views[0], f.display[0].colour);
  EXPECT_EQ(f.adjusted().counts.correspondences, 0);
}

TEST(KeyViewAdjustment, SupportOfNoOtherViewsLeavesEveryViewAsItIs) {
  const Fields f = uneven_fields(3, 2);
  const auto result = f.adjusted({.support_views = 0.9});
  for (std::size_t v = 0; v < f.display.size(); ++v) EXPECT_EQ(result.views[v], f.display[v].colour);
}

// The neighbour weighs e^(−1/2σ²) beside the own 1; with a wide σ both meet half way.
TEST(KeyViewAdjustment, TwoViewsThatDifferByAGlobalFactorMeetInTheMiddle) {
  Fields f(2, 1);
  for (auto& view : f.hdr) view.disparity = DisparityMap(kWidth, kHeight, 0);
  f.display[1].colour = DisplayImage(kWidth, kHeight, {0.25f, 0.25f, 0.25f});
  const auto wide = f.adjusted({.sigma_views = 1000});
  EXPECT_NEAR(wide.views[0].at(5, 5).r, 0.375, 1e-6);
  EXPECT_NEAR(wide.views[1].at(5, 5).g, 0.375, 1e-6);
  const auto usual = f.adjusted({.sigma_views = 2});
  const double w = std::exp(-1.0 / 8);
  EXPECT_NEAR(usual.views[0].at(9, 3).b, (0.5 + 0.25 * w) / (1 + w), 1e-6);
  EXPECT_NEAR(usual.views[1].at(9, 3).b, (0.25 + 0.5 * w) / (1 + w), 1e-6);
}

// Hue is kept: all channels are multiplied by the factor of the luma.
TEST(KeyViewAdjustment, ScalesTheChannelsOfAPixelAlike) {
  Fields f(2, 1);
  for (auto& view : f.hdr) view.disparity = DisparityMap(kWidth, kHeight, 0);
  f.display[0].colour = DisplayImage(kWidth, kHeight, {0.1f, 0.4f, 0.2f});
  f.display[1].colour = DisplayImage(kWidth, kHeight, {0.3f, 0.3f, 0.3f});
  const Rgb c = f.adjusted({.sigma_views = 1000}).views[0].at(7, 7);
  const double middle = (static_cast<double>(luminance({0.1f, 0.4f, 0.2f})) + 0.3) / 2;
  EXPECT_NEAR(luminance(c), middle, 1e-6);
  EXPECT_NEAR(c.g / c.r, 4, 1e-5);
  EXPECT_NEAR(c.b / c.r, 2, 1e-5);
}

TEST(KeyViewAdjustment, FollowsTheDisparityAndCountsWhatLiesInside) {
  Fields f(2, 1);
  f.hdr[0].disparity = f.hdr[1].disparity = DisparityMap(kWidth, kHeight, 10);
  for (int y = 0; y < kHeight; ++y) f.display[1].colour.at(20, y) = {0.7f, 0.7f, 0.7f};
  const Plane<float> factors = literal_adjustment_factors(f.scene(), f.mapped(), {.sigma_views = 1000}, 0, 0);
  // A view on the right sees everything farther left by the disparity: pixel 30 of the left view at 20.
  EXPECT_NEAR(factors.at(30, 4), 1.2, 1e-6);
  EXPECT_EQ(factors.at(29, 4), 1);
  EXPECT_EQ(factors.at(31, 4), 1);
  EXPECT_EQ(f.adjusted().counts.correspondences, 2 * (kWidth - 10) * kHeight);
}

TEST(KeyViewAdjustment, VerticalDisparityTakesTheRatioOfTheSpacings) {
  Fields f(1, 2);
  f.grid.spacing_y_m = 0.5;
  f.hdr[0].disparity = f.hdr[1].disparity = DisparityMap(kWidth, kHeight, 10);
  for (int x = 0; x < kWidth; ++x) f.display[1].colour.at(x, 12) = {0.7f, 0.7f, 0.7f};
  const Plane<float> factors = literal_adjustment_factors(f.scene(), f.mapped(), {.sigma_views = 1000}, 0, 0);
  EXPECT_NEAR(factors.at(4, 17), 1.2, 1e-6);
  EXPECT_EQ(factors.at(4, 16), 1);
}

// An occluder in the other view has another disparity, another material another HDR luminance.
TEST(KeyViewAdjustment, OccludedPixelsAndOtherMaterialsDoNotMix) {
  Fields occluded(2, 1), other_material(2, 1);
  for (Fields* f : {&occluded, &other_material}) {
    f->display[1].colour = DisplayImage(kWidth, kHeight, {0.9f, 0.9f, 0.9f});
    for (auto& view : f->hdr) view.disparity = DisparityMap(kWidth, kHeight, 0);
  }
  occluded.hdr[1].disparity = DisparityMap(kWidth, kHeight, 5);
  other_material.hdr[1].colour = SceneImage(kWidth, kHeight, {10, 10, 10});
  EXPECT_LT(largest_difference(occluded.adjusted().views[0], occluded.display[0].colour), 1e-6);
  EXPECT_LT(largest_difference(other_material.adjusted().views[0], other_material.display[0].colour), 1e-6);
  occluded.hdr[1].disparity = DisparityMap(kWidth, kHeight, 0);
  EXPECT_GT(largest_difference(occluded.adjusted().views[0], occluded.display[0].colour), 0.1);
}

TEST(KeyViewAdjustment, EqualsTheLiteralVersion) {
  const Fields f = uneven_fields(5, 3);
  const KeyViewAdjustmentOptions options{.smoothing_share = 0.05};
  const auto fast = f.adjusted(options);
  for (const int view : {0, 7, 9}) {
    const DisplayImage literal =
        adjust_key_view_literally(f.scene(), f.mapped(), options, view % 5, view / 5);
    EXPECT_LT(largest_difference(fast.views[static_cast<std::size_t>(view)], literal), 2e-3) << view;
    EXPECT_GT(largest_difference(literal, f.display[static_cast<std::size_t>(view)].colour), 0.02) << view;
  }
}

TEST(KeyViewAdjustment, FarViewsMatterLessThanTheirWeight) {
  const Fields f = uneven_fields(7, 1);
  const auto all = f.adjusted({.sigma_views = 1, .support_views = 100});
  double before = 1;
  for (const double support : {1.0, 2.0, 3.0, 4.0}) {
    const auto some = f.adjusted({.sigma_views = 1, .support_views = support});
    double largest = 0;
    for (std::size_t v = 0; v < all.views.size(); ++v)
      largest = std::max(largest, largest_difference(all.views[v], some.views[v]));
    EXPECT_LT(largest, before);
    before = largest;
  }
  EXPECT_LT(before, 1e-3);
}

TEST(KeyViewAdjustment, DrawsUnevenViewsTogether) {
  const Fields f = uneven_fields(5, 3);
  const auto spread = [](const auto& image_of) {
    std::vector<double> means;
    for (std::size_t v = 0; v < 15; ++v) {
      double sum = 0;
      const DisplayImage image = image_of(v);
      for (const Rgb c : image.pixels()) sum += static_cast<double>(luminance(c));
      means.push_back(sum / (kWidth * kHeight));
    }
    const auto [min, max] = std::minmax_element(means.begin(), means.end());
    return *max / *min;
  };
  const auto result = f.adjusted();
  const double before = spread([&](std::size_t v) { return f.display[v].colour; });
  const double after = spread([&](std::size_t v) { return result.views[v]; });
  EXPECT_GT(before, 1.4);
  EXPECT_LT(after, 1 + 0.5 * (before - 1));
}

TEST(KeyViewAdjustment, IsTheSameForAnyThreadsBatchesAndInstructionSets) {
  const Fields f = uneven_fields(4, 3);
  const auto expected = f.adjusted({}, {.threads = 1});
  for (const KeyViewAdjustmentRun& run : {KeyViewAdjustmentRun{.threads = 3},
                                          {.threads = 2, .memory_bound_bytes = 1},
                                          {.memory_bound_bytes = 150000}}) {
    const auto result = f.adjusted({}, run);
    EXPECT_EQ(result.views, expected.views);
    EXPECT_EQ(result.counts, expected.counts);
  }
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(f.adjusted().views, expected.views) << hwy::TargetName(target);
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(KeyViewAdjustment, DarkPixelsKeepTheirValuesAndBrightOnesAreCutAndCounted) {
  Fields f(2, 1);
  for (auto& view : f.hdr) view.disparity = DisparityMap(kWidth, kHeight, 0);
  f.display[0].colour = DisplayImage(kWidth, kHeight, {0.0005f, 0.0005f, 0.0005f});
  f.display[1].colour = DisplayImage(kWidth, kHeight, {0.9f, 0.9f, 0.9f});
  const auto dark = f.adjusted();
  EXPECT_EQ(dark.views[0], f.display[0].colour);
  EXPECT_EQ(dark.counts.kept_dark, kWidth * kHeight);
  f.display[0].colour = DisplayImage(kWidth, kHeight, {1, 0.1f, 0});
  const auto bright = f.adjusted();
  EXPECT_EQ(bright.views[0].at(0, 0).r, 1);
  EXPECT_GT(bright.views[0].at(0, 0).g, 0.1f);
  EXPECT_EQ(bright.views[0].at(0, 0).b, 0);
  EXPECT_EQ(bright.counts.clipped_high, kWidth * kHeight);
}

TEST(KeyViewAdjustment, BadPixelsAreRepairedAndCountedAndNothingBecomesNaN) {
  constexpr float kInf = std::numeric_limits<float>::infinity(),
                  kNaN = std::numeric_limits<float>::quiet_NaN();
  Fields f = uneven_fields(3, 2);
  f.hdr[0].colour.at(1, 1) = {kNaN, 1, 1};
  f.hdr[1].colour.at(2, 1) = {kInf, kInf, 1};
  f.hdr[2].colour.at(3, 1) = {-1, 0, 0};
  f.hdr[3].colour.at(3, 1) = {1e30f, 1e-30f, 0};
  f.hdr[3].disparity.at(8, 8) = 1e9f;
  f.display[4].colour.at(4, 4) = {kNaN, 2, -1};
  const auto result = f.adjusted();
  EXPECT_EQ(result.counts.hdr_repairs, (PixelRepairs{.nan = 1, .positive_infinity = 2, .negative = 1}));
  EXPECT_EQ(result.counts.display_repairs, 3);
  EXPECT_EQ(result.counts.floored_pixels, 1);
  for (const DisplayImage& view : result.views)
    for (const Rgb c : view.pixels())
      EXPECT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1);
}

TEST(KeyViewAdjustment, BlackLightFieldsStayBlack) {
  Fields f(2, 2);
  for (auto& view : f.hdr) view.colour = SceneImage(kWidth, kHeight);
  for (auto& view : f.display) view.colour = DisplayImage(kWidth, kHeight);
  const auto result = f.adjusted();
  for (const DisplayImage& view : result.views) EXPECT_EQ(view, DisplayImage(kWidth, kHeight));
  EXPECT_EQ(result.counts.floored_pixels, 4 * kWidth * kHeight);
}

TEST(KeyViewAdjustment, ProgressRisesToOne) {
  double last = 0;
  uneven_fields(3, 1).adjusted({}, {.threads = 1, .memory_bound_bytes = 1, .progress = [&](double share) {
                                      EXPECT_GE(share, last);
                                      last = share;
                                    }});
  EXPECT_EQ(last, 1);
}

TEST(KeyViewAdjustment, LightFieldsOfOtherGridsAndOptionsOutOfRangeAreRefused) {
  const Fields f(2, 1), g(3, 1);
  const auto nothing = [](int, int, const DisplayImage&) {};
  EXPECT_EQ(message_of([&] { adjust_key_views(f.scene(), g.mapped(), {}, nothing); }),
            "the HDR light field hdr has 2×1 views of 48×30 pixels, the tone mapped one mapped 3×1 of 48×30; "
            "give two "
            "forms of the same light field");
  EXPECT_EQ(message_of([&] { adjust_key_views(f.scene(), f.mapped(), {.sigma_views = 0}, nothing); }),
            "the key-view adjustment's sigma in key views must be between 0.001 and 1000, not 0");
  EXPECT_EQ(message_of([&] { adjust_key_views(f.scene(), f.mapped(), {.support_views = -1}, nothing); }),
            "the key-view adjustment's support in key views must be between 0 and 1000000000, not -1");
}

}  // namespace
}  // namespace plenolab
