#pragma once

#include <vector>

#include "stimuli/render.h"

namespace plenolab::tracer {

/// Stages of the renderer that a scene needs. Leaving out the others changes no bit of the result: each use
/// of random numbers has its own dimension, and an absent light adds exactly 0.
struct Features {
  bool emitters = true;    ///< sampling of lamps
  bool sun = true;         ///< sampling of the sun
  bool sky = true;         ///< sampling of sky, ground and portals
  bool patches = true;     ///< joining walls to patches of sunlight behind portals
  bool absorption = true;  ///< Beer-Lambert inside dielectrics
  bool extinction = true;  ///< attenuation by the medium
  bool scattering = true;  ///< single scattering in the medium
  bool paths = true;       ///< anything beyond the first hit

  static Features all() { return {}; }
};

/// Decides from the scene alone. `left_out` receives each stage left out with the reason.
Features features_of(const Scene& scene, std::vector<PrunedStage>& left_out);

}  // namespace plenolab::tracer
