#pragma once

#include <cstdint>
#include <vector>

#include "analysis/claims.h"

namespace plenolab {

/// How claims about positions of the observers' line are decided from the gain of one method over another at
/// each of them. A position is one unit, whatever it is compared with: every reference gets its own verdict.

/// Share of the positions at which the gain exceeds a threshold, with its interval within [0, 1], neighbours
/// drawn kPositionsTogether at a time. From 0 to 1 where there are too few positions for an interval.
Interval share_above(const std::vector<double>& gains_db, double threshold_db, std::uint64_t seed);

/// "At most positions" (D-1): the share is above one half.
Verdict decide_most_positions(const Interval& share, std::size_t positions);

/// "In certain areas" (D-3): there are such positions, and they are fewer than half. Refuted if there is none
/// at all among the positions or if they are more than half; undecided while the interval holds 0 or 0.5.
Verdict decide_certain_areas(const Interval& share, std::size_t positions);

/// Length of the longest run of positions at which the gain exceeds a threshold, each standing for `step_m`.
double widest_area_m(const std::vector<double>& gains_db, double threshold_db, double step_m);

}  // namespace plenolab
