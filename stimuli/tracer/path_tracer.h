#pragma once

#include <cstdint>

#include "stimuli/tracer/emitters.h"
#include "stimuli/tracer/features.h"
#include "stimuli/tracer/portals.h"
#include "stimuli/tracer/ray_scene.h"
#include "stimuli/tracer/sampler.h"
#include "stimuli/tracer/sky_light.h"
#include "stimuli/tracer/sun_light.h"
#include "stimuli/tracer/sun_patches.h"

namespace plenolab::tracer {

/// Everything a path needs to know about a scene. The scene must outlive it.
struct World {
  const Scene& scene;
  RayScene rays;
  Emitters emitters;
  SunLight sun;
  SunPatches patches;
  SkyLight sky;
  Portals portals;
  Medium medium;  ///< an empty box if the scene has none

  explicit World(const Scene& scene);
};

struct RayCounts {
  std::uint64_t bounce = 0, shadow = 0;
};

/// What one camera ray sees.
struct PathResult {
  Rgb radiance;          ///< cd/m², one unbiased sample of all paths up to Scene::max_bounces
  float distance_m = 0;  ///< to the first surface; ∞ for the sky
};

/// Traces one path from the camera: next-event estimation of lamps, sun and sky (the best of several
/// candidates each, by resampling) at every surface that is not specular, combined with sampling by the BSDF
/// (power heuristic), joined to patches of sunlight behind openings, single scattering of lamps and sun along
/// every segment, Russian roulette by what is left of the light. The first surface that is not specular
/// draws several times: its textures are dear, more rays from it are not. Sample dimension 0 belongs to the
/// caller.
PathResult trace_path(const World& world, const Features& features, const Ray& camera_ray,
                      const PathSampler& sampler, RayCounts& counts);

}  // namespace plenolab::tracer
