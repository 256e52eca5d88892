#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/synthesis/epipolar_path.h"
#include "core/synthesis/prepared_view.h"

namespace plenolab {

/// A correspondence: A = (i + fx + 0.5, j + fy + 0.5) in the key view, fx, fy in [0, 1), 0 on the last column
/// or row. i = −1: out of frustum.
struct Hit {
  int i = -1, j = -1;
  float fx = 0, fy = 0;
  bool found() const { return i >= 0; }
  friend bool operator==(const Hit&, const Hit&) = default;
};

/// How much was looked at.
struct SearchCounts {
  std::uint64_t samples = 0;  ///< first pass
  std::uint64_t refine = 0;   ///< second pass
  SearchCounts& operator+=(const SearchCounts& other) {
    samples += other.samples;
    refine += other.refine;
    return *this;
  }
};

/// Disparity of a prepared view, bilinear between pixel (i, j) and its right and lower neighbours.
float bilinear_disparity(const PreparedView& view, int i, int j, float fx, float fy);

/// Which samples of the path may be hits for the pixels of a tile of the novel view: one bit per tabulated
/// sample. The last sample's bit (d = 0, always a hit) is set in every tile.
struct TileOccupancy {
  static constexpr int kTileWidth = 16, kTileHeight = 8;
  int tiles_x = 0, tiles_y = 0;
  int words = 0;  ///< 64-bit words per tile
  std::vector<std::uint64_t> bits;
  std::span<const std::uint64_t> tile(int x, int y) const {
    return {bits.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_x) +
                           static_cast<std::size_t>(x)) *
                              static_cast<std::size_t>(words),
            static_cast<std::size_t>(words)};
  }
  std::span<const std::uint64_t> tile_of_pixel(int x, int y) const {
    return tile(x / kTileWidth, y / kTileHeight);
  }
};

/// The occupancy of a novel view for one key view. No sample that the linear search would stop at is left
/// out; the proof is with the implementation.
TileOccupancy build_occupancy(const PreparedView& view, const EpipolarPath& path, int threads);

/// An occupancy with nothing but the last sample's bits: exact where d_max is below one step.
TileOccupancy last_sample_only(const EpipolarPath& path);

/// Rule 1 for one pixel, sample by sample. With an empty `candidates` every sample of the path is looked at
/// in turn (the linear search); otherwise only those whose bit is set (a tile of a TileOccupancy).
Hit search_pixel(const PreparedView& view, const EpipolarPath& path,
                 std::span<const std::uint64_t> candidates, int x, int y, SearchCounts& counts);

/// A rectangle of the novel view whose left edge is a multiple of the tile width and whose top edge is a
/// multiple of the tile height; at most kMaxWidth × kTileHeight pixels.
struct Patch {
  static constexpr int kMaxWidth = 256;
  static constexpr int kMaxPixels = kMaxWidth * TileOccupancy::kTileHeight;
  int x = 0, y = 0, width = 0, height = 0;
};

/// Correspondences of a patch as arrays, row by row with kMaxWidth values a row.
struct PatchHits {
  alignas(64) std::int32_t i[Patch::kMaxPixels];
  alignas(64) std::int32_t j[Patch::kMaxPixels];
  alignas(64) float fx[Patch::kMaxPixels];
  alignas(64) float fy[Patch::kMaxPixels];
  Hit get(int index) const { return {i[index], j[index], fx[index], fy[index]}; }
  void set(int index, const Hit& hit) {
    i[index] = hit.i;
    j[index] = hit.j;
    fx[index] = hit.fx;
    fy[index] = hit.fy;
  }
};

/// Rule 1 for a patch with vector instructions; the same hits as search_pixel, bit for bit, on every
/// processor.
SearchCounts search_patch(const PreparedView& view, const EpipolarPath& path, const TileOccupancy& occupancy,
                          const Patch& patch, PatchHits& hits);

}  // namespace plenolab
