#include "core/reprojection/search.h"

namespace plenolab::reprojection {

namespace {

bool inside(int i, int size) {
  return i >= 0 && i < size;
}

/// Best candidate of one source for the target pixel (x, y).
std::uint64_t walk(const Source& source, std::uint32_t index, const EpipolarLine& line,
                   const SearchTask& task, int x, int y) {
  const int columns = task.column - source.column, rows = task.row - source.row;
  std::uint64_t best = 0;
  const auto test = [&](int sx, int sy) {
    const float disparity =
        source.disparity_px[static_cast<std::ptrdiff_t>(sy) * source.disparity_stride + sx];
    if (disparity < 0) return;
    if (nearest_pixel(landing(sx, disparity, columns)) == x &&
        nearest_pixel(landing(sy, disparity, rows)) == y)
      best = std::max(best, candidate_key(disparity, index, sx, sy));
  };
  const int steps = line.steps(task.max_disparity_px), reach = line.minor_reach();
  for (int k = 0; k <= steps; ++k)
    for (int aside = -reach; aside <= reach; ++aside) {
      const int major = line.direction() * k, minor = line.minor_offset(k) + aside;
      const int sx = x + (line.along_x() ? major : minor), sy = y + (line.along_x() ? minor : major);
      if (inside(sx, task.size_px) && inside(sy, task.size_px)) test(sx, sy);
    }
  return best;
}

}  // namespace

void search_literally(const SearchTask& task, std::span<std::uint64_t> keys) {
  std::fill(keys.begin(), keys.end(), 0);
  for (std::uint32_t i = 0; i < task.sources.size(); ++i) {
    const Source& source = task.sources[i];
    const EpipolarLine line(task.column - source.column, task.row - source.row, task.size_px);
    std::size_t at = 0;
    for (int y = 0; y < task.size_px; ++y)
      for (int x = 0; x < task.size_px; ++x, ++at)
        keys[at] = std::max(keys[at], walk(source, i, line, task, x, y));
  }
}

}  // namespace plenolab::reprojection
