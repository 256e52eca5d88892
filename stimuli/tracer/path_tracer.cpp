#include "stimuli/tracer/path_tracer.h"

#include <array>
#include <span>

#include "stimuli/tracer/bsdf.h"
#include "stimuli/tracer/medium.h"

namespace plenolab::tracer {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kRouletteAfter = 3;
constexpr float kMinSurvival = 0.05f, kMaxSurvival = 0.95f;

// What random numbers are used for at each bounce; every use has its own sample dimension.
enum Use : std::uint32_t {
  kBsdf,
  kLobe,
  kLamp,
  kLampPoint,
  kLampChoice,
  kSun,
  kSky,
  kPortal,
  kSkyChoice,
  kRoulette,
  kMediumLamp,
  kMediumLampPoint,
  kMediumLampDistance,
  kMediumSun,
  kMediumSunDistance,
  kUses
};

// Dielectrics the path is inside of, innermost last. Deeper nesting than kCapacity is not tracked.
class DielectricStack {
 public:
  void cross(const Material* material, bool entering) {
    if (entering) {
      if (size_ < kCapacity) inside_[size_++] = material;
      return;
    }
    for (std::size_t i = size_; i-- > 0;)
      if (inside_[i] == material) {
        for (std::size_t j = i + 1; j < size_; ++j) inside_[j - 1] = inside_[j];
        --size_;
        return;
      }
  }
  Rgb absorption_per_m() const { return size_ > 0 ? inside_[size_ - 1]->absorption_per_m : Rgb{}; }

 private:
  static constexpr std::size_t kCapacity = 8;
  std::array<const Material*, kCapacity> inside_{};
  std::size_t size_ = 0;
};

// Light that could reach a surface along one drawn direction, over the density of the draw.
struct LightCandidate {
  Vec3 direction;
  float distance_m = 0;
  Rgb light;
};

// Draws one of several candidates in proportion to what it would bring if nothing were in the way (resampled
// importance sampling, Talbot, Cline & Egbert 2005); its light is scaled so that the mean over draws is that
// of all candidates.
LightCandidate resample(std::span<const LightCandidate> candidates, float u) {
  float total = 0;
  for (const LightCandidate& c : candidates) total += max_component(c.light);
  if (!(total > 0)) return {};
  const LightCandidate* chosen = nullptr;
  float passed = 0;
  for (const LightCandidate& c : candidates) {
    if (is_black(c.light)) continue;
    chosen = &c;
    passed += max_component(c.light);
    if (u * total < passed) break;
  }
  const float scale = total / (static_cast<float>(candidates.size()) * max_component(chosen->light));
  return {chosen->direction, chosen->distance_m, chosen->light * scale};
}

// Candidate `index` of `count` random numbers spread evenly from one: each alone is uniform in [0, 1).
float spread(float u, std::size_t index, std::size_t count) {
  const float moved = u + static_cast<float>(index) / static_cast<float>(count);
  return moved < 1 ? moved : std::min(moved - 1, 0x1.fffffep-1f);
}

// The R2 sequence (Roberts 2018) from a random start.
std::array<float, 2> spread(std::array<float, 2> u, std::size_t index) {
  const auto wrap = [](float x) { return std::min(x - std::floor(x), 0x1.fffffep-1f); };
  const auto i = static_cast<float>(index);
  return {wrap(u[0] + i * 0.7548777f), wrap(u[1] + i * 0.5698403f)};
}

class Path {
 public:
  Path(const World& world, const Features& features, const Ray& ray, const PathSampler& sampler,
       RayCounts& counts)
      : world_(world), features_(features), sampler_(sampler), counts_(counts), ray_(ray) {}

  PathResult run();

 private:
  std::uint32_t dimension(Use use) const { return 1 + static_cast<std::uint32_t>(bounce_) * kUses + use; }
  float random_1d(Use use) const { return sampler_.get_1d(dimension(use)); }
  std::array<float, 2> random_2d(Use use) const { return sampler_.get_2d(dimension(use)); }

  void cross_segment(float distance_m);
  Rgb scattered_sunlight(const MediumSegment& segment);
  Rgb scattered_lamplight(const MediumSegment& segment);
  Rgb up_to(const MediumSegment& segment, float distance_m) const;
  void add_outside_light();
  void add_emission(const Hit& hit);
  Rgb direct_light(const Surface& surface);
  Rgb light_of_lamps(const Surface& surface, const Vec3& origin);
  Rgb light_of_sun(const Surface& surface, const Vec3& origin);
  Rgb light_of_sky(const Surface& surface, const Vec3& origin);
  LightCandidate lamp_candidate(const Surface& surface, const Vec3& origin, float select,
                                std::array<float, 2> u) const;
  LightCandidate sky_candidate(const Surface& surface, const Vec3& origin, float select,
                               std::array<float, 2> u) const;
  Rgb unoccluded(const Ray& ray, float distance_m);
  bool scatter(const Surface& surface);
  // Sun and lamps found by ideal reflection or refraction after a rough surface: see Scene::caustics.
  bool counts_caustic() const { return world_.scene.caustics || !(specular_ && rough_seen_); }
  float mis_weight(float light_pdf) const { return specular_ ? 1.0f : power_heuristic(pdf_, light_pdf); }

  const World& world_;
  const Features& features_;
  const PathSampler& sampler_;
  RayCounts& counts_;
  Ray ray_;
  Rgb throughput_{1, 1, 1};
  Rgb radiance_{};
  float pdf_ = 0;         // with which the BSDF found the current direction
  bool specular_ = true;  // the current direction was the only one possible (camera, ideal reflection)
  bool rough_seen_ = false;
  int bounce_ = 0;  // scattering events so far
  DielectricStack inside_;
};

// Transmittance of a shadow ray: 0 if anything is in the way.
Rgb Path::unoccluded(const Ray& ray, float distance_m) {
  ++counts_.shadow;
  if (world_.rays.occluded(ray, distance_m)) return {};
  Rgb passes{1, 1, 1};
  if (features_.extinction) passes = passes * medium_transmittance(world_.medium, ray, distance_m);
  if (features_.absorption) passes = passes * transmittance(inside_.absorption_per_m(), distance_m);
  return passes;
}

// Share of light scattered at `distance_m` that reaches the start of the segment's ray, per metre of segment.
Rgb Path::up_to(const MediumSegment& segment, float distance_m) const {
  const float medium = std::exp(-extinction_per_m(world_.medium) * (distance_m - segment.near_m));
  return transmittance(inside_.absorption_per_m(), distance_m) * (medium * world_.medium.scattering_per_m);
}

Rgb Path::scattered_sunlight(const MediumSegment& segment) {
  const MediumPoint at =
      sample_transmittance(segment, extinction_per_m(world_.medium), random_1d(kMediumSunDistance));
  const Vec3 position = ray_.origin + at.distance_m * ray_.direction;
  const Vec3 direction = world_.sun.sample(random_2d(kMediumSun));
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

// Light scattered towards the path along the segment ahead, then what the segment takes away.
void Path::cross_segment(float distance_m) {
  if (features_.scattering && bounce_ < world_.scene.max_bounces) {
    const MediumSegment segment = clip_to(world_.medium, ray_, distance_m);
    if (segment.length() > 0) {
      if (features_.sun) radiance_ += throughput_ * scattered_sunlight(segment);
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

Rgb Path::light_of_lamps(const Surface& surface, const Vec3& origin) {
  constexpr std::size_t kCandidates = 8;  // lamps near by matter most: found without a ray
  const float select = random_1d(kLamp);
  const std::array<float, 2> point = random_2d(kLampPoint);
  std::array<LightCandidate, kCandidates> candidates;
  for (std::size_t i = 0; i < kCandidates; ++i)
    candidates[i] = lamp_candidate(surface, origin, spread(select, i, kCandidates), spread(point, i));
  const LightCandidate chosen = resample(candidates, random_1d(kLampChoice));
  return is_black(chosen.light) ? Rgb{}
                                : chosen.light * unoccluded({origin, chosen.direction}, chosen.distance_m);
}

Rgb Path::light_of_sun(const Surface& surface, const Vec3& origin) {
  const Vec3 direction = world_.sun.sample(random_2d(kSun));
  const BsdfValue bsdf = evaluate_bsdf(surface, direction);
  if (is_black(bsdf.f_cos)) return {};
  return world_.sun.disc_radiance() * bsdf.f_cos * unoccluded({origin, direction}, kInfinity) *
         (power_heuristic(world_.sun.pdf(), bsdf.pdf) / world_.sun.pdf());
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

Rgb Path::light_of_sky(const Surface& surface, const Vec3& origin) {
  // Portals differ in what they bring; directions drawn from the open sky hardly do.
  constexpr std::size_t kPortalCandidates = 4;
  const std::size_t count = world_.portals.empty() ? 1 : kPortalCandidates;
  const float select = random_1d(kPortal);
  const std::array<float, 2> u = random_2d(kSky);
  std::array<LightCandidate, kPortalCandidates> store;
  const std::span candidates(store.data(), count);
  for (std::size_t i = 0; i < count; ++i)
    candidates[i] = sky_candidate(surface, origin, spread(select, i, count), spread(u, i));
  const LightCandidate chosen = resample(candidates, random_1d(kSkyChoice));
  return is_black(chosen.light) ? Rgb{} : chosen.light * unoccluded({origin, chosen.direction}, kInfinity);
}

Rgb Path::direct_light(const Surface& surface) {
  const Vec3 origin = offset_origin(surface.position_m, surface.geometric_normal, surface.geometric_normal);
  Rgb sum;
  if (features_.emitters) sum += light_of_lamps(surface, origin);
  if (features_.sun) sum += light_of_sun(surface, origin);
  if (features_.sky) sum += light_of_sky(surface, origin);
  return sum;
}

// Continues the path; false if it ends here.
bool Path::scatter(const Surface& surface) {
  const auto sample = sample_bsdf(surface, random_1d(kLobe), random_2d(kBsdf));
  if (!sample) return false;
  throughput_ = throughput_ * sample->weight;
  specular_ = surface.specular();
  rough_seen_ = rough_seen_ || !specular_;
  pdf_ = sample->pdf;
  if (bounce_ >= kRouletteAfter) {
    const float survival = std::clamp(max_component(throughput_), kMinSurvival, kMaxSurvival);
    if (random_1d(kRoulette) >= survival) return false;
    throughput_ = throughput_ * (1.0f / survival);
  }
  if (is_black(throughput_)) return false;
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
    const Surface surface = make_surface(hit, ray_.direction);
    if (!surface.specular()) radiance_ += throughput_ * direct_light(surface);
    if (!scatter(surface)) break;
    found = world_.rays.intersect(ray_, hit);
  }
  return {radiance_, first_distance};
}

}  // namespace

World::World(const Scene& s)
    : scene(s),
      rays(s),
      emitters(s),
      sun(s),
      sky(s),
      portals(s),
      medium(s.medium.value_or(Medium{Vec3::Zero(), Vec3::Zero(), 0, 0, 0})) {}

PathResult trace_path(const World& world, const Features& features, const Ray& camera_ray,
                      const PathSampler& sampler, RayCounts& counts) {
  return Path(world, features, camera_ray, sampler, counts).run();
}

}  // namespace plenolab::tracer
