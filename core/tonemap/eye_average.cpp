#include "core/tonemap/eye_average.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/image/repair.h"

namespace plenolab {

namespace {

constexpr std::size_t kCountedRank = 3;

Plane<float> repaired_luminance(const SceneImage& view, int threads) {
  const float largest = largest_finite(view);
  Plane<float> out(view.width(), view.height());
  parallel_for(view.height(), 16, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < view.width(); ++x) {
        const Rgb& c = view.at(x, y);
        out.at(x, y) = luminance(
            {repaired_value(c.r, largest), repaired_value(c.g, largest), repaired_value(c.b, largest)});
      }
  });
  return out;
}

/// The third largest luminance around a pixel, or the smallest of fewer.
float third_around(const Plane<float>& luminance, int x, int y) {
  std::array<float, 9> around;
  std::size_t n = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, luminance.height() - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, luminance.width() - 1); ++u)
      around[n++] = luminance.at(u, v);
  const std::size_t rank = std::min(kCountedRank, n) - 1;
  std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(rank),
                   around.begin() + static_cast<std::ptrdiff_t>(n), std::greater<>());
  return around[rank];
}

/// The three largest of some values, in falling order.
struct Largest {
  float first, second, third;
};

Largest sorted(float a, float b, float c) {
  const float high = std::max(a, b), low = std::min(a, b);
  return {std::max(high, c), std::max(low, std::min(high, c)), std::min(low, c)};
}

Largest merged(const Largest& p, const Largest& q) {
  return {std::max(p.first, q.first), std::max(std::min(p.first, q.first), std::max(p.second, q.second)),
          std::max(std::max(p.third, q.third),
                   std::max(std::min(p.first, q.second), std::min(p.second, q.first)))};
}

/// What each inner pixel of an inner row counts. Minima and maxima only, so that it runs in vectors.
void count_inner(const Plane<float>& luminance, int y, std::span<float> counted) {
  const float *above = luminance.row(y - 1), *row = luminance.row(y), *below = luminance.row(y + 1);
  for (std::size_t x = 1; x + 1 < counted.size(); ++x) {
    const Largest left = sorted(above[x - 1], row[x - 1], below[x - 1]);
    const Largest middle = sorted(above[x], row[x], below[x]);
    const Largest right = sorted(above[x + 1], row[x + 1], below[x + 1]);
    counted[x] = std::min(row[x], merged(merged(left, middle), right).third);
  }
}

double sum_of_row(const Plane<float>& luminance, int y, std::span<float> counted) {
  const int width = luminance.width();
  const bool inner = y > 0 && y + 1 < luminance.height() && width > 2;
  if (inner) count_inner(luminance, y, counted);
  for (int x = 0; x < width; x += inner ? width - 1 : 1)
    counted[static_cast<std::size_t>(x)] = std::min(luminance.at(x, y), third_around(luminance, x, y));
  return std::accumulate(counted.begin(), counted.end(), 0.0);
}

}  // namespace

double eye_average(const SceneImage& view, int threads) {
  if (view.empty()) return 0;
  const Plane<float> luminance = repaired_luminance(view, threads);
  std::vector<double> rows(static_cast<std::size_t>(view.height()));
  parallel_for(view.height(), 16, threads, [&](int begin, int end) {
    std::vector<float> counted(static_cast<std::size_t>(view.width()));
    for (int y = begin; y < end; ++y) rows[static_cast<std::size_t>(y)] = sum_of_row(luminance, y, counted);
  });
  return std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(view.size());
}

}  // namespace plenolab
