#include "stimuli/tracer/path.h"

namespace plenolab::tracer {

// Share of light scattered at `distance_m` that reaches the start of the segment's ray, per metre of segment.
Rgb Path::up_to(const MediumSegment& segment, float distance_m) const {
  const float medium = std::exp(-extinction_per_m(world_.medium) * (distance_m - segment.near_m));
  return transmittance(inside_.absorption_per_m(), distance_m) * (medium * world_.medium.scattering_per_m);
}

Rgb Path::scattered_sunlight(const MediumSegment& segment, const PathSampler& sampler) {
  const MediumPoint at = sample_transmittance(segment, extinction_per_m(world_.medium),
                                              sampler.get_1d(dimension(kMediumSunDistance)));
  const Vec3 position = ray_.origin + at.distance_m * ray_.direction;
  const Vec3 direction = world_.sun.sample(sampler.get_2d(dimension(kMediumSun)));
  const float phase = henyey_greenstein(direction.dot(ray_.direction), world_.medium.anisotropy);
  const Rgb light = world_.sun.disc_radiance() * (phase / (at.pdf * world_.sun.pdf()));
  return light * up_to(segment, at.distance_m) * unoccluded({position, direction}, kInfinity);
}

Rgb Path::scattered_lamplight(const MediumSegment& segment) {
  const auto lamp = world_.emitters.sample(random_1d(kMediumLamp), random_2d(kMediumLampPoint));
  if (!lamp) return {};
  const MediumPoint at = sample_equiangular(segment, ray_, lamp->position_m, random_1d(kMediumLampDistance));
  const Vec3 position = ray_.origin + at.distance_m * ray_.direction;
  const float distance = (lamp->position_m - position).norm();
  if (!(distance > 1e-5f && at.pdf > 0)) return {};
  const Vec3 direction = (lamp->position_m - position) / distance;
  const Rgb emitted_here = emitted(*lamp->material, lamp->normal, -direction);
  if (is_black(emitted_here)) return {};
  const float geometry = std::abs(lamp->normal.dot(direction)) / (distance * distance);
  const float phase = henyey_greenstein(direction.dot(ray_.direction), world_.medium.anisotropy);
  const Rgb light = emitted_here * (phase * geometry / (at.pdf * lamp->pdf_area));
  return light * up_to(segment, at.distance_m) * unoccluded({position, direction}, distance * (1 - 1e-4f));
}

}  // namespace plenolab::tracer
