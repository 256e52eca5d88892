#pragma once

#include <string>
#include <vector>

#include "core/tonemap/bilateral.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// The edge of figures 21, 23 and 24: a foreground that is brighter than the background behind it by a
/// fifth of a log10 unit, far less than σ_l = 0.4. Both reach so far that the middle of each is free of the
/// other.
inline constexpr double kEdgeStep_log10 = 0.2;
inline constexpr int kEdgeWidth_px = 512;  ///< the foreground is the left half

/// One row of the layers of the edge and of what the operator makes of them; log10 units.
struct EdgeProfile {
  std::vector<double> input, base, detail;
  std::vector<double> temporary, foreground;  ///< of the enhanced operator with a foreground layer
  std::vector<double> target;

  /// Log difference of the two pixels at the edge.
  double input_step() const;
  double target_step() const;
  /// Log difference of target between the middles of both surfaces, which the profiles do not reach.
  double target_level() const;
  /// How far the target beside the edge departs from that in the middle of the surface: the Cornsweet
  /// profile, > 0 where it raises.
  double foreground_profile() const;
  double background_profile() const;
};

enum class EdgeOperator {
  kNaive,
  kWithoutForeground,  ///< enhanced, foreground scale 0
  kEnhanced,           ///< enhanced, foreground scale 1 − compression
};

/// The edge through the operator with the exact filter, compression 0.4 and the default widths.
EdgeProfile trace_edge(EdgeOperator which, int threads = 0);

/// Adds the plot of the profile around the edge, and the rows edge_step_input, edge_step_target,
/// level_difference_target, profile_foreground and profile_background (log10 units) with the column operator.
void add_edge(ReproductionResult& result, const EdgeProfile& profile, const std::string& name,
              const std::string& caption);

}  // namespace plenolab
