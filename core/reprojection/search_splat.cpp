#include "core/reprojection/search.h"

namespace plenolab::reprojection {

namespace {

void keep_larger(std::uint64_t& key, std::uint64_t candidate) {
  key = std::max(key, candidate);
}

bool inside(int i, int size) {
  return static_cast<unsigned>(i) < static_cast<unsigned>(size);
}

/// Rows and columns that the pixels of one source row land in; −1 where there is no depth. A loop without
/// branches, which compilers turn into vector instructions.
void land_columns(const float* disparity, int columns, int n, int* to) {
  for (int x = 0; x < n; ++x) {
    const int landed = nearest_pixel(landing(x, disparity[x], columns));
    to[x] = disparity[x] < 0 ? -1 : landed;
  }
}

void land_rows(const float* disparity, int y, int rows, int n, int* to) {
  for (int x = 0; x < n; ++x) {
    const int landed = nearest_pixel(landing(y, disparity[x], rows));
    to[x] = disparity[x] < 0 ? -1 : landed;
  }
}

const float* row_of(const Source& source, int y) {
  return source.disparity_px + static_cast<std::ptrdiff_t>(y) * source.disparity_stride;
}

/// Cameras side by side: every pixel stays in its row.
void splat_along_rows(const Source& source, std::uint32_t index, int columns, int n, std::uint64_t* keys) {
  std::vector<int> to(static_cast<std::size_t>(n));
  for (int y = 0; y < n; ++y) {
    const float* disparity = row_of(source, y);
    std::uint64_t* row = keys + static_cast<std::ptrdiff_t>(y) * n;
    land_columns(disparity, columns, n, to.data());
    for (int x = 0; x < n; ++x) {
      const int at = to[static_cast<std::size_t>(x)];
      if (inside(at, n)) keep_larger(row[at], candidate_key(disparity[x], index, x, y));
    }
  }
}

/// Cameras above each other: every pixel stays in its column.
void splat_along_columns(const Source& source, std::uint32_t index, int rows, int n, std::uint64_t* keys) {
  std::vector<int> to(static_cast<std::size_t>(n));
  for (int y = 0; y < n; ++y) {
    const float* disparity = row_of(source, y);
    land_rows(disparity, y, rows, n, to.data());
    for (int x = 0; x < n; ++x) {
      const int at = to[static_cast<std::size_t>(x)];
      if (inside(at, n))
        keep_larger(keys[static_cast<std::ptrdiff_t>(at) * n + x], candidate_key(disparity[x], index, x, y));
    }
  }
}

/// Along slanted lines.
void splat_aslant(const Source& source, std::uint32_t index, int columns, int rows, int n,
                  std::uint64_t* keys) {
  std::vector<int> to_column(static_cast<std::size_t>(n)), to_row(static_cast<std::size_t>(n));
  for (int y = 0; y < n; ++y) {
    const float* disparity = row_of(source, y);
    land_columns(disparity, columns, n, to_column.data());
    land_rows(disparity, y, rows, n, to_row.data());
    for (int x = 0; x < n; ++x) {
      const int at_x = to_column[static_cast<std::size_t>(x)], at_y = to_row[static_cast<std::size_t>(x)];
      if (inside(at_x, n) && inside(at_y, n))
        keep_larger(keys[static_cast<std::ptrdiff_t>(at_y) * n + at_x],
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
