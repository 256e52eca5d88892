#pragma once

#include <string>
#include <vector>

#include "experiments/reproduce/tonemap/mappings.h"

namespace plenolab {

/// Numbers of motions that claims compare, one of each line of a scene (kMotionLines of them, in order).

/// Largest change of the brightness of surfaces under unchanged light from one frame to the next (luma, ≥ 0).
std::vector<double> largest_steps(MappingBench& bench, const std::string& scene, const Mapping& mapping);
double largest_step(const MappedMotion& motion);

/// Range of the adaptation track: how far the mapping adapts over the motion (luma, ≥ 0).
std::vector<double> adaptation_ranges(MappingBench& bench, const std::string& scene, const Mapping& mapping);
double adaptation_range(const MappedMotion& motion);

}  // namespace plenolab
