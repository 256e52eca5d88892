#pragma once

#include <cstdint>
#include <span>

#include "core/reprojection/epipolar_match.h"

namespace plenolab::reprojection {

/// A subimage to fill and what it is reprojected from.
struct SearchTask {
  int column = 0, row = 0, size_px = 1;
  float max_disparity_px = 0;  ///< of all sources
  std::span<const Source> sources;
};

/// Writes the key of the best candidate of every pixel of the subimage, row by row; 0 where there is none.
using Search = void (*)(const SearchTask& task, std::span<std::uint64_t> keys);

/// Walks the epipolar line of every pixel in every source, with the pixels beside it.
void search_literally(const SearchTask& task, std::span<std::uint64_t> keys);

/// Sends every source pixel to where it lands and keeps the nearest: the same candidates, since each pixel
/// belongs to one target pixel, and the walk for that one tests all pixels that belong to it.
void search_by_splatting(const SearchTask& task, std::span<std::uint64_t> keys);

}  // namespace plenolab::reprojection
