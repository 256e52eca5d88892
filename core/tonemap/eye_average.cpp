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

/// How many of the eight neighbours of each inner pixel of a row are at least as bright.
void count_brighter(const Plane<float>& luminance, int y, std::span<int> count) {
  const float *above = luminance.row(y - 1), *row = luminance.row(y), *below = luminance.row(y + 1);
  for (std::size_t x = 1; x + 1 < count.size(); ++x) {
    const float here = row[x];
    count[x] = (above[x - 1] >= here) + (above[x] >= here) + (above[x + 1] >= here) + (row[x - 1] >= here) +
               (row[x + 1] >= here) + (below[x - 1] >= here) + (below[x] >= here) + (below[x + 1] >= here);
  }
}

double sum_of_row(const Plane<float>& luminance, int y, std::vector<int>& brighter) {
  const int width = luminance.width();
  std::fill(brighter.begin(), brighter.end(), 0);
  if (y > 0 && y + 1 < luminance.height()) count_brighter(luminance, y, brighter);
  double sum = 0;
  for (int x = 0; x < width; ++x) {
    const bool counts_whole = brighter[static_cast<std::size_t>(x)] + 1 >= static_cast<int>(kCountedRank);
    sum += static_cast<double>(counts_whole ? luminance.at(x, y)
                                            : std::min(luminance.at(x, y), third_around(luminance, x, y)));
  }
  return sum;
}

}  // namespace

double eye_average(const SceneImage& view, int threads) {
  if (view.empty()) return 0;
  const Plane<float> luminance = repaired_luminance(view, threads);
  std::vector<double> rows(static_cast<std::size_t>(view.height()));
  parallel_for(view.height(), 16, threads, [&](int begin, int end) {
    std::vector<int> brighter(static_cast<std::size_t>(view.width()));
    for (int y = begin; y < end; ++y) rows[static_cast<std::size_t>(y)] = sum_of_row(luminance, y, brighter);
  });
  return std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(view.size());
}

}  // namespace plenolab
