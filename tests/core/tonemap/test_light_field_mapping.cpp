#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/tonemap/light_field_mapping.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

/// 3 × 2 views; the one at (2, 1) sees a light.
LightField lit_field() {
  ViewGrid grid{.columns = 3, .rows = 2, .width = 20, .height = 12};
  std::vector<KeyView<SceneReferred>> views;
  for (int i = 0; i < 6; ++i) {
    views.push_back({random_scene(20, 12, 2, 10 + i), DisparityMap(20, 12, 2.0f)});
    for (int x = 0; x < 10; ++x) views.back().disparity.at(x, 6) = 8;
  }
  for (int x = 0; x < 6; ++x) views[5].colour.at(x, 1) = {1e5f, 1e5f, 1e5f};
  return LightField::from_views(grid, RadianceUnit::kCdM2, "lit", std::move(views));
}

TEST(LightFieldMapping, StatisticsAreThoseOfTheViewsTogetherWithTheSmallestLuminanceAsFloor) {
  const LightField field = lit_field();
  const LightFieldStatistics s = measure_light_field(field);
  ASSERT_EQ(s.views.size(), 6u);
  EXPECT_EQ(s.all.pixels, 6 * 240);
  EXPECT_EQ(s.views[5], measure_view(field.view(2, 1)->colour));
  EXPECT_EQ(s.floor, s.views[0].min_positive);
}

TEST(LightFieldMapping, RelativeRadianceHasOneScaleForAllViewsAndFrames) {
  const LightField declared = lit_field();
  EXPECT_EQ(measure_light_field(declared).scale.to_cd_m2(100), 1);
  std::vector<KeyView<SceneReferred>> views;
  for (int i = 0; i < 6; ++i) views.push_back(*declared.view(i % 3, i / 3));
  const LightField relative =
      LightField::from_views(declared.grid(), RadianceUnit::kRelative, "relative", std::move(views));
  const LightFieldStatistics s = measure_light_field(relative);
  const double factor = s.scale.to_cd_m2(100);
  EXPECT_NEAR(std::log10(factor) + evaluate(s.all, s.floor).log_robust_average, 2, 1e-12);
  EXPECT_EQ(scope_of_view(relative, s, 2, 1).scale.to_cd_m2(100), factor);
  EXPECT_EQ(scope_of_light_field(relative, s).scale.to_cd_m2(100), factor);
  FrameInput frame;
  set_key_views(s, relative.grid(), {0.5, 0.5}, frame);
  EXPECT_EQ(frame.scale.to_cd_m2(100), factor);
}

TEST(LightFieldMapping, EveryVariantMapsEveryViewOnceInOrder) {
  const LightField field = lit_field();
  const LightFieldStatistics s = measure_light_field(field);
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const OperatorVariant& variant : info.variants) {
      if (variant.scope == OperatorScope::kFrame) continue;
      std::vector<int> order;
      MappingCounts sum;
      const auto sink = [&](int column, int row, const ToneMapped& mapped, const FittedOperator& fitted) {
        order.push_back(row * 3 + column);
        sum += mapped.counts;
        EXPECT_FALSE(fitted.values.empty());
        EXPECT_EQ(mapped.image, fitted.apply(operator_view(field, column, row), 1).image);
      };
      EXPECT_EQ(map_light_field(info, variant.id, {}, field, s, sink), sum) << info.id << " " << variant.id;
      EXPECT_EQ(order, (std::vector{0, 1, 2, 3, 4, 5}));
    }
}

TEST(LightFieldMapping, NaiveFitsDifferBetweenViewsAndJointOnesDoNot) {
  const LightField field = lit_field();
  const LightFieldStatistics s = measure_light_field(field);
  const auto contrasts = [&](const char* variant) {
    std::vector<double> m;
    map_light_field(
        find_operator("reinhard05"), variant, {}, field, s,
        [&](int, int, const ToneMapped&, const FittedOperator& f) { m.push_back(f.values.at(0).value); });
    return m;
  };
  EXPECT_GT(std::abs(contrasts("naive")[5] - contrasts("naive")[0]), 0.1);
  EXPECT_EQ(contrasts("joint")[5], contrasts("joint")[0]);
}

TEST(LightFieldMapping, FramesGetTheNearestKeyViewsWithBilinearWeights) {
  const LightField field = lit_field();
  const LightFieldStatistics s = measure_light_field(field);
  FrameInput frame;
  set_key_views(s, field.grid(), {1.25, 0.5}, frame);
  ASSERT_EQ(frame.key_views.size(), 4u);
  ImageStatistics expected = blend(std::vector{s.of_view(1), s.of_view(2), s.of_view(4), s.of_view(5)},
                                   std::vector{0.375, 0.125, 0.375, 0.125});
  EXPECT_NEAR(blend(frame.key_views, frame.weights).log_average, expected.log_average, 1e-12);
  set_key_views(s, field.grid(), {2, 1}, frame);
  ASSERT_EQ(frame.key_views.size(), 1u);
  EXPECT_EQ(frame.key_views[0], s.of_view(5));
  EXPECT_THROW(set_key_views(s, field.grid(), {2.5, 1}, frame), InputError);
}

TEST(LightFieldMapping, VideoVariantsOfKeyViewsAreErrors) {
  const LightField field = lit_field();
  EXPECT_THROW(map_light_field(find_operator("robust"), "interpolate-statistics", {}, field,
                               measure_light_field(field), {}),
               InputError);
}

}  // namespace
}  // namespace plenolab
