#include <gtest/gtest.h>

#include "core/tonemap/filters/bilateral_filter.h"
#include "core/tonemap/filters/bilateral_grid.h"
#include "core/tonemap/filters/grid_layout.h"
#include "tests/core/tonemap/filters/filter_images.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

const BilateralOptions kOptions{.sigma_s_px = 10, .sigma_value = 0.4};

std::vector<std::optional<DepthGuide>> guides(const DisparityMap& disparity) {
  return {std::nullopt, DepthGuide{&disparity, 0.5, DepthSide::kTwoSided},
          DepthGuide{&disparity, 0.5, DepthSide::kBackgroundTakesNothingFromForeground}};
}

Difference error_of(const FilterImage& image, const std::optional<DepthGuide>& depth,
                    const GridSampling& sampling) {
  const Plane<float> fast = filter_by_grid({image.value, image.value, kOptions, depth, 1}, sampling).value();
  return difference(fast, bilateral_exact(image.value, kOptions, depth));
}

// The goal of the product version is a mean below 0.01 and a maximum below 0.05.
TEST(BilateralGrid, ErrorsAgainstTheExactFilterAreBounded) {
  const FilterImage image = discs_before_ground(180, 110);
  for (const auto& depth : guides(image.disparity)) {
    const Difference error = error_of(image, depth, {});
    EXPECT_LT(error.mean, 0.002);
    EXPECT_LT(error.max, 0.03);
    EXPECT_GT(error.max, 0);
  }
}

TEST(BilateralGrid, FinerSamplingIsNearerToTheExactFilter) {
  const FilterImage image = discs_before_ground(140, 90);
  for (const auto& depth : guides(image.disparity)) {
    const double coarse = error_of(image, depth, {1.5, 2, 1.5}).mean,
                 normal = error_of(image, depth, {3, 4, 2}).mean,
                 fine = error_of(image, depth, {8, 10, 4}).mean;
    EXPECT_LT(2 * normal, coarse);
    EXPECT_LT(1.5 * fine, normal);
  }
}

TEST(BilateralGrid, CrossFilterKeepsItsErrorWithAnUnrelatedRange) {
  const FilterImage image = discs_before_ground(150, 80);
  Plane<float> value(150, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 150; ++x)
      value.at(x, y) = static_cast<float>(1 + 0.5 * std::sin(0.08 * x + 0.05 * y));
  const std::optional<DepthGuide> depth = DepthGuide{&image.disparity};
  const Plane<float> fast = filter_by_grid({value, image.value, kOptions, depth, 1}, {}).value();
  EXPECT_LT(difference(fast, cross_bilateral_exact(value, image.value, kOptions, depth)).max, 0.02);
}

TEST(BilateralGrid, OnlyLayersWithPixelsExist) {
  const FilterImage step = depth_step(90, 60, 1, 0);
  const std::optional<DepthGuide> depth = DepthGuide{&step.disparity};
  const BilateralInput input{step.value, step.value, kOptions, depth, 1};
  const GridLayout layout = make_layout(input, make_axes(input, {}));
  for (int row = 0; row < layout.rows; ++row) {
    EXPECT_EQ(layout.cell(0, row).size(), 1u);
    EXPECT_EQ(layout.cell(0, row)[0].layer, 28);  // 7 px at four layers a pixel
    EXPECT_EQ(layout.cell(layout.columns - 1, row)[0].layer, 0);
    EXPECT_EQ(layout.cell(18, row).size(), 2u);  // at the step
  }
  EXPECT_EQ(find_block(layout.cell(0, 0), 0), nullptr);
  EXPECT_EQ(find_block(layout.cell(0, 0), 28), &layout.cell(0, 0)[0]);
}

TEST(BilateralGrid, SmallWindowsAndGridsBeyondMemoryAreLeftToTheExactFilter) {
  const FilterImage image = discs_before_ground(64, 48);
  const BilateralOptions small{.sigma_s_px = 2}, fine{.sigma_s_px = 20, .sigma_value = 1e-8};
  for (const BilateralOptions& options : {small, fine}) {
    EXPECT_EQ(filter_by_grid({image.value, image.value, options, std::nullopt, 1}, {}), std::nullopt);
    EXPECT_EQ(bilateral_fast(image.value, options), bilateral_exact(image.value, options));
  }
  const BilateralOptions wide{.sigma_s_px = 20};
  const std::optional<DepthGuide> sharp = DepthGuide{&image.disparity, 1e-8};
  EXPECT_EQ(filter_by_grid({image.value, image.value, wide, sharp, 1}, {}), std::nullopt);
}

TEST(BilateralGrid, SamplingIsChecked) {
  const FilterImage image = discs_before_ground(20, 20);
  const std::optional<DepthGuide> none;
  EXPECT_EQ(message_of([&] {
              filter_by_grid({image.value, image.value, kOptions, none, 1}, {.per_sigma_s = 0.5});
            }),
            "the bilateral grid needs 1 to 64 samples per sigma, not 0.5");
}

}  // namespace
}  // namespace plenolab
