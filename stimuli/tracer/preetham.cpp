#include "stimuli/tracer/preetham.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace plenolab::tracer {

namespace {

// Linear BT.709 from XYZ, derived from the primaries and the white point D65 of ITU-R BT.709-6.
Eigen::Matrix3d bt709_from_xyz() {
  const auto xyz = [](double x, double y) { return Eigen::Vector3d(x / y, 1.0, (1.0 - x - y) / y); };
  Eigen::Matrix3d primaries;
  primaries << xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06);
  const Eigen::Vector3d scale = primaries.inverse() * xyz(0.3127, 0.3290);
  return (primaries * scale.asDiagonal()).inverse();
}

double cubic(const double (&k)[4], double x) {
  return ((k[0] * x + k[1]) * x + k[2]) * x + k[3];
}

// A row of coefficients a turbidity power, highest first, cubic in the sun's zenith angle.
double zenith_chromaticity(const double (&k)[3][4], double angle, double turbidity) {
  return (cubic(k[0], angle) * turbidity + cubic(k[1], angle)) * turbidity + cubic(k[2], angle);
}

constexpr double kZenithX[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                   {-0.02903, 0.06377, -0.03202, 0.00394},
                                   {0.11693, -0.21196, 0.06052, 0.25886}};
constexpr double kZenithY[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                   {-0.04214, 0.08970, -0.04153, 0.00516},
                                   {0.15346, -0.26756, 0.06670, 0.26688}};

}  // namespace

double PreethamSky::Perez::operator()(double cos_zenith, double gamma) const {
  const double cos_gamma = std::cos(gamma);
  return (1 + a * std::exp(b / cos_zenith)) * (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
}

PreethamSky::PreethamSky(double angle, double t)
    : perez_{{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
              -0.0670 * t + 0.3703},
             {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
              -0.0033 * t + 0.0452},
             {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
              -0.0109 * t + 0.0529}} {
  const double chi = (4.0 / 9.0 - t / 120.0) * (std::numbers::pi - 2 * angle);
  zenith_[0] = 1000.0 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
  zenith_[1] = zenith_chromaticity(kZenithX, angle, t);
  zenith_[2] = zenith_chromaticity(kZenithY, angle, t);
  for (int i = 0; i < 3; ++i) at_zenith_[i] = perez_[i](1.0, angle);
}

Rgb PreethamSky::radiance(double cos_zenith, double cos_sun) const {
  static const Eigen::Matrix3d to_bt709 = bt709_from_xyz();
  const double cosine = std::max(cos_zenith, 0.001745);  // cos 89.9°
  const double gamma = std::acos(std::clamp(cos_sun, -1.0, 1.0));
  double value[3];
  for (int i = 0; i < 3; ++i) value[i] = zenith_[i] * perez_[i](cosine, gamma) / at_zenith_[i];
  const double luminance = std::max(0.0, value[0]), x = value[1], y = value[2];
  const Eigen::Vector3d rgb = to_bt709 * Eigen::Vector3d(x / y, 1.0, (1 - x - y) / y) * luminance;
  const auto positive = [](double c) { return static_cast<float>(std::max(0.0, c)); };
  return {positive(rgb[0]), positive(rgb[1]), positive(rgb[2])};
}

}  // namespace plenolab::tracer
