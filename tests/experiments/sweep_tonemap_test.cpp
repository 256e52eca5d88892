#include "experiments/sweep_tonemap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/base/random.h"
#include "core/tonemap/light_field_mapping.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {

/// Values of a quantity in the order of the settings.
std::vector<double> values_of(const ResultTable& rows, const std::string& quantity) {
  std::vector<double> values;
  for (const ResultRow& row : rows.rows())
    if (row.quantity == quantity) values.push_back(row.value);
  return values;
}

/// A noisy step in luminance and depth.
SweepImage step_image() {
  constexpr int kWidth = 160, kHeight = 90;
  auto colour = std::make_shared<SceneImage>(kWidth, kHeight);
  auto disparity = std::make_shared<DisparityMap>(kWidth, kHeight, 1.0f);
  RandomStream random(1, 2, 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float light = (x < kWidth / 2 ? 0.01f : 100.0f) * (0.5f + random.next_float());
      colour->at(x, y) = Rgb{1, 0.8f, 0.6f} * light;
      if (x >= kWidth / 2) disparity->at(x, y) = 6;
    }
  return {"step", {colour, disparity}};
}

TEST(ToneSweeps, FinerGridsAreNearerToTheExactFilter) {
  const std::vector<GridSampling> samplings{{.per_sigma_s = 1, .per_sigma_value = 2},
                                            {.per_sigma_s = 3, .per_sigma_value = 6}};
  const ResultTable rows = sweep_bilateral(step_image(), samplings, {.runs = 1, .threads = 2});
  const std::vector<double> errors = values_of(rows, "rms_error");
  ASSERT_GE(errors.size(), 2u);
  EXPECT_EQ(errors.front(), 0);  // the exact filter
  const std::vector<double> largest = values_of(rows, "max_error");
  for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_LE(errors[i], largest[i]);
  std::map<double, double> naive;
  for (const ResultRow& row : rows.rows()) {
    const std::map<std::string, Cell> columns(row.columns.begin(), row.columns.end());
    if (row.quantity == "rms_error" && std::get<std::string>(columns.at("filter")) == "naive")
      naive[std::get<double>(columns.at("per_sigma_s"))] = row.value;
  }
  EXPECT_FALSE(plot_sweep(rows, bilateral_sweep_plot()).series.empty());
  ASSERT_TRUE(naive.contains(1) && naive.contains(3));
  EXPECT_GT(naive.at(3), 0);
  EXPECT_LT(naive.at(3), naive.at(1));
}

TEST(ToneSweeps, MoreBinsAreNearerToTheFinestHistogram) {
  const ResultTable rows = sweep_histogram(step_image(), {4, 256, 65536}, {.runs = 1, .threads = 2});
  const std::vector<double> errors = values_of(rows, "rms_error");
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_GT(errors[0], errors[1]);
  EXPECT_EQ(errors[2], 0);
  EXPECT_EQ(values_of(rows, "seconds_median").size(), 3u);
}

TEST(ToneSweeps, AdjustmentOverTheWholeGridHasNoErrorAndDrawsNeighboursTogether) {
  const LightField field = plane_field(3);
  const OperatorChoice choice = choose_operator({.name = "reinhard05", .variant = "", .settings = {}});
  const ResultTable rows = sweep_adjustment(field, "plane", choice, {{2, 0}, {2, 1}, {2, 3}}, {.runs = 1});
  const std::vector<double> errors = values_of(rows, "rms_error");
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_GT(errors[0], 0);
  EXPECT_EQ(errors[2], 0);
  const std::vector<double> between = values_of(rows, "neighbour_difference");
  const std::vector<double> before = values_of(rows, "neighbour_difference_before");
  EXPECT_NEAR(between[0], before[0], 1e-6);
  EXPECT_LT(between[2], before[2]);
  const std::vector<double> found = values_of(rows, "correspondences_per_pixel");
  EXPECT_EQ(found[0], 0);
  EXPECT_GT(found[2], found[1]);
}

TEST(ToneSweeps, AdjustmentSettingsEndWithTheWholeGrid) {
  const std::vector<AdjustmentSetting> settings = all_adjustment_settings({.columns = 5, .rows = 3});
  EXPECT_EQ(settings.back().support_views, 5);
  EXPECT_TRUE(std::all_of(settings.begin(), settings.end(),
                          [](const AdjustmentSetting& s) { return s.support_views <= 5; }));
}

}  // namespace
}  // namespace plenolab
