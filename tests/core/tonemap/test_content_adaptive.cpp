#include "core/tonemap/content_adaptive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/tonemap/pq_operator.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

/// Most pixels near 1 and near 100 cd/m², some over four decades in between and beyond.
Plane<float> spiky(int size = 64) {
  Plane<float> image(size, size);
  for (std::size_t i = 0; i < image.size(); ++i) {
    RandomStream random(1, 2, i);
    const double kind = random.next_double(), where = random.next_double();
    const double log10 = kind < 0.4 ? 0.02 * where : kind < 0.8 ? 2 + 0.02 * where : -1 + 4 * where;
    image.pixels()[i] = static_cast<float>(std::pow(10, log10));
  }
  return image;
}

float largest(const Plane<float>& image) {
  return *std::max_element(image.pixels().begin(), image.pixels().end());
}

ContentAdaptiveCurve curve_of(const Plane<float>& image, const ContentAdaptiveOptions& options = {}) {
  return fit_curve(options, measure_pq_histogram(image, static_cast<double>(largest(image))));
}

double photographic(double luminance, const PqHistogram& histogram) {
  const double s = 0.18 * luminance / std::pow(10, histogram.log_average());
  return std::pow(s / (1 + s), 1 / 2.2);
}

TEST(PqSignal, HasTheStandardsValuesAndGoesOnBeyondThem) {
  EXPECT_NEAR(pq_signal(100), 0.508078, 1e-6);
  EXPECT_NEAR(pq_signal(1e4), 1, 1e-12);
  EXPECT_NEAR(pq_signal(1e9), 1.776, 1e-3);
  for (const double l : {0.001, 1.0, 300.0, 1e4, 1e9}) EXPECT_NEAR(pq_luminance(pq_signal(l)) / l, 1, 1e-8);
  EXPECT_EQ(pq_luminance(0), 0);
}

TEST(SplitByEntropy, PartsFewFromMany) {
  std::vector<std::int64_t> counts{1, 2, 1000, 3, 2, 1100, 1, 0, 900};
  const BinSplit split = split_by_entropy(counts);
  EXPECT_EQ(split.heavy, (std::vector<bool>{false, false, true, false, false, true, false, false, true}));
  EXPECT_EQ(split.heavy_count, 3);
}

TEST(SplitByEntropy, OfOneOccupiedBinOrNoneHasNoHeavyBin) {
  EXPECT_EQ(split_by_entropy({0, 0, 5, 0}).heavy_count, 0);
  EXPECT_EQ(split_by_entropy({0, 0, 0}).heavy_count, 0);
  EXPECT_EQ(split_by_entropy({9}).heavy_count, 0);
  EXPECT_EQ(split_by_entropy({}).heavy_count, 0);
  EXPECT_EQ(split_by_entropy({0, 1, 9}).heavy, (std::vector<bool>{false, false, true}));
}

TEST(SplitByEntropy, IsTheMaximumOfAllCutsTriedLiterally) {
  std::vector<std::int64_t> counts;
  for (std::uint64_t i = 0; i < 40; ++i)
    counts.push_back(static_cast<std::int64_t>(std::pow(10, 4 * unit_double(random_u64(5, 6, i)))));
  const auto part_entropy = [](std::vector<double> part) {
    const double sum = std::accumulate(part.begin(), part.end(), 0.0);
    double h = 0;
    for (const double n : part) h -= n / sum * std::log(n / sum);
    return h;
  };
  std::vector<double> sorted(counts.begin(), counts.end());
  std::sort(sorted.begin(), sorted.end());
  double best = -1, threshold = 0;
  for (auto cut = sorted.begin() + 1; cut != sorted.end(); ++cut) {
    const double h = part_entropy({sorted.begin(), cut}) + part_entropy({cut, sorted.end()});
    if (h > best) best = h, threshold = *(cut - 1);
  }
  const BinSplit split = split_by_entropy(counts);
  for (std::size_t i = 0; i < counts.size(); ++i)
    EXPECT_EQ(split.heavy[i], static_cast<double>(counts[i]) > threshold) << i;
}

TEST(ContentAdaptive, ConservesTheRangeOfThePhotographicCurve) {
  const Plane<float> image = spiky();
  const PqHistogram histogram = measure_pq_histogram(image, static_cast<double>(largest(image)));
  const ContentAdaptiveCurve curve = fit_curve({}, histogram);
  EXPECT_TRUE(curve.plain.empty());
  EXPECT_NEAR(curve.luma.back(), photographic(pq_luminance(histogram.signal_max), histogram), 1e-5);
  EXPECT_TRUE(std::is_sorted(curve.luma.begin(), curve.luma.end()));
  EXPECT_EQ(curve.luma.front(), 0);
}

TEST(ContentAdaptive, GivesSlopeToWherePixelsAre) {
  const Plane<float> image = spiky();
  const PqHistogram histogram = measure_pq_histogram(image, static_cast<double>(largest(image)));
  const ContentAdaptiveCurve curve = fit_curve({}, histogram);
  const auto rise = [&](double from, double to) {
    return static_cast<double>(curve.at(to) - curve.at(from));
  };
  const auto plain = [&](double from, double to) {
    return photographic(to, histogram) - photographic(from, histogram);
  };
  EXPECT_GT(rise(0.98, 1.07), 2 * plain(0.98, 1.07));
  EXPECT_LT(rise(5, 50), plain(5, 50));
}

TEST(ContentAdaptive, OfOneLuminanceOrAFlatHistogramIsPhotographic) {
  const Plane<float> even(20, 20, 30);
  const PqHistogram one = measure_pq_histogram(even, 30);
  EXPECT_EQ(fit_curve({}, one).plain, "all luminances lie in one bin");
  EXPECT_NEAR(fit_curve({}, one).at(30), photographic(30, one), 1e-4);
  PqHistogram flat;
  flat.counts.assign(PqHistogram::kBins, 7);
  flat.positive = 1;
  EXPECT_EQ(fit_curve({}, flat).plain, "no bin stands out");
}

TEST(ContentAdaptive, KappaOfOneChangesLessThanKappaOfZero) {
  const Plane<float> image = spiky();
  ContentAdaptiveOptions none, all;
  none.kappa = 0;
  all.kappa = 1;
  EXPECT_GT(curve_of(image, none).largest_rise, curve_of(image, all).largest_rise);
}

TEST(ContentAdaptive, TheCapHoldsSlopesBackAndSaysSo) {
  const Plane<float> image = spiky();
  const ContentAdaptiveCurve free = curve_of(image);
  ContentAdaptiveOptions options;
  options.slope_cap = 0.5 * (1 + free.largest_rise);
  const ContentAdaptiveCurve capped = curve_of(image, options);
  EXPECT_EQ(free.capped_bins, 0);
  EXPECT_GT(capped.capped_bins, 0);
  EXPECT_LE(capped.largest_rise, *options.slope_cap * (1 + 1e-9));
  EXPECT_NEAR(capped.luma.back(), free.luma.back(), 1e-5) << "the range is still conserved";
}

TEST(ContentAdaptive, HistogramsOfPartsMergeToThatOfTheWhole) {
  const Plane<float> image = spiky(32);
  Plane<float> upper(32, 16), lower(32, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) upper.at(x, y) = image.at(x, y), lower.at(x, y) = image.at(x, y + 16);
  const PqHistogram all = measure_pq_histogram(image, 1e5);
  const PqHistogram sum = merge(measure_pq_histogram(upper, 1e5), measure_pq_histogram(lower, 1e5, 1));
  EXPECT_EQ(all.counts, sum.counts);
  EXPECT_NEAR(all.log_average(), sum.log_average(), 1e-12);
}

TEST(ContentAdaptive, StaysInRangeForEveryLuminance) {
  for (const float level : {1e-30f, 1e-6f, 1.0f, 1e9f, 1e30f}) {
    Plane<float> image = spiky(16);
    for (float& v : image.pixels()) v *= level;
    const ContentAdaptiveCurve curve = curve_of(image);
    for (const double l : {0.0, 1e-9, 1.0, 1e9, 1e35}) {
      EXPECT_GE(curve.at(l), 0) << level;
      EXPECT_LE(curve.at(l), 1.0001f) << level;
    }
  }
}

TEST(ContentAdaptive, AConstantImageIsAsLightAtAnyLuminance) {
  for (const float level : {1e-3f, 1.0f, 1e6f, 1e12f, 1e15f, 1e30f, 3e38f})
    EXPECT_NEAR(curve_of(Plane<float>(16, 16, level)).at(static_cast<double>(level)), 0.425f, 0.03f) << level;
}

TEST(ContentAdaptiveOptions, SayWhatIsOutOfRange) {
  const auto message = [](auto change) {
    ContentAdaptiveOptions options;
    change(options);
    return message_of([&] { options.validate(); });
  };
  EXPECT_NE(message([](auto& o) { o.key = 0; }).find("key"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.kappa = 2; }).find("kappa"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.slope_cap = 0.5; }).find("slope cap"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.cd_m2_per_unit = 0; }).find("radiance 1"), std::string::npos);
}

}  // namespace
}  // namespace plenolab
