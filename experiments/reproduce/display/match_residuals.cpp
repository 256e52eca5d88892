#include "experiments/reproduce/display/match_residuals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plenolab {

namespace {

constexpr double kHalf_px = 0.5;

/// Whether one of the eight pixels around, in the same subimage, has the disparity that was taken.
bool belongs_to_neighbour(const Plane<float>& truth, int size_px, int x, int y, float taken, int cameras) {
  const int left = x / size_px * size_px, top = y / size_px * size_px;
  for (int j = std::max(y - 1, top); j <= std::min(y + 1, top + size_px - 1); ++j)
    for (int i = std::max(x - 1, left); i <= std::min(x + 1, left + size_px - 1); ++i)
      if (cameras * static_cast<double>(std::abs(taken - truth.at(i, j))) <= kHalf_px) return true;
  return false;
}

void count(MatchResiduals& residuals, double offset_px, double displacement_px) {
  ++residuals.matches;
  const auto bin = static_cast<std::size_t>(offset_px / kHalf_px * MatchResiduals::kOffsetBins);
  ++residuals.offsets[std::min(bin, MatchResiduals::kOffsetBins - 1)];
  const auto& ends = MatchResiduals::kDisplacements_px;
  const auto above = std::upper_bound(ends.begin(), ends.end(), displacement_px) - ends.begin();
  ++residuals.displacements[static_cast<std::size_t>(above - 1)];
  residuals.largest_offset_px = std::max(residuals.largest_offset_px, offset_px);
  residuals.largest_displacement_px = std::max(residuals.largest_displacement_px, displacement_px);
}

}  // namespace

double MatchResiduals::share_from(std::size_t bin) const {
  return std::accumulate(displacements.begin() + static_cast<std::ptrdiff_t>(bin), displacements.end(), 0.0) /
         std::max(matches, 1.0);
}

void MatchResiduals::add(const MatchResiduals& other) {
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] += other.offsets[i];
  for (std::size_t i = 0; i < displacements.size(); ++i) displacements[i] += other.displacements[i];
  matches += other.matches;
  largest_offset_px = std::max(largest_offset_px, other.largest_offset_px);
  largest_displacement_px = std::max(largest_displacement_px, other.largest_displacement_px);
  beyond_half += other.beyond_half;
  outline += other.outline;
  background += other.background;
  foreground += other.foreground;
}

MatchResiduals match_residuals(const ReprojectionResult& result, const CameraArray& array,
                               const Plane<float>& truth) {
  MatchResiduals residuals;
  const SubimageLayout& layout = array.layout;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x) {
      const float taken = result.disparity_px.at(x, y);
      const int column = x / layout.size_px, row = y / layout.size_px;
      const int cameras =
          std::max(std::min(column, layout.columns - 1 - column), std::min(row, layout.rows - 1 - row));
      if (taken < 0 || cameras == 0) continue;
      const double displacement_px = cameras * static_cast<double>(std::abs(taken - truth.at(x, y)));
      count(residuals, static_cast<double>(result.offset_px.at(x, y)), displacement_px);
      if (displacement_px <= kHalf_px) continue;
      ++residuals.beyond_half;
      if (belongs_to_neighbour(truth, layout.size_px, x, y, taken, cameras))
        ++residuals.outline;
      else
        ++(taken < truth.at(x, y) ? residuals.background : residuals.foreground);
    }
  return residuals;
}

}  // namespace plenolab
