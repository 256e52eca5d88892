#pragma once

#include <array>
#include <span>

#include "stimuli/tracer/maths.h"

namespace plenolab::tracer {

/// Light that could reach a surface along one drawn direction, over the density of the draw.
struct LightCandidate {
  Vec3 direction;
  float distance_m = 0;
  Rgb light;
};

/// Draws one of several candidates in proportion to what it would bring if nothing were in the way (resampled
/// importance sampling, Talbot, Cline & Egbert 2005); its light is scaled so that the mean over draws is that
/// of all candidates. Black if all are.
LightCandidate resample(std::span<const LightCandidate> candidates, float u);

/// Candidate `index` of `count` random numbers spread evenly from one: each alone is uniform in [0, 1).
float spread(float u, std::size_t index, std::size_t count);

/// The same in two dimensions: the R2 sequence (Roberts 2018) from a random start.
std::array<float, 2> spread(std::array<float, 2> u, std::size_t index);

}  // namespace plenolab::tracer
