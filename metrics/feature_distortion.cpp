#include "metrics/feature_distortion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/tonemap/content_adaptive.h"
#include "metrics/fill_invalid.h"

namespace plenolab {
namespace {

/// Share of a uniform distribution in both saliencies, so that their divergence is finite.
constexpr double kUniformShare = 0.01;

Plane<float> luma_of(const DisplayImage& image) {
  Plane<float> luma(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) luma.pixels()[i] = luminance(image.pixels()[i]);
  return luma;
}

std::vector<float> valid_values(const Plane<float>& plane, const Mask* valid) {
  std::vector<float> values;
  for (std::size_t i = 0; i < plane.size(); ++i)
    if (is_valid(valid, i)) values.push_back(plane.pixels()[i]);
  return values;
}

std::vector<float> sorted_values(const Plane<float>& plane, const Mask* valid) {
  std::vector<float> values = valid_values(plane, valid);
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<double> exposure_centres(const std::vector<float>& sorted, double step_ev) {
  const auto positive = std::upper_bound(sorted.begin(), sorted.end(), 0.0f);
  if (positive == sorted.end()) return {1};
  const auto count = static_cast<double>(sorted.end() - positive);
  const auto at = [&](double share) {
    return std::log2(static_cast<double>(*(positive + static_cast<std::ptrdiff_t>(share * (count - 1)))));
  };
  const double low = at(0.01), high = at(0.99);
  const int steps = static_cast<int>(std::ceil((high - low) / step_ev - 1e-9));
  std::vector<double> centres;
  for (int i = 0; i <= steps; ++i)
    centres.push_back(std::exp2(0.5 * (low + high) + (i - 0.5 * steps) * step_ev));
  return centres;
}

double mean_of(const Plane<float>& plane, const Mask* valid) {
  double sum = 0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    sum += static_cast<double>(plane.pixels()[i]);
    ++count;
  }
  return sum / static_cast<double>(count);
}

Plane<float> windowed(const Plane<float>& luminance, double centre, double half_window_ev) {
  const auto low = static_cast<float>(centre * std::exp2(-half_window_ev));
  const auto high = static_cast<float>(centre * std::exp2(half_window_ev));
  Plane<float> result = luminance;
  for (float& v : result.pixels()) v = std::clamp(v, low, high);
  return result;
}

/// Squared differences to the neighbours right and below; 0 where one of the three is invalid or outside.
Plane<float> gradient_energy(const Plane<float>& luma, const Mask* valid) {
  Plane<float> energy(luma.width(), luma.height());
  const auto counts = [&](int x, int y) { return valid == nullptr || valid->at(x, y) != 0; };
  for (int y = 0; y < luma.height(); ++y) {
    for (int x = 0; x < luma.width(); ++x) {
      const int right = std::min(x + 1, luma.width() - 1), below = std::min(y + 1, luma.height() - 1);
      if (!counts(x, y) || !counts(right, y) || !counts(x, below)) continue;
      const float dx = luma.at(right, y) - luma.at(x, y), dy = luma.at(x, below) - luma.at(x, y);
      energy.at(x, y) = dx * dx + dy * dy;
    }
  }
  return energy;
}

/// Scales to the sum 1 over the valid pixels, 0 elsewhere; even where nothing is positive.
void make_distribution(Plane<float>& plane, const Mask* valid) {
  double sum = 0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (!is_valid(valid, i)) plane.pixels()[i] = 0;
    sum += static_cast<double>(plane.pixels()[i]);
    count += is_valid(valid, i);
  }
  for (std::size_t i = 0; i < plane.size(); ++i) {
    float& v = plane.pixels()[i];
    if (!is_valid(valid, i)) continue;
    v = sum > 0 ? static_cast<float>(static_cast<double>(v) / sum) : 1 / static_cast<float>(count);
  }
}

cv::Mat blurred(const cv::Mat& image, double sigma) {
  cv::Mat result;
  cv::GaussianBlur(image, result, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
  return result;
}

/// Share of the reference's gradient energy in an area that the test keeps, at most all of it at each pixel.
double retained(const Plane<float>& test, const Plane<float>& reference, const Mask& area) {
  double kept = 0, all = 0;
  for (std::size_t i = 0; i < test.size(); ++i) {
    if (area.pixels()[i] == 0) continue;
    kept += static_cast<double>(std::min(test.pixels()[i], reference.pixels()[i]));
    all += static_cast<double>(reference.pixels()[i]);
  }
  return all > 0 ? kept / all : 1;
}

/// Kullback-Leibler divergence of `test` from `reference`, both with a share of an even distribution.
double divergence(const Plane<float>& reference, const Plane<float>& test, const Mask* valid) {
  double count = 0, sum = 0;
  for (std::size_t i = 0; i < test.size(); ++i) count += is_valid(valid, i);
  const auto mixed = [&](float v) {
    return (1 - kUniformShare) * static_cast<double>(v) + kUniformShare / count;
  };
  for (std::size_t i = 0; i < test.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    const double p = mixed(reference.pixels()[i]);
    sum += p * std::log(p / mixed(test.pixels()[i]));
  }
  return std::max(0.0, sum);
}

Mask within(const Plane<float>& luminance, float low, float high, const Mask* valid) {
  Mask area(luminance.width(), luminance.height());
  for (std::size_t i = 0; i < luminance.size(); ++i)
    area.pixels()[i] = is_valid(valid, i) && luminance.pixels()[i] >= low && luminance.pixels()[i] <= high;
  return area;
}

/// Features of one photograph.
struct PhotographFeatures {
  double brightness = 0;
  Plane<float> saliency, gradient_energy;
};

/// Adds what the photographs show: the mean of brightness and saliency, the largest gradient energy.
void merge_features(FeatureReference& reference, const std::vector<PhotographFeatures>& photographs) {
  const double share = 1 / static_cast<double>(photographs.size());
  for (const PhotographFeatures& p : photographs) {
    reference.brightness += share * p.brightness;
    for (std::size_t i = 0; i < p.saliency.size(); ++i) {
      reference.saliency.pixels()[i] += static_cast<float>(share) * p.saliency.pixels()[i];
      float& energy = reference.gradient_energy.pixels()[i];
      energy = std::max(energy, p.gradient_energy.pixels()[i]);
    }
  }
}

std::vector<Measurement> measure_features(const std::string& name, const DisplayImage& test,
                                          const Plane<float>& luminance, const FeatureOptions& options,
                                          const ComparisonConditions& conditions) {
  const FeatureReference features =
      feature_reference(luminance, options, conditions.valid, conditions.threads);
  const FeatureDistortion d = feature_distortion(test, features, options, conditions.valid);
  return {{name, d.total, "1"},
          {name + "_brightness", d.brightness, "1"},
          {name + "_saliency", d.saliency, "1"},
          {name + "_detail", d.detail, "1"}};
}

}  // namespace

void FeatureOptions::validate() const {
  const auto check_ev = [](const char* what, double value) {
    if (!(value > 0 && value <= 16))
      throw InputError(fmt::format("{} is {} but must lie in (0, 16]", what, value));
  };
  check_ev("step_ev", step_ev);
  check_ev("half_window_ev", half_window_ev);
  const double sum = brightness_weight + saliency_weight + detail_weight;
  if (!(std::min({brightness_weight, saliency_weight, detail_weight}) >= 0 && sum > 0 && std::isfinite(sum)))
    throw InputError(fmt::format("the feature weights are {}, {} and {} but must be ≥ 0 and not all 0",
                                 brightness_weight, saliency_weight, detail_weight));
}

Plane<float> photographic_photograph(const Plane<float>& windowed_luminance, double centre, const Mask*) {
  Plane<float> luma(windowed_luminance.width(), windowed_luminance.height());
  for (std::size_t i = 0; i < luma.size(); ++i) {
    const double scaled = static_cast<double>(windowed_luminance.pixels()[i]) / centre;
    luma.pixels()[i] = gamma_encode(static_cast<float>(scaled / (1 + scaled)));
  }
  return luma;
}

Plane<float> content_adaptive_photograph(const Plane<float>& windowed_luminance, double, const Mask* valid) {
  const std::vector<float> values = valid_values(windowed_luminance, valid);
  Plane<float> row(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), row.row(0));
  const float largest = *std::max_element(values.begin(), values.end());
  const PqHistogram histogram = measure_pq_histogram(row, static_cast<double>(largest), 1);
  return apply_curve(fit_curve({}, histogram), windowed_luminance);
}

Plane<float> saliency_of(const Plane<float>& luma, const Mask* valid) {
  Plane<float> filled = fill_invalid(luma, valid);
  const cv::Mat image(luma.height(), luma.width(), CV_32F, filled.pixels().data());
  Plane<float> saliency(luma.width(), luma.height());
  cv::Mat sum(luma.height(), luma.width(), CV_32F, saliency.pixels().data());
  for (const double centre : {1, 2, 4, 8}) {
    const cv::Mat contrast = cv::abs(blurred(image, centre) - blurred(image, 4 * centre));
    double largest = 0;
    cv::minMaxLoc(contrast, nullptr, &largest);
    if (largest > 1e-6) sum += contrast * (1 / largest);
  }
  make_distribution(saliency, valid);
  return saliency;
}

FeatureReference feature_reference(const Plane<float>& luminance, const FeatureOptions& options,
                                   const Mask* valid, int threads) {
  options.validate();
  const std::vector<float> sorted = sorted_values(luminance, valid);
  PLENOLAB_CHECK(!sorted.empty(), "no valid pixel");
  const Plane<float> filled = fill_invalid(luminance, valid);
  FeatureReference reference;
  reference.centres = exposure_centres(sorted, options.step_ev);
  reference.saliency = reference.gradient_energy = Plane<float>(luminance.width(), luminance.height());
  std::vector<PhotographFeatures> photographs(reference.centres.size());
  parallel_for(static_cast<int>(photographs.size()), 1, threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const double centre = reference.centres[static_cast<std::size_t>(i)];
      const Plane<float> luma =
          options.photograph(windowed(filled, centre, options.half_window_ev), centre, valid);
      photographs[static_cast<std::size_t>(i)] = {mean_of(luma, valid), saliency_of(luma, valid),
                                                  gradient_energy(luma, valid)};
    }
  });
  merge_features(reference, photographs);
  const auto quarter = (sorted.size() - 1) / 4;
  reference.dark = within(luminance, sorted.front(), sorted[quarter], valid);
  reference.bright = within(luminance, sorted[sorted.size() - 1 - quarter], sorted.back(), valid);
  return reference;
}

FeatureDistortion feature_distortion(const DisplayImage& test, const FeatureReference& reference,
                                     const FeatureOptions& options, const Mask* valid) {
  options.validate();
  if (test.width() != reference.saliency.width() || test.height() != reference.saliency.height())
    throw InputError(fmt::format("the test image has {}×{} pixels but its scene has {}×{}", test.width(),
                                 test.height(), reference.saliency.width(), reference.saliency.height()));
  const Plane<float> luma = luma_of(test);
  const Plane<float> energy = gradient_energy(luma, valid);
  FeatureDistortion d;
  d.brightness = std::abs(mean_of(luma, valid) - reference.brightness);
  d.saliency = 1 - std::exp(-divergence(reference.saliency, saliency_of(luma, valid), valid));
  d.detail = 1 - 0.5 * (retained(energy, reference.gradient_energy, reference.dark) +
                        retained(energy, reference.gradient_energy, reference.bright));
  d.total = (options.brightness_weight * d.brightness + options.saliency_weight * d.saliency +
             options.detail_weight * d.detail) /
            (options.brightness_weight + options.saliency_weight + options.detail_weight);
  return d;
}

std::vector<Measurement> feature_photographic(const DisplayImage& test, const SceneImage& reference,
                                              const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  return measure_features("feature_photographic", test, relative_luminance(reference), {}, conditions);
}

std::vector<Measurement> feature_content_adaptive(const DisplayImage& test, const SceneImage& reference,
                                                  const ComparisonConditions& conditions) {
  check_comparable(test, reference, conditions);
  FeatureOptions options;
  options.photograph = content_adaptive_photograph;
  return measure_features("feature_content_adaptive", test,
                          scene_luminance(reference, conditions.cd_m2_per_unit), options, conditions);
}

}  // namespace plenolab
