#pragma once

#include <string>
#include <vector>

#include "core/tonemap/adaptation.h"

namespace plenolab {

/// Tracks of one adapted number at even steps of `step_s` seconds.

/// Adapted to 0 until time 0, when the target becomes 1 and stays: values at times 0, Δt … frames·Δt.
std::vector<double> track_of_step(const AdaptationOptions& options, double step_s, int frames);

/// The second of these values.
double value_after_step(const AdaptationOptions& options, double step_s);

/// How many seconds the value is behind a target that rises steadily, once that no longer changes. Step > 0
/// and shorter than two time constants with explicit Euler, which diverges else.
double lag_on_ramp_s(const AdaptationOptions& options, double step_s);

/// "held target", "linear target" or "explicit Euler".
std::string name_of(AdaptationScheme scheme);

}  // namespace plenolab
