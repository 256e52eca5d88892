#pragma once

#include <array>

#include "core/lightfield/light_field.h"

namespace plenolab {

/// Displacements the self-check tries along one axis; its hypotheses about a whole light field combine them.
enum class Displacement { kStated, kFlipped, kSwapped, kHalf, kTwice, kNone };
inline constexpr int kDisplacements = 6;

/// Factors on disparity the self-check tries: kScales of them in equal ratios over [0.4, 2.5].
inline constexpr int kScales = 47;
double scale_at(int i);

/// Fewer textured pixels than this say nothing about a pair of views.
inline constexpr int kMinSamples = 64;

/// How well two neighbouring views match after warping: the median absolute difference of gamma-encoded
/// luminance for each displacement and each scale, +Inf where too little of the views overlaps.
struct PairErrors {
  bool usable = false;  ///< enough textured pixels were compared
  bool vertical = false;
  std::array<double, kDisplacements> error{};
  std::array<double, kScales> scale_error{};
};

/// Compares view P with view Q, its neighbour to the right or, with `vertical`, below. `ratio` is the
/// vertical spacing over the horizontal one; at most about `max_samples` pixels are looked at.
PairErrors compare_neighbours(const KeyView<SceneReferred>& p, const KeyView<SceneReferred>& q, bool vertical,
                              double ratio, int max_samples);
PairErrors compare_neighbours(const KeyView<DisplayReferred>& p, const KeyView<DisplayReferred>& q,
                              bool vertical, double ratio, int max_samples);

}  // namespace plenolab
