#include "metrics/vision/eye.h"

#include <algorithm>
#include <cmath>

namespace plenolab::vision {
namespace {

constexpr double kEpsilon = 0.9;  // ε of Daly's formula: eccentricity 0

/// Range and resolution of the JND scale's table, log10 cd/m².
constexpr double kLogMin = -4, kLogMax = 10;
constexpr int kStepsPerDecade = 1024;

/// P(y) at equal steps of log10 y: the peak of the sensitivity changes slowly.
class PeakTable {
 public:
  PeakTable() {
    for (int i = 0; i <= kSize; ++i)
      peaks_.push_back(ContrastSensitivity(std::pow(10, kLogMin + i * kStep), 0.5).peak().sensitivity);
  }
  double operator()(double log10_luminance) const {
    const double position = std::clamp((log10_luminance - kLogMin) / kStep, 0.0, double{kSize});
    const auto below = static_cast<std::size_t>(std::min(position, double{kSize} - 1));
    const double t = position - static_cast<double>(below);
    return (1 - t) * peaks_[below] + t * peaks_[below + 1];
  }

 private:
  static constexpr int kSize = 448;
  static constexpr double kStep = (kLogMax - kLogMin) / kSize;
  std::vector<double> peaks_;
};

}  // namespace

double pupil_diameter_mm(double average_cd_m2) {
  return 4.9 - 3 * std::tanh(0.4 * (std::log10(std::max(average_cd_m2, 1e-6)) + 1));
}

double optical_transfer(double frequency_cpd, double pupil_mm) {
  return std::exp(-std::pow(frequency_cpd / (20.9 - 2.1 * pupil_mm), 1.3 - 0.07 * pupil_mm));
}

ContrastSensitivity::ContrastSensitivity(double adaptation_cd_m2, double distance_m)
    : a_(0.801 * std::pow(1 + 0.7 / adaptation_cd_m2, -0.2)),
      b_(0.3 * std::pow(1 + 100 / adaptation_cd_m2, 0.15)),
      falloff_(0.856 * std::pow(distance_m, 0.14)) {}

double ContrastSensitivity::basic(double frequency_cpd) const {
  if (frequency_cpd <= 0) return 0;
  const double low = std::pow(3.23 * std::pow(frequency_cpd, -0.6), 5);  // (ρ²i²)^−0.3 with i² = 1
  const double decay = b_ * kEpsilon * frequency_cpd;
  // e^(−x)·√(1 + 0.06·e^x), written so that it does not overflow.
  return std::pow(low + 1, -0.2) * a_ * kEpsilon * frequency_cpd *
         std::sqrt(std::exp(-2 * decay) + 0.06 * std::exp(-decay));
}

double ContrastSensitivity::operator()(double frequency_cpd, double cos_4_theta) const {
  return 250 * std::min(basic(frequency_cpd), basic(frequency_cpd / falloff(cos_4_theta)));
}

ContrastSensitivity::Peak ContrastSensitivity::peak() const {
  // One maximum; narrowed down on a logarithmic scale.
  double low = std::log(0.01), high = std::log(60.0);
  const double section = 0.5 * (std::sqrt(5.0) - 1);
  while (high - low > 1e-7) {
    const double left = high - section * (high - low), right = low + section * (high - low);
    if ((*this)(std::exp(left)) < (*this)(std::exp(right)))
      low = left;
    else
      high = right;
  }
  const double frequency = std::exp(0.5 * (low + high));
  return {frequency, (*this)(frequency)};
}

JndScale::JndScale() {
  const PeakTable peak;
  const double bright = peak(7);
  constexpr int kEntries = static_cast<int>(kLogMax - kLogMin) * kStepsPerDecade + 1;
  jnd_.reserve(kEntries);
  double log_below = kLogMin, log_above = kLogMin;
  long step = 0;  // log_above is where this step ends
  for (int i = 0; i < kEntries; ++i) {
    const double wanted = kLogMin + static_cast<double>(i) / kStepsPerDecade;
    while (log_above < wanted) {
      log_below = log_above;
      log_above += std::log10(1 + 0.01 * bright / peak(log_below) / 5);
      ++step;
    }
    const double missing = log_above > log_below ? (log_above - wanted) / (log_above - log_below) : 0;
    jnd_.push_back(static_cast<float>((static_cast<double>(step) - missing) / 5));
  }
}

double JndScale::operator()(double luminance_cd_m2) const {
  if (!(luminance_cd_m2 > 1e-4)) return 0;
  const double position = (std::log10(luminance_cd_m2) - kLogMin) * kStepsPerDecade;
  const auto last = jnd_.size() - 1;
  if (position >= static_cast<double>(last)) return static_cast<double>(jnd_[last]);
  const auto below = static_cast<std::size_t>(std::max(position, 0.0));
  const double t = position - static_cast<double>(below);
  return (1 - t) * static_cast<double>(jnd_[below]) + t * static_cast<double>(jnd_[below + 1]);
}

const JndScale& jnd_scale() {
  static const JndScale scale;
  return scale;
}

}  // namespace plenolab::vision
