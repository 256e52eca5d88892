#include "metrics/vision/perceived_contrast.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "metrics/vision/eye.h"
#include "metrics/vision/spectrum.h"

namespace plenolab::vision {
namespace {

constexpr int kLevels = 6;  // 0.001 … 100 cd/m²
constexpr double kLogLowest = -3;
constexpr int kRowsAtOnce = 32;
constexpr int kTableSize = 4096;
constexpr double kHighestCpd = 100;  // nothing is seen beyond

double mean_of(const Plane<float>& plane) {
  double sum = 0;
  for (const float v : plane.pixels()) sum += static_cast<double>(v);
  return sum / static_cast<double>(plane.size());
}

/// Where between the levels each pixel is adapted, 0 … kLevels − 1.
Plane<float> adaptation_levels(const Plane<float>& blurred, int threads) {
  Plane<float> levels(blurred.width(), blurred.height());
  parallel_for(levels.height(), kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < levels.width(); ++x)
        levels.at(x, y) =
            std::clamp(std::log10(std::max(blurred.at(x, y), 1e-6f)) - static_cast<float>(kLogLowest), 0.0f,
                       float{kLevels - 1});
  });
  return levels;
}

Plane<float> in_jnd(const Plane<float>& blurred, int threads) {
  const JndScale& scale = jnd_scale();
  Plane<float> jnd(blurred.width(), blurred.height());
  parallel_for(jnd.height(), kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < jnd.width(); ++x)
        jnd.at(x, y) = static_cast<float>(scale(static_cast<double>(blurred.at(x, y))));
  });
  return jnd;
}

/// Adds what two neighbouring levels contribute at each pixel.
void add_levels(Plane<float>& sum, const Spectrum& filtered, const Plane<float>& levels, int first,
                int threads) {
  parallel_for(sum.height(), kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < sum.width(); ++x) {
        const float below = std::max(0.0f, 1 - std::abs(levels.at(x, y) - static_cast<float>(first)));
        const float above = std::max(0.0f, 1 - std::abs(levels.at(x, y) - static_cast<float>(first + 1)));
        const std::complex<float> v = filtered.at(x, y);
        sum.at(x, y) += below * v.real() + above * v.imag();
      }
    }
  });
}

}  // namespace

SensitivityFilter::SensitivityFilter(double adaptation_cd_m2, double pupil_mm,
                                     const ViewingConditions& viewing)
    : pixels_per_degree_(viewing.pixels_per_degree) {
  const ContrastSensitivity sensitivity(adaptation_cd_m2, viewing.distance_m);
  const double peak = sensitivity.peak().sensitivity / 250;
  falloff_axis_ = sensitivity.falloff(1);
  falloff_diagonal_ = sensitivity.falloff(-1);
  // The highest frequency, in a corner of the spectrum, over the smallest falloff.
  const double highest =
      std::min(0.7072 * pixels_per_degree_ / std::min({falloff_axis_, falloff_diagonal_, 1.0}), kHighestCpd);
  steps_per_cpd_ = (kTableSize - 2) / highest;
  for (int i = 0; i < kTableSize; ++i) {
    const double frequency = i / steps_per_cpd_;
    basic_.push_back(static_cast<float>(sensitivity.basic(frequency) / peak));
    transfer_.push_back(static_cast<float>(optical_transfer(frequency, pupil_mm)));
  }
}

double SensitivityFilter::basic(double frequency_cpd) const {
  const double position = std::min(frequency_cpd * steps_per_cpd_, kTableSize - 2.0);
  const auto below = static_cast<std::size_t>(position);
  const double t = position - static_cast<double>(below);
  return (1 - t) * static_cast<double>(basic_[below]) + t * static_cast<double>(basic_[below + 1]);
}

double SensitivityFilter::operator()(double x, double y) const {
  const double xx = x * x, yy = y * y, squared = xx + yy;
  if (squared == 0) return 0;
  const double frequency = std::sqrt(squared) * pixels_per_degree_;
  const double diagonality = 4 * xx * yy / (squared * squared);  // (1 − cos4θ)/2
  const double falloff = falloff_axis_ + diagonality * (falloff_diagonal_ - falloff_axis_);
  const double sensitivity = std::min(basic(frequency), basic(frequency / falloff));
  const auto nearest = static_cast<std::size_t>(std::min(frequency * steps_per_cpd_ + 0.5, kTableSize - 1.0));
  const double transfer = static_cast<double>(transfer_[nearest]);
  return sensitivity >= transfer ? 1 : sensitivity / transfer;
}

Plane<float> perceived_contrast(const Plane<float>& luminance_cd_m2, const ViewingConditions& viewing,
                                int threads) {
  const Canvas canvas = canvas_for(luminance_cd_m2.width(), luminance_cd_m2.height());
  const double pupil_mm = pupil_diameter_mm(mean_of(luminance_cd_m2));
  Plane<float> blurred = filter_precisely(
      luminance_cd_m2, canvas,
      [&](double frequency) { return optical_transfer(frequency * viewing.pixels_per_degree, pupil_mm); },
      threads);
  const Plane<float> levels = adaptation_levels(blurred, threads);
  const Spectrum spectrum = spectrum_of(pad(in_jnd(blurred, threads), canvas));
  const auto [lowest, highest] = std::minmax_element(levels.pixels().begin(), levels.pixels().end());
  Plane<float> contrast(canvas.width, canvas.height);
  for (int first = 0; first < kLevels; first += 2) {
    if (*highest <= static_cast<float>(first - 1) || *lowest >= static_cast<float>(first + 2)) continue;
    const SensitivityFilter below(std::pow(10, kLogLowest + first), pupil_mm, viewing);
    const SensitivityFilter above(std::pow(10, kLogLowest + first + 1), pupil_mm, viewing);
    const auto response = [&](double x, double y) {
      return FilterPair{static_cast<float>(below(x, y)), static_cast<float>(above(x, y))};
    };
    add_levels(contrast, filter(spectrum, response, threads), levels, first, threads);
  }
  return contrast;
}

}  // namespace plenolab::vision
