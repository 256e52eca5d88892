#include "metrics/window_moments.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace plenolab {
namespace {

constexpr double kSigma = 1.5;
constexpr int kRowsAtOnce = 8;

/// Gaussian of `taps` taps about their middle, normalised to 1.
std::vector<double> gaussian(int taps) {
  std::vector<double> kernel(static_cast<std::size_t>(taps));
  double sum = 0;
  for (int i = 0; i < taps; ++i) {
    const double distance = i - 0.5 * (taps - 1);
    sum += kernel[static_cast<std::size_t>(i)] = std::exp(-0.5 * distance * distance / (kSigma * kSigma));
  }
  for (double& k : kernel) k /= sum;
  return kernel;
}

/// The rows of the images filtered horizontally.
Plane<WindowMoments> filter_rows(const Plane<double>& a, const Plane<double>& b, int windows, int threads) {
  const std::vector<double> kernel = gaussian(a.width() - windows + 1);
  Plane<WindowMoments> filtered(windows, a.height());
  parallel_for(a.height(), kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < windows; ++x) {
        for (int i = 0; i < static_cast<int>(kernel.size()); ++i) {
          const double va = a.at(x + i, y), vb = b.at(x + i, y);
          filtered.at(x, y).add(kernel[static_cast<std::size_t>(i)], {va, vb, va * va, vb * vb, va * vb});
        }
      }
    }
  });
  return filtered;
}

/// Number of invalid pixels above and to the left of each corner, for counting them in any window at once.
Plane<int> invalid_sums(const Mask& valid) {
  Plane<int> sums(valid.width() + 1, valid.height() + 1, 0);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      sums.at(x + 1, y + 1) =
          sums.at(x, y + 1) + sums.at(x + 1, y) - sums.at(x, y) + (valid.at(x, y) == 0 ? 1 : 0);
    }
  }
  return sums;
}

double mean_of_all(const Plane<float>& values) {
  double sum = 0;
  for (const float v : values.pixels()) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

}  // namespace

WindowGrid windows_of(int width, int height) {
  const int taps_x = std::min(kStructureWindow, width), taps_y = std::min(kStructureWindow, height);
  return {taps_x, taps_y, width - taps_x + 1, height - taps_y + 1};
}

void visit_windows(const Plane<double>& a, const Plane<double>& b, int threads,
                   const std::function<void(int x, int y, const WindowMoments&)>& visit) {
  const WindowGrid grid = windows_of(a.width(), a.height());
  const Plane<WindowMoments> rows = filter_rows(a, b, grid.width, threads);
  const std::vector<double> kernel = gaussian(grid.taps_y);
  parallel_for(grid.height, kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        WindowMoments sum;
        for (int i = 0; i < grid.taps_y; ++i) sum.add(kernel[static_cast<std::size_t>(i)], rows.at(x, y + i));
        visit(x, y, sum);
      }
    }
  });
}

double mean_of_windows(const Plane<float>& values, const Mask* valid, double none) {
  if (valid == nullptr) return mean_of_all(values);
  const int taps_x = valid->width() - values.width() + 1, taps_y = valid->height() - values.height() + 1;
  const Plane<int> sums = invalid_sums(*valid);
  double sum = 0;
  long long count = 0;
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const int invalid =
          sums.at(x + taps_x, y + taps_y) - sums.at(x, y + taps_y) - sums.at(x + taps_x, y) + sums.at(x, y);
      if (invalid > 0) continue;
      sum += static_cast<double>(values.at(x, y));
      ++count;
    }
  }
  return count == 0 ? none : sum / static_cast<double>(count);
}

}  // namespace plenolab
