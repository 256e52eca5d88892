#pragma once

#include <functional>
#include <vector>

#include "core/image/image.h"

/// Weighted moments of two images in windows of 11×11 pixels with a Gaussian of σ = 1.5, as SSIM and metrics
/// after it use them (Wang et al. 2004).
namespace plenolab {

inline constexpr int kStructureWindow = 11;

/// Means over a window: of both images, their squares and their product.
struct WindowMoments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  void add(double weight, const WindowMoments& m) {
    a += weight * m.a, b += weight * m.b, aa += weight * m.aa, bb += weight * m.bb, ab += weight * m.ab;
  }
};

/// Size of what there are windows for: only windows that lie inside the image, cropped to the image where
/// that is smaller.
struct WindowGrid {
  int taps_x = 0, taps_y = 0;  ///< min(11, width) and min(11, height)
  int width = 0, height = 0;   ///< number of windows, ≥ 1
};
WindowGrid windows_of(int width, int height);

/// Calls visit(x, y, moments) once for the window whose top-left tap is at pixel (x, y), for every window.
/// Calls run in parallel but do not depend on each other. Images of equal size with at least one pixel.
void visit_windows(const Plane<double>& a, const Plane<double>& b, int threads,
                   const std::function<void(int x, int y, const WindowMoments&)>& visit);

/// Mean of values given for each window over the windows without a pixel that is 0 in `valid` (null: over
/// all); `none` if there is no such window.
double mean_of_windows(const Plane<float>& values, const Mask* valid, double none);

}  // namespace plenolab
