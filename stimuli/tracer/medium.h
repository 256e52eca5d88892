#pragma once

#include <optional>

#include "stimuli/tracer/ray_scene.h"

namespace plenolab::tracer {

/// The part of a ray inside the medium's box.
struct MediumSegment {
  float near_m = 0, far_m = 0;
  float length() const { return far_m - near_m; }
};

/// Clips [0, distance_m] of a ray to the box; length 0 if they do not meet.
MediumSegment clip_to(const Medium& medium, const Ray& ray, float distance_m);

/// exp(−σ_t · length inside the box) over the first `distance_m` of a ray.
float medium_transmittance(const Medium& medium, const Ray& ray, float distance_m);

inline float extinction_per_m(const Medium& medium) {
  return medium.scattering_per_m + medium.absorption_per_m;
}

/// Henyey-Greenstein phase function, per steradian; `cosine` between the directions of travel before and
/// after.
float henyey_greenstein(float cosine, float anisotropy);

/// A point on a segment with its density per metre.
struct MediumPoint {
  float distance_m = 0;
  float pdf = 0;
};

/// Density proportional to the transmittance from the start of the segment: for light that is even along it
/// (sun).
MediumPoint sample_transmittance(const MediumSegment& segment, float extinction_per_m, float u);

/// Density proportional to 1/d² to a light at `light_m` (Kulla & Fajardo 2012, equi-angular sampling).
MediumPoint sample_equiangular(const MediumSegment& segment, const Ray& ray, const Vec3& light_m, float u);

}  // namespace plenolab::tracer
