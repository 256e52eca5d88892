#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/tonemap/histogram_adjustment.h"
#include "core/tonemap/statistics.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

LogHistogram histogram_of(const SceneImage& image, int bins) {
  const ViewStatistics s = measure_view(image);
  const double floor = log_floor(s);
  const ImageStatistics e = evaluate(s, floor);
  return measure_histogram(image, floor, e.log_min, e.log_max, bins);
}

HistogramParameters fit_to(const HistogramOptions& options, const SceneImage& image) {
  return fit(options, histogram_of(image, options.bins), log_floor(measure_view(image)));
}

/// A dark room of 4 decades with a bright window of two: 90 % of the pixels dark.
SceneImage room(double scale = 1) {
  return grey_image(100, 100, [scale](int x, int y) {
    const double t = unit_double(random_u64(3, 1, static_cast<std::uint64_t>(100 * y + x)));
    return static_cast<float>(scale *
                              (x < 90 ? std::pow(10.0, -1 + 1.5 * t * t) : std::pow(10.0, 2 + 2 * t)));
  });
}

double steepest(const HistogramParameters& p) {
  double most = 0;
  for (std::size_t b = 0; b + 1 < p.cumulative.size(); ++b)
    most = std::max(most, p.cumulative[b + 1] - p.cumulative[b]);
  const double bin = (p.log_max - p.log_min) / static_cast<double>(p.cumulative.size() - 1);
  return most * (p.log_display_max - p.log_display_min) / bin;
}

TEST(JustNoticeableDifference, IsContinuousWithinThreePercentAndRises) {
  for (const double joint : {1.148e-4, std::pow(10, -1.44), std::pow(10, -0.0184), std::pow(10, 1.9)}) {
    const double below = just_noticeable_difference_cd_m2(joint * (1 - 1e-9));
    const double above = just_noticeable_difference_cd_m2(joint * (1 + 1e-9));
    EXPECT_NEAR(above / below, 1, 0.03) << joint;
  }
  EXPECT_NEAR(just_noticeable_difference_cd_m2(100) / 100, std::pow(10, -1.255), 1e-12);  // Weber
  EXPECT_EQ(just_noticeable_difference_cd_m2(0), 1.38e-3);
  for (double t = -6; t < 6; t += 0.05)
    EXPECT_GE(just_noticeable_difference_cd_m2(std::pow(10, t + 0.05)),
              just_noticeable_difference_cd_m2(std::pow(10, t)) * 0.97);
}

TEST(HistogramAdjustment, CountsEveryPixelWithTheLargestInTheLastBin) {
  const SceneImage image =
      grey_image(5, 1, [](int x, int) { return x == 0 ? 0.0f : std::pow(10.0f, static_cast<float>(x)); });
  const LogHistogram h = measure_histogram(image, 1.0, 0, 4, 8);
  EXPECT_EQ(h.counts, (std::vector<double>{1, 0, 1, 0, 1, 0, 1, 1}));
  EXPECT_EQ(merge(h, h).counts[7], 2);
  const SceneImage flat(3, 3, Rgb{5, 5, 5});
  EXPECT_EQ(histogram_of(flat, 4).counts, (std::vector<double>{0, 0, 0, 9}));
}

TEST(HistogramAdjustment, KeepsTheScenesLuminanceWhereItsRangeFitsTheDisplay) {
  const SceneImage image =
      grey_image(30, 2, [](int x, int) { return 300.0f * std::pow(10.0f, -0.1f * static_cast<float>(x)); });
  for (const HistogramCeiling ceiling :
       {HistogramCeiling::kPerceptual, HistogramCeiling::kLinear, HistogramCeiling::kAsPrinted}) {
    const HistogramParameters p = fit_to({.ceiling = ceiling}, image);
    EXPECT_TRUE(p.linear);
    EXPECT_FALSE(p.linear_because.empty());
    for (double log = -0.4; log < 2.45; log += 0.1) EXPECT_NEAR(display_log_luminance(p, log), log, 1e-6);
  }
}

TEST(HistogramAdjustment, LinearCeilingNeverExceedsTheContrastOfTheScene) {
  const HistogramOptions options{.ceiling = HistogramCeiling::kLinear, .bins = 256};
  const HistogramParameters p = fit_to(options, room());
  ASSERT_FALSE(p.linear);
  ASSERT_GT(p.passes.size(), 1u);
  EXPECT_GT(p.passes.front().trimmed, 0);
  // The last pass cuts to the ceiling of its total, of which it leaves the rest.
  const TrimmingPass& last = p.passes.back();
  EXPECT_LE(last.trimmed, 0.025 * p.passes.front().total);
  EXPECT_LE(steepest(p), last.total / (last.total - last.trimmed) * (1 + 1e-9));
  EXPECT_GT(steepest(fit_to({.ceiling = HistogramCeiling::kLinear, .bins = 256, .fixed_passes = 0}, room())),
            1.2);
}

TEST(HistogramAdjustment, MappingRisesOverTheWholeDisplayRange) {
  for (const HistogramCeiling ceiling : {HistogramCeiling::kPerceptual, HistogramCeiling::kLinear}) {
    const HistogramParameters p = fit_to({.ceiling = ceiling}, room());
    ASSERT_FALSE(p.linear);
    double before = -10;
    for (double log = p.log_min - 0.1; log <= p.log_max + 0.1; log += 0.001) {
      const double now = display_log_luminance(p, log);
      EXPECT_GE(now, before);
      before = now;
    }
    EXPECT_NEAR(display_log_luminance(p, p.log_min), std::log10(0.3), 1e-12);
    EXPECT_NEAR(display_log_luminance(p, p.log_max), std::log10(300), 1e-12);
  }
}

TEST(HistogramAdjustment, WithoutTrimmingEqualisesTheHistogram) {
  const SceneImage image = room();
  const HistogramParameters p = fit_to({.bins = 64, .fixed_passes = 0}, image);
  const LogHistogram h = histogram_of(image, 64);
  EXPECT_TRUE(p.passes.empty());
  const double first_ten = std::accumulate(h.counts.begin(), h.counts.begin() + 10, 0.0) / 1e4;
  EXPECT_NEAR(p.cumulative[10], first_ten, 1e-12);
}

TEST(HistogramAdjustment, ThePrintedCeilingTrimsMoreThanTheRightOne) {
  // Ranges above the display's make the printed ratio smaller than the right one by (display / range)².
  for (const auto& [right, printed] :
       {std::pair{HistogramCeiling::kLinear, HistogramCeiling::kLinearAsPrinted},
        std::pair{HistogramCeiling::kPerceptual, HistogramCeiling::kAsPrinted}}) {
    const HistogramParameters a = fit_to({.ceiling = right, .fixed_passes = 1}, room());
    const HistogramParameters b = fit_to({.ceiling = printed, .fixed_passes = 1}, room());
    ASSERT_EQ(a.passes.size(), 1u);
    EXPECT_GT(b.passes[0].trimmed, a.passes[0].trimmed);
  }
}

TEST(HistogramAdjustment, DarkScenesAreTrimmedMoreWhenVisibilityCounts) {
  const SceneImage dark = room(1e-3);
  const HistogramParameters linear = fit_to({.ceiling = HistogramCeiling::kLinear, .fixed_passes = 1}, dark);
  const HistogramParameters visible = fit_to({.fixed_passes = 1}, dark);
  EXPECT_GT(visible.passes[0].trimmed, 1.5 * linear.passes[0].trimmed);
  const HistogramParameters bright = fit_to({.fixed_passes = 1}, room(1e3));
  EXPECT_GT(visible.passes[0].trimmed, bright.passes[0].trimmed);
}

TEST(HistogramAdjustment, FixedNumbersOfPassesAreKept) {
  for (const int passes : {0, 1, 4, 9})
    EXPECT_EQ(fit_to({.ceiling = HistogramCeiling::kLinear, .fixed_passes = passes}, room()).passes.size(),
              static_cast<std::size_t>(passes));
}

TEST(HistogramAdjustment, FewLevelsFarApartAreMappedLinearlyWithCountsOfWhatIsTooDark) {
  SceneImage image(10, 1, Rgb{1e-3f, 1e-3f, 1e-3f});
  image.at(9, 0) = {1e3f, 1e3f, 1e3f};
  const HistogramParameters p = fit_to({}, image);
  EXPECT_TRUE(p.linear);
  const ToneMapped mapped = apply(p, image);
  EXPECT_EQ(mapped.counts.clipped_low, 9);
  EXPECT_EQ(mapped.counts.clipped_high, 0);
  EXPECT_NEAR(mapped.image.at(9, 0).g, 1, 1e-5);
}

TEST(HistogramAdjustment, MappingTendsToTheLinearOneAsTheRangeShrinksToTheDisplays) {
  const auto ramp = [](double decades) {
    return grey_image(4000, 1, [decades](int x, int) {
      return static_cast<float>(50 * std::pow(10.0, -decades * x / 3999));
    });
  };
  const HistogramParameters inside = fit_to({.ceiling = HistogramCeiling::kLinear, .bins = 64}, ramp(2.999));
  const HistogramParameters outside = fit_to({.ceiling = HistogramCeiling::kLinear, .bins = 64}, ramp(3.001));
  EXPECT_TRUE(inside.linear);
  EXPECT_FALSE(outside.linear);
  for (double log = -1.2; log < 1.7; log += 0.1)
    EXPECT_NEAR(display_log_luminance(inside, log), display_log_luminance(outside, log), 0.06);
}

TEST(HistogramAdjustment, LumaIsTheShareOfTheDisplayRangeEncodedByGamma) {
  const SceneImage image = room();
  const HistogramParameters p = fit_to({}, image);
  const DisplayImage out = apply(p, image).image;
  for (const int x : {3, 50, 95}) {
    const double display =
        std::pow(10, display_log_luminance(p, std::log10(static_cast<double>(image.at(x, 7).g))));
    EXPECT_NEAR(out.at(x, 7).g, std::pow((display - 0.3) / 299.7, 1 / 2.2), 2e-4);
  }
}

TEST(HistogramAdjustment, OptionsOutOfRangeAreErrors) {
  EXPECT_THROW((HistogramOptions{.bins = 1}.validate()), InputError);
  EXPECT_THROW((HistogramOptions{.tolerance = 0}.validate()), InputError);
  EXPECT_THROW((HistogramOptions{.fixed_passes = -1}.validate()), InputError);
  EXPECT_THROW((HistogramOptions{.display_max_cd_m2 = 0.1}.validate()), InputError);
  EXPECT_THROW((HistogramOptions{.colour_exponent = 2}.validate()), InputError);
  EXPECT_THROW((HistogramOptions{.cd_m2_per_unit = 0}.validate()), InputError);
}

}  // namespace
}  // namespace plenolab
