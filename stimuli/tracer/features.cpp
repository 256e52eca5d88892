#include "stimuli/tracer/features.h"

#include <algorithm>

#include "stimuli/tracer/maths.h"

namespace plenolab::tracer {

namespace {

using Kind = Material::Kind;

bool has_lamps(const Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
    const Material& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    return m.kind == Kind::kEmitter && !is_black(m.radiance_cd_m2) && !mesh.triangles.empty();
  });
}

bool has_sky_light(const Sky& sky) {
  switch (sky.kind) {
    case Sky::Kind::kNone:
      return false;
    case Sky::Kind::kUniform:
      return !is_black(sky.zenith_cd_m2) || !is_black(sky.ground_cd_m2);
    case Sky::Kind::kGradient:
      return !is_black(sky.zenith_cd_m2) || !is_black(sky.horizon_cd_m2) || !is_black(sky.ground_cd_m2);
    case Sky::Kind::kDaylight:
      return true;
  }
  return true;
}

bool absorbs_inside(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
    return m.kind == Kind::kDielectric && !is_black(m.absorption_per_m);
  });
}

}  // namespace

Features features_of(const Scene& scene, std::vector<PrunedStage>& left_out) {
  Features f;
  const auto decide = [&](bool& needed, bool value, const char* stage, const char* reason) {
    needed = value;
    if (!value) left_out.push_back({stage, reason});
  };
  decide(f.emitters, has_lamps(scene), "lamps", "the scene has no luminous triangles");
  decide(f.sun, scene.sun && !is_black(scene.sun->illuminance_lx), "sun", "the scene has no sun");
  decide(f.sky, has_sky_light(scene.sky), "sky", "no light comes from sky or ground");
  decide(f.patches, f.sun && !scene.portals.empty() && scene.max_bounces > 1, "sun patches",
         "no sunlight that has come through an opening is reflected onto another surface");
  decide(f.absorption, absorbs_inside(scene), "absorption", "no dielectric of the scene absorbs light");
  const bool medium = scene.medium && scene.medium->scattering_per_m + scene.medium->absorption_per_m > 0;
  decide(f.extinction, medium, "medium", "the scene has no participating medium");
  decide(f.scattering, medium && scene.medium->scattering_per_m > 0 && (f.emitters || f.sun),
         "single scattering", "no medium of the scene scatters light of lamps or sun");
  decide(f.paths, f.emitters || f.sun || f.sky, "light transport",
         "the scene has no light; only disparity is computed");
  return f;
}

}  // namespace plenolab::tracer
