#pragma once

namespace plenolab {

/// Factor k with exp(−x²/2σ²) = 2^(−k·x²): the form in which weights of Gaussians are multiplied by adding
/// exponents.
constexpr double gaussian_exponent(double sigma) {
  constexpr double kLog2E = 1.4426950408889634;
  return kLog2E / (2 * sigma * sigma);
}

}  // namespace plenolab
