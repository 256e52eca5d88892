#pragma once

#include <optional>

#include "core/tonemap/statistics.h"

namespace plenolab {

/// Time constant of rods, thesis section 5.2.2.
inline constexpr double kRodAdaptation_s = 0.15;

/// How a quantity follows its target between two frames, dS/dt = (T − S)/t0.
enum class AdaptationScheme {
  /// The target of the new frame held over the whole step: S = w·S_prev + (1 − w)·T, w = e^(−Δt/t0) (thesis).
  /// Exact for held targets whatever the step; on a ramp it is ahead of the exact solution by about Δt/2, so
  /// that
  /// its lag is Δt/(e^(Δt/t0) − 1) and differs by 12 ms between 30 and 120 Hz.
  kHeldTarget,
  /// The target taken as linear between two frames: exact for held targets and for ramps (lag t0 at any
  /// rate).
  kLinearTarget,
  /// Explicit Euler, S + Δt/t0·(T − S): for comparison only. Oscillates for Δt > t0, diverges for Δt > 2·t0.
  kExplicitEuler,
};

struct AdaptationOptions {
  double time_constant_s = kRodAdaptation_s;  ///< t0 ≥ 0, finite; 0 follows at once
  AdaptationScheme scheme = AdaptationScheme::kHeldTarget;
  void validate() const;
};

/// S_new = state·S_prev + previous_target·T_prev + target·T. The weights sum to 1.
struct AdaptationWeights {
  double state = 0, previous_target = 0, target = 1;
};

/// Weights of one step of Δt ≥ 0 seconds (∞ allowed): finite and, but for explicit Euler, in [0, 1].
AdaptationWeights adaptation_weights(const AdaptationOptions& options, double step_s);

/// One number followed in time. The state is a value that the caller hands on from frame to frame.
template <class Quantity>
struct Adapted {
  Quantity value{};   ///< S
  Quantity target{};  ///< T of the same frame
  friend bool operator==(const Adapted&, const Adapted&) = default;
};

/// One step from the previous frame's state to the new one. Without a previous state (first frame, cut) the
/// value is the target.
Adapted<double> adapt(const AdaptationOptions& options, const std::optional<Adapted<double>>& previous,
                      double target, double step_s);
/// The same for all numbers of a set of statistics.
Adapted<ImageStatistics> adapt(const AdaptationOptions& options,
                               const std::optional<Adapted<ImageStatistics>>& previous,
                               const ImageStatistics& target, double step_s);

}  // namespace plenolab
