#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "stimuli/tracer/bsdf.h"
#include "stimuli/tracer/medium.h"
#include "stimuli/tracer/path_tracer.h"
#include "stimuli/tracer/resampling.h"

namespace plenolab::tracer {

/// Lobes denser than this, per steradian, show a nearly sharp reflection (GGX α below 0.06).
inline constexpr float kNarrowLobe = 20;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What random numbers are used for at each bounce; every use has its own sample dimension.
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
  kPatch,
  kPatchOpening,
  kPatchSun,
  kRoulette,
  kMediumLamp,
  kMediumLampPoint,
  kMediumLampDistance,
  kMediumSun,
  kMediumSunDistance,
  kUses
};

/// Dielectrics the path is inside of, innermost last. Deeper nesting than kCapacity is not tracked.
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
  bool empty() const { return size_ == 0; }
  Rgb absorption_per_m() const { return size_ > 0 ? inside_[size_ - 1]->absorption_per_m : Rgb{}; }

 private:
  static constexpr std::size_t kCapacity = 8;
  std::array<const Material*, kCapacity> inside_{};
  std::size_t size_ = 0;
};

/// One path on its way through the scene; see trace_path.
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
  Rgb scattered_sunlight(const MediumSegment& segment, const PathSampler& sampler);
  Rgb scattered_lamplight(const MediumSegment& segment);
  Rgb up_to(const MediumSegment& segment, float distance_m) const;
  void add_outside_light();
  void add_emission(const Hit& hit);
  Rgb direct_light(const Surface& surface);
  Rgb light_of_lamps(const Surface& surface, const Vec3& origin, const PathSampler& sampler);
  Rgb light_of_sun(const Surface& surface, const Vec3& origin, const PathSampler& sampler);
  Rgb light_of_sky(const Surface& surface, const Vec3& origin, const PathSampler& sampler);
  Rgb light_of_patches(const Surface& surface, const Vec3& origin, const PathSampler& sampler);
  Surface surface_at(const Hit& hit, const Vec3& direction, bool diffused) const;
  bool joins_patches() const;
  float patch_mis_weight(const Surface& surface, const Vec3& sun_direction) const;
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
  bool diffused_ = false;        // some surface has spread the light over a wide lobe
  bool patches_joined_ = false;  // the last surface was joined to sun patches: see light_of_patches
  float segment_m_ = 0;          // length of the current ray up to the surface
  int bounce_ = 0;               // scattering events so far
  DielectricStack inside_;
};

}  // namespace plenolab::tracer
