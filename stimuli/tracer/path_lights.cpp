#include <span>

#include "stimuli/tracer/path.h"

namespace plenolab::tracer {

LightCandidate Path::lamp_candidate(const Surface& surface, const Vec3& origin, float select,
                                    std::array<float, 2> u) const {
  const auto lamp = world_.emitters.sample(select, u);
  if (!lamp) return {};
  const float distance = (lamp->position_m - origin).norm();
  if (!(distance > 1e-5f)) return {};
  const Vec3 direction = (lamp->position_m - origin) / distance;
  const float cosine = std::abs(lamp->normal.dot(direction));
  const Rgb light = emitted(*lamp->material, lamp->normal, -direction);
  if (is_black(light) || !(cosine > 0)) return {};
  const BsdfValue bsdf = evaluate_bsdf(surface, direction);
  const float pdf = lamp->pdf_area * distance * distance / cosine;
  return {direction, distance * (1 - 1e-4f), light * bsdf.f_cos * (power_heuristic(pdf, bsdf.pdf) / pdf)};
}

LightCandidate Path::sky_candidate(const Surface& surface, const Vec3& origin, float select,
                                   std::array<float, 2> u) const {
  const DirectionSample sky =
      world_.portals.empty() ? world_.sky.sample(u) : world_.portals.sample(origin, select, u);
  if (!(sky.pdf > 0)) return {};
  const BsdfValue bsdf = evaluate_bsdf(surface, sky.direction);
  if (is_black(bsdf.f_cos)) return {};
  const Rgb light = world_.sky.radiance(sky.direction);
  return {sky.direction, kInfinity, light * bsdf.f_cos * (power_heuristic(sky.pdf, bsdf.pdf) / sky.pdf)};
}

Rgb Path::light_of_lamps(const Surface& surface, const Vec3& origin, const PathSampler& sampler) {
  // Lamps near by matter most: found without a ray. Later surfaces are mixed anyway.
  constexpr std::size_t kCandidates = 8, kLaterCandidates = 2;
  const std::size_t count = rough_seen_ ? kLaterCandidates : kCandidates;
  const float select = sampler.get_1d(dimension(kLamp));
  const std::array<float, 2> point = sampler.get_2d(dimension(kLampPoint));
  std::array<LightCandidate, kCandidates> store;
  const std::span candidates(store.data(), count);
  for (std::size_t i = 0; i < count; ++i)
    candidates[i] = lamp_candidate(surface, origin, spread(select, i, count), spread(point, i));
  const LightCandidate chosen = resample(candidates, sampler.get_1d(dimension(kLampChoice)));
  return is_black(chosen.light) ? Rgb{}
                                : chosen.light * unoccluded({origin, chosen.direction}, chosen.distance_m);
}

// Combined with directions drawn by the BSDF here, and with patches drawn at the surface before this one.
Rgb Path::light_of_sun(const Surface& surface, const Vec3& origin, const PathSampler& sampler) {
  const Vec3 direction = world_.sun.sample(sampler.get_2d(dimension(kSun)));
  const BsdfValue bsdf = evaluate_bsdf(surface, direction);
  if (is_black(bsdf.f_cos)) return {};
  const Rgb light = world_.sun.disc_radiance() * bsdf.f_cos * unoccluded({origin, direction}, kInfinity);
  if (is_black(light)) return {};
  const float weight = power_heuristic(world_.sun.pdf(), bsdf.pdf) * patch_mis_weight(surface, direction);
  return light * (weight / world_.sun.pdf());
}

Rgb Path::light_of_sky(const Surface& surface, const Vec3& origin, const PathSampler& sampler) {
  // Portals differ in what they bring; directions drawn from the open sky hardly do.
  constexpr std::size_t kPortalCandidates = 2;
  const std::size_t count = world_.portals.empty() || rough_seen_ ? 1 : kPortalCandidates;
  const float select = sampler.get_1d(dimension(kPortal));
  const std::array<float, 2> u = sampler.get_2d(dimension(kSky));
  std::array<LightCandidate, kPortalCandidates> store;
  const std::span candidates(store.data(), count);
  for (std::size_t i = 0; i < count; ++i)
    candidates[i] = sky_candidate(surface, origin, spread(select, i, count), spread(u, i));
  const LightCandidate chosen = resample(candidates, sampler.get_1d(dimension(kSkyChoice)));
  return is_black(chosen.light) ? Rgb{} : chosen.light * unoccluded({origin, chosen.direction}, kInfinity);
}

// Whether the surface the path has reached is joined to patches of sunlight: if the patch may still be a
// scattering event of this path, and nothing refracts on the way.
bool Path::joins_patches() const {
  return features_.patches && !world_.patches.empty() && inside_.empty() &&
         bounce_ + 1 < world_.scene.max_bounces;
}

// Share of sunlight on this surface that is counted here and not in light_of_patches() of the last one.
float Path::patch_mis_weight(const Surface& surface, const Vec3& sun_direction) const {
  if (!patches_joined_) return 1;
  const float cosine = std::abs(surface.geometric_normal.dot(ray_.direction));
  if (!(cosine > 0)) return 1;
  const float pdf_area = world_.patches.pdf_area(surface.position_m, surface.geometric_normal, sun_direction);
  return power_heuristic(pdf_, pdf_area * square(segment_m_) / cosine);
}

// Sunlight that a patch behind an opening reflects onto this surface: what the path would find by chance with
// its next two steps.
Rgb Path::light_of_patches(const Surface& surface, const Vec3& origin, const PathSampler& sampler) {
  counts_.shadow += 2;
  const auto patch =
      world_.patches.sample(sampler.get_1d(dimension(kPatch)), sampler.get_2d(dimension(kPatchOpening)),
                            sampler.get_2d(dimension(kPatchSun)));
  if (!patch || patch->hit.material->kind == Material::Kind::kEmitter) return {};
  const Vec3 towards = patch->hit.point.position_m - origin;
  const float distance = towards.norm();
  if (!(distance > 1e-5f)) return {};
  const Vec3 direction = towards / distance;
  const float cosine = -patch->hit.geometric_normal.dot(direction);
  const BsdfValue here = evaluate_bsdf(surface, direction);
  if (!(cosine > 0) || is_black(here.f_cos)) return {};
  const Surface lit = surface_at(patch->hit, direction, diffused_ || here.pdf < kNarrowLobe);
  if (lit.specular()) return {};
  const BsdfValue there = evaluate_bsdf(lit, patch->sun_direction);
  if (is_black(there.f_cos)) return {};
  Rgb light = world_.sun.disc_radiance() * there.f_cos * here.f_cos *
              unoccluded({origin, direction}, distance * (1 - 1e-4f));
  if (features_.extinction)
    light = light * medium_transmittance(world_.medium, {lit.position_m, patch->sun_direction}, kInfinity);
  const float pdf = patch->pdf_area * distance * distance / cosine;
  const float weight =
      power_heuristic(world_.sun.pdf(), there.pdf) * power_heuristic(pdf, here.pdf) / world_.sun.pdf();
  return light * (weight / pdf);
}

Rgb Path::direct_light(const Surface& surface) {
  const Vec3 origin = offset_origin(surface.position_m, surface.geometric_normal, surface.geometric_normal);
  // How often to draw at the first surface, by how noisy a single draw is; later surfaces are mixed anyway.
  const auto mean_of = [&](std::uint32_t draws_at_first, auto light) {
    const std::uint32_t draws = rough_seen_ ? 1 : draws_at_first;
    Rgb sum;
    for (std::uint32_t i = 0; i < draws; ++i)
      sum += (this->*light)(surface, origin, sampler_.split(i, draws));
    return sum * (1.0f / static_cast<float>(draws));
  };
  Rgb sum;
  if (features_.emitters) sum += mean_of(1, &Path::light_of_lamps);
  if (features_.sun) sum += mean_of(1, &Path::light_of_sun);
  if (features_.sky) sum += mean_of(world_.portals.empty() ? 1 : 2, &Path::light_of_sky);
  if (joins_patches()) sum += mean_of(1, &Path::light_of_patches);
  return sum;
}

}  // namespace plenolab::tracer
