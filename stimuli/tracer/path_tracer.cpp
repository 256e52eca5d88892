#include "stimuli/tracer/path_tracer.h"

#include "stimuli/tracer/path.h"

namespace plenolab::tracer {

namespace {

constexpr int kMirrorsBeforeRoulette = 3;
constexpr float kMinSurvival = 0.05f;
constexpr float kCausticAlpha = 0.3f;

}  // namespace

// Transmittance of a shadow ray: 0 if anything is in the way.
Rgb Path::unoccluded(const Ray& ray, float distance_m) {
  ++counts_.shadow;
  if (world_.rays.occluded(ray, distance_m)) return {};
  Rgb passes{1, 1, 1};
  if (features_.extinction) passes = passes * medium_transmittance(world_.medium, ray, distance_m);
  if (features_.absorption) passes = passes * transmittance(inside_.absorption_per_m(), distance_m);
  return passes;
}

// Light scattered towards the path along the segment ahead, then what the segment takes away.
void Path::cross_segment(float distance_m) {
  if (features_.scattering && bounce_ < world_.scene.max_bounces) {
    const MediumSegment segment = clip_to(world_.medium, ray_, distance_m);
    if (segment.length() > 0) {
      if (features_.sun) {
        // The first segment shows the shafts: they fade in and out along it and need several looks.
        const std::uint32_t draws = bounce_ == 0 ? 4 : 1;
        Rgb sum;
        for (std::uint32_t i = 0; i < draws; ++i)
          sum += scattered_sunlight(segment, sampler_.split(i, draws));
        radiance_ += throughput_ * sum * (1.0f / static_cast<float>(draws));
      }
      if (features_.emitters) radiance_ += throughput_ * scattered_lamplight(segment);
    }
  }
  if (features_.extinction) throughput_ = throughput_ * medium_transmittance(world_.medium, ray_, distance_m);
  if (features_.absorption) throughput_ = throughput_ * transmittance(inside_.absorption_per_m(), distance_m);
}

void Path::add_outside_light() {
  if (features_.sun && counts_caustic()) {
    const Rgb disc = world_.sun.radiance(ray_.direction);
    if (!is_black(disc)) radiance_ += throughput_ * disc * mis_weight(world_.sun.pdf());
  }
  if (features_.sky) {
    const Rgb sky = world_.sky.radiance(ray_.direction);
    if (is_black(sky)) return;
    const float pdf = specular_                ? 0.0f
                      : world_.portals.empty() ? world_.sky.pdf(ray_.direction)
                                               : world_.portals.pdf(ray_.origin, ray_.direction);
    radiance_ += throughput_ * sky * mis_weight(pdf);
  }
}

void Path::add_emission(const Hit& hit) {
  if (!counts_caustic()) return;
  const Material& material = *hit.material;
  if (!hit.front && !material.two_sided) return;
  const float cosine = std::abs(hit.geometric_normal.dot(ray_.direction));
  if (is_black(material.radiance_cd_m2) || !(cosine > 0)) return;
  const float pdf = world_.emitters.pdf_area(material) * square(hit.distance_m) / cosine;
  radiance_ += throughput_ * material.radiance_cd_m2 * mis_weight(pdf);
}

// A surface as the path sees it: see Scene::caustics for what happens after a wide lobe.
Surface Path::surface_at(const Hit& hit, const Vec3& direction, bool diffused) const {
  Surface surface = make_surface(hit, direction);
  if (diffused && !world_.scene.caustics) surface.alpha = std::max(surface.alpha, kCausticAlpha);
  return surface;
}

// Continues the path; false if it ends here.
bool Path::scatter(const Surface& surface) {
  const auto sample = sample_bsdf(surface, random_1d(kLobe), random_2d(kBsdf));
  if (!sample) return false;
  throughput_ = throughput_ * sample->weight;
  patches_joined_ = !surface.specular() && joins_patches();
  specular_ = surface.specular();
  rough_seen_ = rough_seen_ || !specular_;
  pdf_ = sample->pdf;
  diffused_ = diffused_ || (!specular_ && pdf_ < kNarrowLobe);
  if (is_black(throughput_)) return false;
  // What mirrors show stays free of noise. The root keeps paths longer than their share of the light:
  // measured, that is worth its rays.
  if (rough_seen_ || bounce_ >= kMirrorsBeforeRoulette) {
    const float survival = std::clamp(std::sqrt(max_component(throughput_)), kMinSurvival, 1.0f);
    if (random_1d(kRoulette) >= survival) return false;
    throughput_ = throughput_ * (1.0f / survival);
  }
  if (sample->transmitted) inside_.cross(surface.material, surface.front);
  ray_ = {offset_origin(surface.position_m, surface.geometric_normal, sample->incoming), sample->incoming};
  ++bounce_;
  ++counts_.bounce;
  return true;
}

PathResult Path::run() {
  Hit hit;
  bool found = world_.rays.intersect(ray_, hit);
  const float first_distance = found ? hit.distance_m : kInfinity;
  while (features_.paths) {
    cross_segment(found ? hit.distance_m : kInfinity);
    if (!found) {
      add_outside_light();
      break;
    }
    if (hit.material->kind == Material::Kind::kEmitter) {
      add_emission(hit);
      break;
    }
    if (bounce_ >= world_.scene.max_bounces) break;
    segment_m_ = hit.distance_m;
    const Surface surface = surface_at(hit, ray_.direction, diffused_);
    if (!surface.specular()) radiance_ += throughput_ * direct_light(surface);
    if (!scatter(surface)) break;
    found = world_.rays.intersect(ray_, hit);
  }
  return {radiance_, first_distance};
}

World::World(const Scene& s)
    : scene(s),
      rays(s),
      emitters(s),
      sun(s),
      patches(s, rays, sun),
      sky(s),
      portals(s),
      medium(s.medium.value_or(Medium{Vec3::Zero(), Vec3::Zero(), 0, 0, 0})) {}

PathResult trace_path(const World& world, const Features& features, const Ray& camera_ray,
                      const PathSampler& sampler, RayCounts& counts) {
  return Path(world, features, camera_ray, sampler, counts).run();
}

}  // namespace plenolab::tracer
