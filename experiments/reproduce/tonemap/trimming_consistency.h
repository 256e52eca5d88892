#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduce/tonemap/tone_scene.h"

namespace plenolab {

/// Two neighbouring key views, each mapped by histogram adjustment with its own histogram.
struct NeighbourChange {
  std::int64_t pixels = 0;  ///< of the first view that show the same surface under the same light in both
  double rms = 0;           ///< change of their luma from view to view
  double floor_rms = 0;     ///< the same with the curve of the first view for both: noise and sampling

  /// What the difference of the curves adds: √(rms² − floor_rms²), 0 if negative.
  double added() const;
};

/// Two views whose numbers of trimming passes differ.
struct DifferentPasses {
  double rms = 0;       ///< change of luma from view to view
  double same_rms = 0;  ///< the same if the second view is trimmed as often as the first

  /// What the different numbers add: √(rms² − same_rms²), 0 if negative.
  double added() const;
};

/// How the key views of a scene are mapped by histograms of their own.
struct TrimmingConsistency {
  std::string scene, title;
  HistogramCeiling ceiling = HistogramCeiling::kPerceptual;
  std::optional<int> fixed_passes;
  std::vector<std::size_t> passes;     ///< of each key view
  std::size_t linear_views = 0;        ///< that were mapped linearly
  std::vector<NeighbourChange> pairs;  ///< neighbours with corresponding pixels
  std::size_t neighbours = 0;  ///< pairs of views beside or below each other, with and without such pixels
  /// Those of them whose numbers of passes differ.
  std::vector<DifferentPasses> different;

  /// Mean and largest added change of the pairs; 0 without pairs.
  double mean_added() const;
  double largest_added() const;
};

/// Maps all key views and compares each with its right and lower neighbour, over pixels that correspond
/// (change_along_lines).
TrimmingConsistency measure_trimming_consistency(const ToneScene& scene, HistogramCeiling ceiling,
                                                 std::optional<int> fixed_passes, int threads);

/// Numbers of passes and linear views alone: no pairs.
TrimmingConsistency count_trimming_passes(const ToneScene& scene, const HistogramOptions& options,
                                          int threads);

/// A change of luma that is just visible on the display of the operator's defaults: one just noticeable
/// difference at luma 0.5.
double visible_luma_change();

}  // namespace plenolab
