#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "experiments/reproduce/tonemap/curves.h"
#include "experiments/reproduce/tonemap/edge_profile.h"
#include "experiments/reproduce/tonemap/trimming.h"
#include "experiments/tonemap_layers.h"

namespace plenolab {
namespace {

TEST(SteepestPlace, OfAParabolaOverLogLuminanceIsItsFarEnd) {
  const auto steepest =
      steepest_place(log_spaced(1, 100, 21), [](double x) { return std::log10(x) * std::log10(x); });
  EXPECT_NEAR(steepest.x, 100, 1e-9);
  EXPECT_NEAR(steepest.slope, 4, 1e-6);
}

TEST(LogSpaced, HoldsBothEndsAtEqualRatios) {
  const auto x = log_spaced(0.01, 100, 5);
  ASSERT_EQ(x.size(), 5u);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(std::log10(x[i]), static_cast<double>(i) - 2, 1e-12);
}

TEST(TraceEdge, KeepsMostWithTheNaiveOperatorLeastWithoutForegroundLayer) {
  const EdgeProfile naive = trace_edge(EdgeOperator::kNaive);
  const EdgeProfile without = trace_edge(EdgeOperator::kWithoutForeground);
  const EdgeProfile enhanced = trace_edge(EdgeOperator::kEnhanced);
  EXPECT_NEAR(naive.input_step(), kEdgeStep_log10, 1e-6);
  EXPECT_GT(naive.target_step(), enhanced.target_step());
  EXPECT_GT(enhanced.target_step(), without.target_step());
  EXPECT_NEAR(without.target_step(), without.target_level(), 1e-6);
  EXPECT_LT(naive.background_profile(), -0.01);
  EXPECT_NEAR(enhanced.background_profile(), 0, 1e-5);
}

TEST(TraceEdge, TemporaryLayerIsTheNaiveBaseOnTheForegroundOnly) {
  const EdgeProfile naive = trace_edge(EdgeOperator::kNaive), enhanced = trace_edge(EdgeOperator::kEnhanced);
  EXPECT_NEAR(enhanced.temporary[kEdgeWidth_px / 2 - 1], naive.base[kEdgeWidth_px / 2 - 1], 1e-5);
  EXPECT_NEAR(enhanced.temporary[kEdgeWidth_px / 2], enhanced.base[kEdgeWidth_px / 2], 1e-5);
  EXPECT_TRUE(naive.temporary.empty());
}

/// Six decades with half of the pixels in one bin.
LogHistogram spiked(int bins) {
  LogHistogram histogram{-3, 3, std::vector<double>(static_cast<std::size_t>(bins), 1)};
  histogram.counts[static_cast<std::size_t>(bins / 2)] = bins;
  return histogram;
}

TEST(LogTrimming, SlopesFallAndSharesLeftAreThoseOfTheLastPass) {
  const HistogramOptions options{.ceiling = HistogramCeiling::kLinear, .bins = 128};
  const TrimmingLog log = log_trimming(options, spiked(128), 1e-3);
  ASSERT_FALSE(log.passes.empty());
  ASSERT_TRUE(log.trimmed);
  EXPECT_LT(log.passes.back().largest_slope, log.slope_before);
  const double left = std::accumulate(log.trimmed->counts.begin(), log.trimmed->counts.end(), 0.0);
  EXPECT_NEAR(left, log.left_share(), 1e-9);
  EXPECT_LT(left, 1);
}

TEST(LogTrimming, OfARangeThatFitsTheDisplayHasNoPass) {
  const HistogramOptions options{.bins = 4};
  const TrimmingLog log = log_trimming(options, {0, 1, {1, 2, 3, 4}}, 1);
  EXPECT_TRUE(log.passes.empty());
  EXPECT_FALSE(log.trimmed);
  EXPECT_FALSE(log.linear_because.empty());
  EXPECT_EQ(log.left_share(), 1);
}

TEST(Resample, KeepsTheSumAndTheOrder) {
  const std::vector<double> fine{1, 2, 3, 4, 5, 6, 7};
  const std::vector<double> coarse = resample(fine, 3);
  EXPECT_EQ(std::accumulate(coarse.begin(), coarse.end(), 0.0), 28);
  EXPECT_LT(coarse[0], coarse[2]);
  EXPECT_EQ(resample(fine, 7), fine);
}

TEST(PictureLayers, ShowNoDetailAsMiddleGreyAndTheRangeOfTheBaseAsBlackToWhite) {
  BilateralLayers layers{Plane<float>(2, 1), Plane<float>(2, 1), {}};
  layers.base.at(1, 0) = 3;
  layers.log_luminance.at(1, 0) = 3.5f;
  const LayerPictures shown = picture_layers(layers);
  ASSERT_EQ(shown.pictures.size(), 2u);
  EXPECT_EQ(shown.pictures[0].image.at(0, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(shown.pictures[0].image.at(1, 0), (Rgb{1, 1, 1}));
  EXPECT_FLOAT_EQ(shown.pictures[1].image.at(0, 0).r, 0.5f);
  EXPECT_TRUE(temporary_layer(layers).empty());
}

}  // namespace
}  // namespace plenolab
