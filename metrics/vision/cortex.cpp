#include "metrics/vision/cortex.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plenolab::vision {
namespace {

/// Low-pass filter with half response at `half`, with a transition of two thirds of that (Daly 1993).
double mesa(double frequency, double half) {
  const double width = 2 * half / 3;
  const double start = half - 0.5 * width;
  if (frequency <= start) return 1;
  if (frequency >= start + width) return 0;
  return 0.5 * (1 + std::cos(std::numbers::pi * (frequency - start) / width));
}

double fan(int orientations, int orientation, double x, double y) {
  const double spacing = std::numbers::pi / orientations;
  double distance = std::abs(std::atan2(y, x) - orientation * spacing);
  distance = std::fmod(distance, std::numbers::pi);
  distance = std::min(distance, std::numbers::pi - distance);
  return distance >= spacing ? 0 : 0.5 * (1 + std::cos(std::numbers::pi * distance / spacing));
}

}  // namespace

double lower_edge(int band) {
  return 1.0 / (4 << band);
}

double base_response(const CortexLayout& layout, double frequency) {
  const double half = lower_edge(layout.bands - 1);
  const double end = half + half / 3;
  if (frequency >= end) return 0;
  const double sigma = end / 3;
  return std::exp(-frequency * frequency / (2 * sigma * sigma));
}

double band_response(const CortexLayout& layout, int band, double frequency) {
  const double upper = band == 0 ? 1 : mesa(frequency, 2 * lower_edge(band));
  const double lower =
      band == layout.bands - 1 ? base_response(layout, frequency) : mesa(frequency, lower_edge(band));
  return upper - lower;
}

double orientation_response(const CortexLayout& layout, int orientation, double x, double y) {
  if (layout.orientations == 1) return 1;
  const bool at_end = std::abs(x) >= 0.5 || std::abs(y) >= 0.5;
  const double response = fan(layout.orientations, orientation, x, y);
  return at_end ? 0.5 * (response + fan(layout.orientations, orientation, -x, y)) : response;
}

}  // namespace plenolab::vision
