#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/image/image.h"

namespace plenolab::reprojection {

/// What the literal and the fast search share: where pixels land, which of them are on an epipolar line, and
/// the colour taken. Every number is computed here, so that both agree bit by bit.

/// Disparity of a pixel that matches nothing.
inline constexpr float kNoDepth = -1;

/// A subimage that others are reprojected from; rows of both arrays are `stride` apart.
struct Source {
  const Rgb* colour = nullptr;
  const float* disparity_px = nullptr;  ///< per camera; kNoDepth where nothing matches
  int colour_stride = 0, disparity_stride = 0;
  int column = 0, row = 0;
};

/// The pixel whose centre is nearest, of position p relative to pixel centres; halves go up.
inline int nearest_pixel(float p) {
  const float up = p + 0.5f;
  const int i = static_cast<int>(up);
  return i - (up < static_cast<float>(i) ? 1 : 0);
}

/// Where pixel `x` of a camera lands in one `cameras` to the right: content moves left.
inline float landing(int x, float disparity_px, int cameras) {
  return static_cast<float>(x) - disparity_px * static_cast<float>(cameras);
}

/// The epipolar line of one target camera in one source camera: offsets from the target pixel.
class EpipolarLine {
 public:
  /// Columns and rows from the source to the target.
  EpipolarLine(int columns, int rows, int size_px)
      : along_x_(std::abs(columns) >= std::abs(rows)),
        major_(along_x_ ? columns : rows),
        minor_(along_x_ ? rows : columns),
        offsets_(static_cast<std::size_t>(size_px)) {
    const float slope =
        major_ == 0 ? 0 : static_cast<float>(std::abs(minor_)) / static_cast<float>(std::abs(major_));
    for (std::size_t k = 0; k < offsets_.size(); ++k)
      offsets_[k] = (minor_ < 0 ? -1 : 1) * nearest_pixel(static_cast<float>(k) * slope);
  }
  bool along_x() const { return along_x_; }
  /// +1 or −1: the way along the major axis to nearer surfaces.
  int direction() const { return major_ < 0 ? -1 : 1; }
  /// Offset along the minor axis at `k` ≥ 0 steps along the major one, rounded.
  int minor_offset(int k) const { return offsets_[static_cast<std::size_t>(k)]; }
  /// A pixel may land up to half a pixel aside on both axes, so those up to this many from minor_offset() can
  /// match as well.
  int minor_reach() const { return minor_ == 0 ? 0 : 1; }
  /// Steps until no pixel of a disparity up to `max_px` can land on the target pixel.
  int steps(float max_px) const {
    const float reach = max_px * static_cast<float>(std::abs(major_)) + 2;
    return reach < static_cast<float>(offsets_.size()) ? static_cast<int>(reach)
                                                       : static_cast<int>(offsets_.size()) - 1;
  }

 private:
  bool along_x_;
  int major_, minor_;
  std::vector<int> offsets_;
};

inline Rgb blend(Rgb a, Rgb b, float t) {
  return a + (b - a) * t;
}

/// Colour at the point of the source that lands on the centre of the target pixel: (x, y) lands
/// (offset_x, offset_y) from it.
inline Rgb corrected_colour(const Source& source, int size, int x, int y, float offset_x, float offset_y) {
  const int x1 = std::clamp(offset_x < 0 ? x + 1 : x - 1, 0, size - 1),
            y1 = std::clamp(offset_y < 0 ? y + 1 : y - 1, 0, size - 1);
  const float tx = std::abs(offset_x), ty = std::abs(offset_y);
  const auto at = [&](int i, int j) {
    return source.colour[static_cast<std::ptrdiff_t>(j) * source.colour_stride + i];
  };
  if (tx == 0) return blend(at(x, y), at(x, y1), ty);
  const Rgb here = blend(at(x, y), at(x1, y), tx);
  if (ty == 0) return here;
  return blend(here, blend(at(x, y1), at(x1, y1), tx), ty);
}

/// Largest side of a subimage and number of sources that candidate keys have room for.
inline constexpr int kMaxSize = 1 << 14;
inline constexpr std::size_t kMaxSources = 15;

/// A pixel of a source.
struct Candidate {
  std::uint32_t source = 0;  ///< index
  int x = 0, y = 0;
  float disparity_px = 0;
};

/// Orders candidates as one number, largest first: by disparity, then sources as given, then pixels in
/// reading order. 0 is no candidate. Disparities are ≥ 0, whose bits grow with them.
inline std::uint64_t candidate_key(float disparity_px, std::uint32_t source, int x, int y) {
  const std::uint32_t tie =
      (source << 28) | (static_cast<std::uint32_t>(y) << 14) | static_cast<std::uint32_t>(x);
  return (static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(disparity_px)) << 32) | ~tie;
}

inline Candidate candidate_of(std::uint64_t key) {
  const std::uint32_t tie = ~static_cast<std::uint32_t>(key);
  return {tie >> 28, static_cast<int>(tie & (kMaxSize - 1)), static_cast<int>((tie >> 14) & (kMaxSize - 1)),
          std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32))};
}

}  // namespace plenolab::reprojection
