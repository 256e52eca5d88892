#include "core/reprojection/search.h"

namespace plenolab::reprojection {

namespace {

void keep_larger(std::uint64_t& key, std::uint64_t candidate) {
  key = std::max(key, candidate);
}

bool inside(int i, int size) {
  return static_cast<unsigned>(i) < static_cast<unsigned>(size);
}

/// Cameras side by side: every pixel stays in its row.
void splat_along_rows(const Source& source, std::uint32_t index, int columns, int n, std::uint64_t* keys) {
  for (int y = 0; y < n; ++y) {
    const float* disparity = source.disparity_px + static_cast<std::ptrdiff_t>(y) * source.disparity_stride;
    std::uint64_t* row = keys + static_cast<std::ptrdiff_t>(y) * n;
    for (int x = 0; x < n; ++x) {
      if (disparity[x] < 0) continue;
      const int to = nearest_pixel(landing(x, disparity[x], columns));
      if (inside(to, n)) keep_larger(row[to], candidate_key(disparity[x], index, x, y));
    }
  }
}

/// Cameras above each other: every pixel stays in its column.
void splat_along_columns(const Source& source, std::uint32_t index, int rows, int n, std::uint64_t* keys) {
  for (int y = 0; y < n; ++y) {
    const float* disparity = source.disparity_px + static_cast<std::ptrdiff_t>(y) * source.disparity_stride;
    for (int x = 0; x < n; ++x) {
      if (disparity[x] < 0) continue;
      const int to = nearest_pixel(landing(y, disparity[x], rows));
      if (inside(to, n))
        keep_larger(keys[static_cast<std::ptrdiff_t>(to) * n + x], candidate_key(disparity[x], index, x, y));
    }
  }
}

void splat_aslant(const Source& source, std::uint32_t index, int columns, int rows, int n,
                  std::uint64_t* keys) {
  const EpipolarLine line(columns, rows, n);
  const int* minor_offsets = line.minor_offsets();
  const bool along_x = line.along_x();
  for (int y = 0; y < n; ++y) {
    const float* disparity = source.disparity_px + static_cast<std::ptrdiff_t>(y) * source.disparity_stride;
    for (int x = 0; x < n; ++x) {
      if (disparity[x] < 0) continue;
      const int to_x = nearest_pixel(landing(x, disparity[x], columns)),
                to_y = nearest_pixel(landing(y, disparity[x], rows));
      if (!inside(to_x, n) || !inside(to_y, n)) continue;
      const int major = along_x ? std::abs(x - to_x) : std::abs(y - to_y);
      if ((along_x ? y - to_y : x - to_x) != minor_offsets[major]) continue;
      keep_larger(keys[static_cast<std::ptrdiff_t>(to_y) * n + to_x],
                  candidate_key(disparity[x], index, x, y));
    }
  }
}

}  // namespace

void search_by_splatting(const SearchTask& task, std::span<std::uint64_t> keys) {
  std::fill(keys.begin(), keys.end(), 0);
  for (std::uint32_t i = 0; i < task.sources.size(); ++i) {
    const Source& source = task.sources[i];
    const int columns = task.column - source.column, rows = task.row - source.row;
    if (rows == 0)
      splat_along_rows(source, i, columns, task.size_px, keys.data());
    else if (columns == 0)
      splat_along_columns(source, i, rows, task.size_px, keys.data());
    else
      splat_aslant(source, i, columns, rows, task.size_px, keys.data());
  }
}

}  // namespace plenolab::reprojection
