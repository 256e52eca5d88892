#include "experiments/reproduce/tonemap/adaptation_tracks.h"

#include <cmath>

#include "core/base/error.h"

namespace plenolab {

std::vector<double> track_of_step(const AdaptationOptions& options, double step_s, int frames) {
  Adapted<double> state{.value = 0, .target = 1};
  std::vector<double> track{state.value};
  for (int i = 0; i < frames; ++i) {
    state = adapt(options, state, 1, step_s);
    track.push_back(state.value);
  }
  return track;
}

double value_after_step(const AdaptationOptions& options, double step_s) {
  return track_of_step(options, step_s, 1).back();
}

double lag_on_ramp_s(const AdaptationOptions& options, double step_s) {
  PLENOLAB_CHECK(step_s > 0, "time passes on a ramp");
  constexpr double kSettled = 60;  // time constants: e^-60 is below what a double resolves
  const int frames = static_cast<int>(std::ceil(kSettled * options.time_constant_s / step_s)) + 1;
  Adapted<double> state;
  for (int i = 1; i <= frames; ++i) state = adapt(options, state, i * step_s, step_s);
  return state.target - state.value;
}

std::string name_of(AdaptationScheme scheme) {
  switch (scheme) {
    case AdaptationScheme::kHeldTarget:
      return "held target";
    case AdaptationScheme::kLinearTarget:
      return "linear target";
    case AdaptationScheme::kExplicitEuler:
      return "explicit Euler";
  }
  return "";
}

}  // namespace plenolab
