// What the exact and the fast filter have in common.
#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <string>

#include "core/tonemap/filters/bilateral_filter.h"
#include "core/tonemap/filters/bilateral_grid.h"
#include "tests/core/tonemap/filters/filter_images.h"

namespace plenolab {
namespace {

using Filter = Plane<float> (*)(const Plane<float>&, const BilateralOptions&,
                                const std::optional<DepthGuide>&, int);

class Bilateral : public testing::TestWithParam<Filter> {
 protected:
  Plane<float> filter(const Plane<float>& value, const BilateralOptions& options,
                      const std::optional<DepthGuide>& depth = std::nullopt, int threads = 1) const {
    return GetParam()(value, options, depth, threads);
  }
};

Plane<float> by_grid(const Plane<float>& value, const BilateralOptions& options,
                     const std::optional<DepthGuide>& depth, int threads) {
  if (value.empty()) return {};
  std::optional<Plane<float>> result = filter_by_grid({value, value, options, depth, threads}, {});
  return result ? *result : bilateral_exact(value, options, depth, threads);
}

std::string name_of(const testing::TestParamInfo<Filter>& test) {
  return test.index == 0 ? "Exact" : test.index == 1 ? "Fast" : "Grid";
}

INSTANTIATE_TEST_SUITE_P(All, Bilateral, testing::Values(&bilateral_exact, &bilateral_fast, &by_grid),
                         name_of);

bool same_bits(const Plane<float>& a, const Plane<float>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.size() * sizeof(float)) == 0;
}

TEST(BilateralFilters, LeaveAConstantImageAsItIs) {
  const Plane<float> image(120, 70, -2.345678f);
  const FilterImage ramp = discs_before_ground(120, 70);
  for (const Filter filter : {&bilateral_exact, &bilateral_fast}) {
    EXPECT_EQ(filter(image, {}, std::nullopt, 1), image);
    EXPECT_EQ(filter(image, {}, DepthGuide{&ramp.disparity}, 1), image);
  }
}

class PublicBilateral : public Bilateral {};

INSTANTIATE_TEST_SUITE_P(ExactAndFast, PublicBilateral, testing::Values(&bilateral_exact, &bilateral_fast),
                         name_of);

TEST_P(PublicBilateral, ConstantDisparityGivesTheBitsOfTheFilterWithoutDepth) {
  const FilterImage image = discs_before_ground(150, 90);
  const BilateralOptions options{.sigma_s_px = 8};
  const Plane<float> plain = filter(image.value, options);
  DisparityMap flat(150, 90, 7.5f);
  for (const DepthSide side : {DepthSide::kTwoSided, DepthSide::kBackgroundTakesNothingFromForeground}) {
    flat.at(3, 4) = 7.5f;
    EXPECT_TRUE(same_bits(filter(image.value, options, DepthGuide{&flat, 0.5, side}), plain));
    flat.at(3, 4) = 7.50005f;  // no weight changes
    EXPECT_TRUE(same_bits(filter(image.value, options, DepthGuide{&flat, 0.5, side}), plain));
    flat.at(3, 4) = 9;
    EXPECT_FALSE(same_bits(filter(image.value, options, DepthGuide{&flat, 0.5, side}), plain));
  }
}

TEST_P(Bilateral, IsTheSameForAnyNumberOfThreads) {
  const FilterImage image = discs_before_ground(160, 97);
  const BilateralOptions options{.sigma_s_px = 9};
  for (const bool guided : {false, true}) {
    std::optional<DepthGuide> depth;
    if (guided) depth = DepthGuide{&image.disparity, 0.5, DepthSide::kBackgroundTakesNothingFromForeground};
    const Plane<float> one = filter(image.value, options, depth, 1);
    EXPECT_TRUE(same_bits(filter(image.value, options, depth, 2), one));
    EXPECT_TRUE(same_bits(filter(image.value, options, depth, 5), one));
  }
}

TEST_P(Bilateral, IsTheSameForEveryInstructionSet) {
  const FilterImage image = discs_before_ground(101, 53);
  const BilateralOptions options{.sigma_s_px = 6};
  const DepthGuide depth{&image.disparity};
  const Plane<float> best = filter(image.value, options, depth);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_TRUE(same_bits(filter(image.value, options, depth), best)) << hwy::TargetName(target);
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST_P(Bilateral, ImagesOfOnePixelRowOrColumnWork) {
  EXPECT_EQ(filter(Plane<float>(1, 1, 3.5f), {}).at(0, 0), 3.5f);
  EXPECT_TRUE(filter(Plane<float>(), {}).empty());
  Plane<float> row(50, 1), column(1, 50);
  for (int i = 0; i < 50; ++i) row.at(i, 0) = column.at(0, i) = i < 25 ? 0.0f : 0.1f;
  const Plane<float> along = filter(row, {.sigma_s_px = 5}), down = filter(column, {.sigma_s_px = 5});
  EXPECT_GT(along.at(24, 0), 0.03f);
  for (int i = 0; i < 50; ++i) EXPECT_FLOAT_EQ(along.at(i, 0), down.at(0, i));
}

TEST_P(Bilateral, TinyWidthsLeaveTheImageAsItIs) {
  const FilterImage image = discs_before_ground(40, 30);
  EXPECT_EQ(filter(image.value, {.sigma_s_px = 0.05}), image.value);
  EXPECT_LT(difference(filter(image.value, {.sigma_s_px = 5, .sigma_value = 1e-7}), image.value).max, 1e-6);
}

TEST_P(Bilateral, WidthsFarBeyondImageAndRangeGiveTheMean) {
  const FilterImage image = discs_before_ground(60, 40);
  double mean = 0;
  for (const float v : image.value.pixels())
    mean += static_cast<double>(v) / static_cast<double>(image.value.size());
  const Plane<float> result = filter(image.value, {.sigma_s_px = 1e6, .sigma_value = 1e4});
  EXPECT_LT(difference(result, Plane<float>(60, 40, static_cast<float>(mean))).max, 3e-5);
}

TEST_P(Bilateral, StaysBetweenTheExtremesOverFifteenDecades) {
  FilterImage image = discs_before_ground(90, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 90; ++x) image.value.at(x, y) = static_cast<float>(-6 + 15 * noise(3, x, y));
  for (const auto& depth : {std::optional<DepthGuide>{}, std::optional(DepthGuide{&image.disparity})}) {
    const Plane<float> result = filter(image.value, {.sigma_s_px = 7}, depth);
    const auto [min, max] = std::minmax_element(result.pixels().begin(), result.pixels().end());
    EXPECT_GE(*min, -6.001f);
    EXPECT_LE(*max, 9.001f);
  }
}

// At 10 σ the window of thousands weighs e^-50: nothing. At 3 σ it outweighs the pixel, at 4.2 σ they
// balance.
TEST_P(Bilateral, ALonePixelHoldsOutAgainstItsWindowByItsContrast) {
  const auto filtered_pixel = [&](float contrast) {
    Plane<float> image(121, 121, 0.0f);
    image.at(60, 60) = contrast;
    return filter(image, {.sigma_s_px = 16, .sigma_value = 0.4}).at(60, 60);
  };
  EXPECT_NEAR(filtered_pixel(4), 4, 1e-4);
  const double window = 2 * 3.14159265358979 * 16 * 16 * std::pow(std::erf(3 / std::sqrt(2.0)), 2);
  for (const double contrast : {1.2, 1.6, 1.7}) {
    const double others = window * std::exp(-contrast * contrast / 0.32);
    EXPECT_NEAR(static_cast<double>(filtered_pixel(static_cast<float>(contrast))), contrast / (1 + others),
                0.05);
  }
}

TEST_P(Bilateral, AccountsForDepthAtAStep) {
  const FilterImage step = depth_step(100, 60, 0.2f, 0);
  const BilateralOptions options{.sigma_s_px = 8};
  const auto at_background = [&](const std::optional<DepthGuide>& depth) {
    return static_cast<double>(filter(step.value, options, depth).at(50, 30));
  };
  const auto at_foreground = [&](const std::optional<DepthGuide>& depth) {
    return static_cast<double>(filter(step.value, options, depth).at(49, 30));
  };
  const DepthGuide two{&step.disparity, 0.5, DepthSide::kTwoSided};
  const DepthGuide one{&step.disparity, 0.5, DepthSide::kBackgroundTakesNothingFromForeground};
  EXPECT_GT(at_background(std::nullopt), 0.08);
  EXPECT_NEAR(at_background(two), 0, 1e-6);
  EXPECT_NEAR(at_background(one), 0, 1e-6);
  EXPECT_NEAR(at_foreground(two), 0.2, 1e-6);
  EXPECT_NEAR(at_foreground(one), at_foreground(std::nullopt), 1e-4);
}

}  // namespace
}  // namespace plenolab
