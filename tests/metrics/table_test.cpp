#include "metrics/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/colour.h"
#include "metrics/ssim.h"
#include "tests/support/message_of.h"

namespace plenolab {

/// How the test runner prints the parameter.
static void PrintTo(const Metric& metric, std::ostream* stream) {
  *stream << metric.name;
}

namespace {

constexpr std::uint64_t kSeed = 7;

/// Smooth bands with a fine texture, in (0, 1].
SceneImage textured(int width, int height) {
  SceneImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float band =
          0.5f + 0.3f * std::sin(0.35f * static_cast<float>(x)) * std::cos(0.27f * static_cast<float>(y));
      image.at(x, y) = {band, 0.8f * band, 0.1f + 0.6f * band};
    }
  }
  return image;
}

SceneImage with_noise(const SceneImage& image, float amplitude) {
  SceneImage noisy = image;
  RandomStream random(kSeed, 1, 0);
  for (Rgb& c : noisy.pixels()) {
    const auto shake = [&](float v) { return std::max(0.0f, v + amplitude * (random.next_float() - 0.5f)); };
    c = {shake(c.r), shake(c.g), shake(c.b)};
  }
  return noisy;
}

/// Mean of horizontal neighbours, `times` over.
SceneImage blurred(SceneImage image, int times) {
  for (int n = 0; n < times; ++n) {
    const SceneImage from = image;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 1; x + 1 < image.width(); ++x) {
        image.at(x, y) = (from.at(x - 1, y) + from.at(x, y) + from.at(x + 1, y)) * (1.0f / 3);
      }
    }
  }
  return image;
}

/// Encoded, with NaN and infinity left as they are.
DisplayImage as_display(const SceneImage& image) {
  DisplayImage display = expose(image, 1);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb c = image.pixels()[i];
    if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b)) display.pixels()[i] = c;
  }
  return display;
}

/// Runs the metric on scene images, or on what it takes of them: the test image as mapped by exposure 1.
std::vector<Measurement> run(const Metric& metric, const SceneImage& test, const SceneImage& reference,
                             const ComparisonConditions& conditions) {
  if (metric.compare_scene) return metric.compare_scene(test, reference, conditions);
  if (metric.compare_mapped) return metric.compare_mapped(as_display(test), reference, conditions);
  return metric.judge(as_display(test), conditions);
}

/// Everything that a metric takes, of the same two images.
std::vector<std::vector<Measurement>> run_all(const Metric& metric, const SceneImage& test,
                                              const SceneImage& reference) {
  std::vector<std::vector<Measurement>> results;
  const DisplayImage shown = as_display(test), shown_reference = as_display(reference);
  if (metric.compare_scene) results.push_back(metric.compare_scene(test, reference, {}));
  if (metric.compare_display) results.push_back(metric.compare_display(shown, shown_reference, {}));
  if (metric.compare_mapped) results.push_back(metric.compare_mapped(shown, reference, {}));
  if (metric.judge) results.push_back(metric.judge(shown, {}));
  return results;
}

/// Images with everything that numbers can do to a metric.
std::vector<SceneImage> extreme_images(int width, int height) {
  SceneImage zeros(width, height), constant(width, height, {3, 3, 3}), ramp(width, height),
      hot(width, height);
  for (std::size_t i = 0; i < ramp.size(); ++i) {
    const float v = std::pow(10.0f, -9 + 18 * static_cast<float>(i) / static_cast<float>(ramp.size()));
    ramp.pixels()[i] = {v, 0, 0.5f * v};
  }
  hot.pixels()[hot.size() / 2] = {1e9f, 1e9f, 1e9f};
  SceneImage negative(width, height, {-1e9f, 1e-9f, 0});
  SceneImage largest(width, height, {3e38f, 3e38f, 3e38f});
  return {zeros, constant, ramp, hot, negative, largest};
}

class EveryMetric : public testing::TestWithParam<Metric> {};

INSTANTIATE_TEST_SUITE_P(Table, EveryMetric, testing::ValuesIn(metrics().begin(), metrics().end()),
                         [](const auto& instance) { return instance.param.name; });

void expect_in_range(const Metric& metric, const std::vector<Measurement>& rows) {
  ASSERT_EQ(rows.size(), metric.quantities.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].quantity, metric.quantities[i].name);
    EXPECT_EQ(rows[i].unit, metric.quantities[i].unit);
    EXPECT_FALSE(std::isnan(rows[i].value)) << rows[i].quantity;
    EXPECT_GE(rows[i].value, metric.quantities[i].minimum) << rows[i].quantity;
    EXPECT_LE(rows[i].value, metric.quantities[i].maximum) << rows[i].quantity;
  }
}

void expect_identity(const Metric& metric, const std::vector<Measurement>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double expected = metric.quantities[i].identical;
    if (!std::isnan(expected)) {
      EXPECT_EQ(rows[i].value, expected) << rows[i].quantity;
    }
  }
}

bool not_better(Better better, double value, double than) {
  switch (better) {
    case Better::kHigher:
      return value <= than;
    case Better::kLower:
      return value >= than;
    default:
      return true;
  }
}

TEST_P(EveryMetric, IsDescribedInFull) {
  const Metric& metric = GetParam();
  EXPECT_FALSE(metric.summary.empty());
  EXPECT_FALSE(metric.family.empty());
  EXPECT_FALSE(metric.quantities.empty());
  EXPECT_TRUE(metric.compare_scene || metric.compare_display || metric.compare_mapped || metric.judge);
  EXPECT_TRUE(!metric.judge || !(metric.compare_scene || metric.compare_display || metric.compare_mapped));
  for (const MetricQuantity& quantity : metric.quantities) EXPECT_FALSE(quantity.meaning.empty());
}

TEST_P(EveryMetric, GivesItsIdentityValueForEqualImages) {
  const SceneImage image = textured(24, 17);
  if (GetParam().compare_scene) expect_identity(GetParam(), GetParam().compare_scene(image, image, {}));
  if (GetParam().compare_display) {
    expect_identity(GetParam(), GetParam().compare_display(as_display(image), as_display(image), {}));
  }
}

TEST_P(EveryMetric, GetsWorseWithMoreNoise) {
  const SceneImage truth = textured(40, 30);
  std::vector<Measurement> before = run(GetParam(), truth, truth, {});
  for (const float amplitude : {0.02f, 0.1f, 0.4f, 1.0f}) {
    const std::vector<Measurement> now = run(GetParam(), with_noise(truth, amplitude), truth, {});
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (!GetParam().quantities[i].monotone) continue;
      EXPECT_TRUE(not_better(GetParam().quantities[i].better, now[i].value, before[i].value))
          << now[i].quantity << " " << before[i].value << " → " << now[i].value << " at noise " << amplitude;
    }
    before = now;
  }
}

TEST_P(EveryMetric, GetsWorseWithMoreBlur) {
  const SceneImage truth = with_noise(textured(40, 30), 0.3f);
  if (!GetParam().quantities.front().monotone) GTEST_SKIP() << "worse only in the large";
  double before = run(GetParam(), truth, truth, {}).front().value;
  const Better better = GetParam().quantities.front().better;
  for (const int times : {1, 3, 9}) {
    const double now = run(GetParam(), blurred(truth, times), truth, {}).front().value;
    EXPECT_TRUE(not_better(better, now, before)) << before << " → " << now << " at " << times;
    before = now;
  }
}

TEST_P(EveryMetric, IsSymmetricWhereTheTableSaysSo) {
  if (!GetParam().symmetric) GTEST_SKIP() << "not symmetric";
  const SceneImage a = textured(20, 15), b = with_noise(a, 0.3f);
  const auto forward = run(GetParam(), a, b, {}), backward = run(GetParam(), b, a, {});
  for (std::size_t i = 0; i < forward.size(); ++i) {
    const Better better = GetParam().quantities[i].better;
    if (better == Better::kNeither) continue;
    const double sign = better == Better::kNearerZero ? -1 : 1;
    EXPECT_NEAR(forward[i].value, sign * backward[i].value, 1e-12) << forward[i].quantity;
  }
}

TEST_P(EveryMetric, StaysInRangeOnExtremeImages) {
  for (const auto& [width, height] : {std::pair{16, 13}, {1, 1}, {1, 20}, {20, 1}, {10, 11}}) {
    const std::vector<SceneImage> images = extreme_images(width, height);
    for (const SceneImage& test : images) {
      for (const SceneImage& reference : images) {
        for (const auto& rows : run_all(GetParam(), test, reference)) expect_in_range(GetParam(), rows);
      }
    }
  }
}

TEST_P(EveryMetric, DoesNotDependOnTheNumberOfThreads) {
  const SceneImage truth = textured(64, 48), test = with_noise(truth, 0.2f);
  const auto compare = [&](int threads) {
    ComparisonConditions conditions;
    conditions.threads = threads;
    return run(GetParam(), test, truth, conditions);
  };
  const auto one = compare(1), many = compare(4);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].value, many[i].value) << one[i].quantity;
}

TEST_P(EveryMetric, LooksOnlyAtValidPixels) {
  const SceneImage truth = textured(40, 30);
  SceneImage broken = truth;
  Mask valid(40, 30, 1);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 12; ++x) {
      broken.at(x, y) = {std::numeric_limits<float>::quiet_NaN(), 1e9f, 0};
      valid.at(x, y) = 0;
    }
  }
  ComparisonConditions conditions;
  conditions.valid = &valid;
  const std::vector<Measurement> rows = run(GetParam(), broken, truth, conditions);
  expect_identity(GetParam(), rows);
  const std::vector<Measurement> unbroken = run(GetParam(), truth, truth, conditions);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_EQ(rows[i].value, unbroken[i].value) << rows[i].quantity;
}

std::string comparison_message(const Metric& metric, const SceneImage& test, const SceneImage& reference,
                               const ComparisonConditions& conditions) {
  return message_of([&] { run(metric, test, reference, conditions); });
}

TEST_P(EveryMetric, CountsNonFinitePixelsInItsError) {
  const SceneImage truth = textured(12, 12);
  SceneImage broken = truth;
  broken.at(3, 4).g = std::numeric_limits<float>::quiet_NaN();
  broken.at(5, 4).r = std::numeric_limits<float>::infinity();
  EXPECT_NE(comparison_message(GetParam(), broken, truth, {}).find("test image has 2 pixels"),
            std::string::npos);
  if (GetParam().judge) return;
  EXPECT_NE(comparison_message(GetParam(), truth, broken, {}).find("reference image has 2 pixels"),
            std::string::npos);
}

TEST_P(EveryMetric, NamesBothSizesWhenTheyDiffer) {
  if (GetParam().judge) GTEST_SKIP() << "takes one image";
  const std::string message = comparison_message(GetParam(), textured(12, 13), textured(14, 15), {});
  EXPECT_NE(message.find("12×13"), std::string::npos) << message;
  EXPECT_NE(message.find("14×15"), std::string::npos) << message;
}

TEST_P(EveryMetric, RefusesUnusableConditions) {
  const SceneImage image = textured(12, 12);
  const Mask small(3, 3, 1), empty(12, 12, 0);
  ComparisonConditions conditions;
  conditions.valid = &small;
  EXPECT_NE(comparison_message(GetParam(), image, image, conditions).find("3×3"), std::string::npos);
  conditions.valid = &empty;
  EXPECT_NE(comparison_message(GetParam(), image, image, conditions).find("no pixel"), std::string::npos);
  conditions = {};
  conditions.exposure = 0;
  EXPECT_NE(comparison_message(GetParam(), image, image, conditions).find("exposure"), std::string::npos);
  EXPECT_NE(comparison_message(GetParam(), SceneImage{}, SceneImage{}, {}).find("no pixels"),
            std::string::npos);
}

TEST(MetricTable, HasUniqueNamesOfMetricsAndQuantities) {
  std::set<std::string> names, quantities;
  for (const Metric& metric : metrics()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    for (const MetricQuantity& quantity : metric.quantities) {
      EXPECT_TRUE(quantities.insert(quantity.name).second) << quantity.name;
    }
  }
}

TEST(MetricTable, SelectsByNameFamilyOrAllWithoutRepeating) {
  const std::vector<std::string> names{"ssim_gamma", "psnr", "psnr_pq"};
  std::vector<std::string> selected;
  for (const Metric* metric : select_metrics(names)) selected.push_back(metric->name);
  EXPECT_EQ(selected, (std::vector<std::string>{"psnr_linear", "psnr_gamma", "psnr_pq", "ssim_gamma"}));
  const std::vector<std::string> all{"all"};
  EXPECT_EQ(select_metrics(all).size(), metrics().size());
}

TEST(MetricTable, ListsWhatThereIsWhenAskedForAnUnknownMetric) {
  const std::vector<std::string> names{"psnr", "lpips"};
  const std::string message = message_of([&] { select_metrics(names); });
  EXPECT_NE(message.find("\"lpips\""), std::string::npos) << message;
  EXPECT_NE(message.find("ssim_gamma"), std::string::npos) << message;
}

}  // namespace
}  // namespace plenolab
