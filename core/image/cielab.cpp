#include "core/image/cielab.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "core/image/colour.h"

namespace plenolab {

namespace {

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

/// Chromaticities of the primaries and of white (ITU-R BT.709-6, table 1).
constexpr double kRed[]{0.640, 0.330}, kGreen[]{0.300, 0.600}, kBlue[]{0.150, 0.060},
    kWhite[]{0.3127, 0.3290};

Vector xyz_of_chromaticity(const double (&xy)[2]) {
  return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

/// Linear BT.709 to XYZ, white having Y = 1.
Matrix matrix_to_xyz() {
  Matrix primaries;
  primaries << xyz_of_chromaticity(kRed), xyz_of_chromaticity(kGreen), xyz_of_chromaticity(kBlue);
  const Vector amounts = primaries.inverse() * xyz_of_chromaticity(kWhite);
  return primaries * amounts.asDiagonal();
}

// CIE 15:2004, 8.2.1.
constexpr double kDelta = 6.0 / 29.0;

double compress(double t) {
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

double expand(double f) {
  return f > kDelta ? f * f * f : 3 * kDelta * kDelta * (f - 4.0 / 29.0);
}

}  // namespace

CieLab lab_of_display(Rgb encoded) {
  static const Matrix to_xyz = matrix_to_xyz();
  static const Vector white = xyz_of_chromaticity(kWhite);
  const auto linear = [](float v) { return std::pow(std::max(0.0, static_cast<double>(v)), 2.2); };
  const Vector xyz = to_xyz * Vector(linear(encoded.r), linear(encoded.g), linear(encoded.b));
  const double x = compress(xyz[0] / white[0]), y = compress(xyz[1]), z = compress(xyz[2] / white[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Rgb display_of_lab(CieLab colour) {
  static const Matrix from_xyz = matrix_to_xyz().inverse();
  static const Vector white = xyz_of_chromaticity(kWhite);
  const double y = (colour.l + 16) / 116, x = y + colour.a / 500, z = y - colour.b / 200;
  const Vector linear = from_xyz * Vector(white[0] * expand(x), expand(y), white[2] * expand(z));
  const auto encoded = [](double v) { return static_cast<float>(std::pow(std::max(0.0, v), 1 / 2.2)); };
  return {encoded(linear[0]), encoded(linear[1]), encoded(linear[2])};
}

double delta_e(const CieLab& a, const CieLab& b) {
  return std::hypot(a.l - b.l, a.a - b.a, a.b - b.b);
}

}  // namespace plenolab
