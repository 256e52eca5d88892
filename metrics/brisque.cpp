#include "metrics/brisque.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "metrics/brisque_weights.h"

namespace plenolab {
namespace {

constexpr int kWindow = 7;
constexpr double kSigma = 7.0 / 6;
constexpr double kSmallestShape = 0.2, kLargestShape = 10;
constexpr int kPerScale = kBrisqueFeatures / 2;
constexpr double kLargestInput = 4;

/// Luma on [0, 255], and which pixels count; invalid ones are 0.
struct Luma {
  Plane<double> values;
  Mask valid;
};

Luma luma_of(const DisplayImage& image, const Mask* valid) {
  Luma luma{Plane<double>(image.width(), image.height()), Mask(image.width(), image.height())};
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    luma.values.pixels()[i] = 255 * static_cast<double>(luminance(image.pixels()[i]));
    luma.valid.pixels()[i] = 1;
  }
  return luma;
}

Luma halved(const Luma& luma) {
  const int width = luma.values.width(), height = luma.values.height();
  const int step_x = std::min(width, 2), step_y = std::min(height, 2);
  Luma half{Plane<double>(width / step_x, height / step_y), Mask(width / step_x, height / step_y)};
  for (int y = 0; y < half.values.height(); ++y) {
    for (int x = 0; x < half.values.width(); ++x) {
      bool all = true;
      for (int v = 0; v < step_y; ++v) {
        for (int u = 0; u < step_x; ++u) {
          half.values.at(x, y) += luma.values.at(step_x * x + u, step_y * y + v) / (step_x * step_y);
          all = all && luma.valid.at(step_x * x + u, step_y * y + v) != 0;
        }
      }
      half.valid.at(x, y) = all;
    }
  }
  return half;
}

cv::Mat blurred(const cv::Mat& image) {
  cv::Mat result;
  cv::GaussianBlur(image, result, {kWindow, kWindow}, kSigma, kSigma, cv::BORDER_REPLICATE);
  return result;
}

/// Locally normalised luma; valid where the whole window is.
Luma normalised(Luma luma) {
  const int height = luma.values.height(), width = luma.values.width();
  const cv::Mat image(height, width, CV_64F, luma.values.pixels().data());
  const cv::Mat mean = blurred(image), mean_of_squares = blurred(image.mul(image));
  Plane<double> result(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double m = mean.at<double>(y, x);
      const double deviation = std::sqrt(std::max(0.0, mean_of_squares.at<double>(y, x) - m * m));
      result.at(x, y) = (luma.values.at(x, y) - m) / (deviation + 1);
    }
  }
  const cv::Mat valid(height, width, CV_8U, luma.valid.pixels().data());
  cv::Mat eroded;
  cv::erode(valid, eroded, cv::getStructuringElement(cv::MORPH_RECT, {kWindow, kWindow}), {-1, -1}, 1,
            cv::BORDER_REPLICATE);
  eroded.copyTo(valid);
  luma.values = std::move(result);
  return luma;
}

/// Sums over samples from which both kinds of Gaussians are fitted.
struct Samples {
  std::int64_t count = 0, negative = 0, positive = 0;
  double magnitude = 0, squares = 0, negative_squares = 0, positive_squares = 0;
  void add(double v) {
    ++count;
    magnitude += std::abs(v);
    squares += v * v;
    if (v < 0) ++negative, negative_squares += v * v;
    if (v > 0) ++positive, positive_squares += v * v;
  }
};

/// Γ(1/γ)·Γ(3/γ)/Γ(2/γ)².
double shape_ratio(double shape) {
  return std::exp(std::lgamma(1 / shape) + std::lgamma(3 / shape) - 2 * std::lgamma(2 / shape));
}

/// Samples whose spread is rounding have nothing to fit.
bool has_spread(const Samples& s) {
  return s.count > 0 && s.squares > 1e-18 * static_cast<double>(s.count);
}

void fit_symmetric(const Samples& s, double* features) {
  features[0] = kLargestShape, features[1] = 0;
  if (!has_spread(s)) return;
  const double count = static_cast<double>(s.count);
  const double mean = s.magnitude / count, variance = s.squares / count;
  features[0] = generalised_gaussian_shape(variance / (mean * mean));
  features[1] = variance;
}

void fit_asymmetric(const Samples& s, double* features) {
  features[0] = kLargestShape;
  std::fill(features + 1, features + 4, 0.0);
  if (!has_spread(s)) return;
  const double count = static_cast<double>(s.count);
  const double left_variance = s.negative > 0 ? s.negative_squares / static_cast<double>(s.negative) : 0;
  const double right_variance = s.positive > 0 ? s.positive_squares / static_cast<double>(s.positive) : 0;
  const double left = std::sqrt(left_variance), right = std::sqrt(right_variance);
  // Symmetric in the sides: the quotient of the smaller by the larger deviation does not overflow.
  const double quotient = std::min(left, right) / std::max(left, right);
  const double mean = s.magnitude / count, variance = s.squares / count;
  const double q2 = quotient * quotient;
  const double ratio = mean * mean / variance * (q2 * quotient + 1) * (quotient + 1) / ((q2 + 1) * (q2 + 1));
  const double shape = generalised_gaussian_shape(1 / ratio);
  features[0] = shape;
  features[1] = (right - left) * std::exp(std::lgamma(2 / shape) - 0.5 * std::lgamma(1 / shape) -
                                          0.5 * std::lgamma(3 / shape));
  features[2] = left_variance;
  features[3] = right_variance;
}

/// Products with the neighbour at (dx, dy), of pairs that are valid and inside.
Samples products(const Luma& image, int dx, int dy) {
  Samples samples;
  const int width = image.values.width(), height = image.values.height();
  for (int y = 0; y + dy < height; ++y)
    for (int x = std::max(0, -dx); x < std::min(width, width - dx); ++x)
      if (image.valid.at(x, y) != 0 && image.valid.at(x + dx, y + dy) != 0)
        samples.add(image.values.at(x, y) * image.values.at(x + dx, y + dy));
  return samples;
}

void features_of_scale(const Luma& image, double* features) {
  Samples own;
  for (std::size_t i = 0; i < image.values.size(); ++i)
    if (image.valid.pixels()[i] != 0) own.add(image.values.pixels()[i]);
  fit_symmetric(own, features);
  fit_asymmetric(products(image, 1, 0), features + 2);
  fit_asymmetric(products(image, 0, 1), features + 6);
  fit_asymmetric(products(image, 1, 1), features + 10);
  fit_asymmetric(products(image, -1, 1), features + 14);
}

bool is_mean(int feature) {
  const int place = feature % kPerScale;
  return place >= 2 && (place - 2) % 4 == 1;
}

}  // namespace

double generalised_gaussian_shape(double ratio) {
  double low = kSmallestShape, high = kLargestShape;  // the ratio falls with the shape
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (shape_ratio(middle) > ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

BrisqueFeatures brisque_features(const DisplayImage& image, const Mask* valid) {
  PLENOLAB_CHECK(!image.empty(), "an image without pixels has no features");
  BrisqueFeatures features{};
  const Luma full = luma_of(image, valid);
  const Luma first = normalised(full);
  if (std::none_of(first.valid.pixels().begin(), first.valid.pixels().end(), [](auto v) { return v != 0; }))
    throw InputError(
        "the mask leaves no window of 7×7 valid pixels for BRISQUE; use a mask with larger valid areas");
  features_of_scale(first, features.data());
  features_of_scale(normalised(halved(full)), features.data() + kPerScale);
  return features;
}

BrisqueFeatures brisque_inputs(const BrisqueFeatures& features) {
  BrisqueFeatures inputs{};
  for (int i = 0; i < kBrisqueFeatures; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    inputs[slot] = is_mean(i) ? features[slot] : std::log(features[slot] + 1e-4);
  }
  return inputs;
}

std::array<double, 2 * kBrisqueFeatures> brisque_terms(const BrisqueModel& model,
                                                       const BrisqueFeatures& features) {
  const BrisqueFeatures inputs = brisque_inputs(features);
  std::array<double, 2 * kBrisqueFeatures> terms{};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double standardised =
        std::clamp((inputs[i] - model.mean[i]) / model.deviation[i], -kLargestInput, kLargestInput);
    terms[i] = standardised;
    terms[inputs.size() + i] = standardised * standardised;
  }
  return terms;
}

double brisque_score(const BrisqueModel& model, const BrisqueFeatures& features) {
  const auto terms = brisque_terms(model, features);
  double score = model.intercept;
  for (std::size_t i = 0; i < terms.size(); ++i) score += model.weights[i] * terms[i];
  return std::clamp(score, 0.0, 100.0);
}

const BrisqueModel& brisque_plenolab_model() {
  static const BrisqueModel model{brisque_weights::kMean, brisque_weights::kDeviation,
                                  brisque_weights::kWeights, brisque_weights::kIntercept};
  return model;
}

std::vector<Measurement> brisque_plenolab(const DisplayImage& image, const ComparisonConditions& conditions) {
  check_comparable(image, image, conditions);
  return {{"brisque_plenolab",
           brisque_score(brisque_plenolab_model(), brisque_features(image, conditions.valid)), "1"}};
}

}  // namespace plenolab
