#pragma once

#include <array>

#include "core/reprojection/reprojection.h"

namespace plenolab {

/// How far the matches of a reprojection are off.
struct MatchResiduals {
  /// Equal bins from 0 to half a pixel of the offset at which a pixel was accepted
  /// (ReprojectionResult::offset_px).
  static constexpr std::size_t kOffsetBins = 10;
  /// Lower ends of the bins of displacement, px.
  static constexpr std::array<double, 12> kDisplacements_px{0, 0.1, 0.2, 0.3, 0.4, 0.5, 1, 2, 4, 8, 16, 32};

  std::array<double, kOffsetBins> offsets{};                     ///< matches by offset
  std::array<double, kDisplacements_px.size()> displacements{};  ///< matches by displacement
  double matches = 0;
  double largest_offset_px = 0;
  /// A displacement is what the disparity that was taken and the true one at the target pixel differ by,
  /// times the cameras from the nearest corner: the least that a wrong disparity moves a pixel by.
  double largest_displacement_px = 0;
  /// Matches displaced by more than half a pixel …
  double beyond_half = 0;
  double outline = 0;  ///< … whose depth is that of one of the eight pixels around: an outline off by one
  double background = 0;  ///< … of the others: something behind the true surface was taken
  double foreground = 0;  ///< … of the others: something in front of it was taken

  /// Share of the matches displaced by at least kDisplacements_px[bin].
  double share_from(std::size_t bin) const;
  void add(const MatchResiduals& other);
};

/// Of a reprojection with maps recorded, against the true disparity (px per camera) of every pixel. Rendered
/// corners and holes are no matches.
MatchResiduals match_residuals(const ReprojectionResult& result, const CameraArray& array,
                               const Plane<float>& true_disparity_px);

}  // namespace plenolab
