#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross products
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// World coordinates in metres, right-handed, z up.
using Vec3 = Eigen::Vector3f;

/// Where a ray meets a surface; what procedural textures are functions of.
struct SurfacePoint {
  Vec3 position_m;
  Vec3 normal;         ///< unit, interpolated from the mesh, on the side the ray came from
  float u = 0, v = 0;  ///< interpolated mesh parameters
};

/// Procedural textures: pure functions, called from many threads. An empty function means the default beside
/// it.
using ColourTexture = std::function<Rgb(const SurfacePoint&)>;
using ScalarTexture = std::function<float(const SurfacePoint&)>;
using NormalTexture = std::function<Vec3(const SurfacePoint&)>;

/// How a surface scatters light. Radiance is linear BT.709 RGB in cd/m².
struct Material {
  enum class Kind {
    kDiffuse,  ///< Lambert: albedo
    kGlossy,   ///< GGX reflection (Walter et al. 2007, Fresnel from `ior`) over a Lambert base: albedo,
               ///< roughness, ior
    /// GGX reflection with normal-incidence reflectance `albedo`: roughness. Light scattered more than once
    /// between facets is lost, as in kGlossy: a white metal seen head-on keeps 0.99 at α = 0.1, 0.88 at 0.3,
    /// 0.31 at 1.
    kMetal,
    kMirror,      ///< ideal reflection of share `albedo`
    kDielectric,  ///< smooth refracting boundary (glass, water): ior, absorption on the inner side
    kEmitter,     ///< diffuse light source: radiance_cd_m2, front side only unless two_sided
  };
  Kind kind = Kind::kDiffuse;
  ColourTexture albedo;     ///< in [0, 1]; default 0.5 grey
  ScalarTexture roughness;  ///< GGX α in (0, 1]; default 0.2
  NormalTexture normal;     ///< shading normal (unit), e.g. ripples on water; default SurfacePoint::normal
  float ior = 1.5f;
  Rgb absorption_per_m{};  ///< Beer-Lambert, inside a dielectric
  Rgb radiance_cd_m2{};    ///< of an emitter
  bool two_sided = true;   ///< emitters: light from both sides
};

/// A triangle mesh. `normals` and `uvs` are per vertex or empty (geometric normals, uv 0).
struct Mesh {
  std::vector<Vec3> positions_m;
  std::vector<Vec3> normals;
  std::vector<std::array<float, 2>> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  int material = 0;  ///< index into Scene::materials
};

/// The sun: a disc of uniform radiance, explicitly sampled.
struct Sun {
  Vec3 direction{0, 0, 1};  ///< unit, from the scene to the sun
  float angular_diameter_deg = 0.53f;
  Rgb illuminance_lx{100000, 95000, 85000};  ///< on a surface facing it
};

/// Light from outside the scene, explicitly sampled. Directions below the horizon see `ground_cd_m2`.
struct Sky {
  enum class Kind {
    kNone,      ///< black
    kUniform,   ///< zenith_cd_m2 everywhere
    kGradient,  ///< zenith_cd_m2 blended to horizon_cd_m2 (night skies, overcast)
    kDaylight,  ///< Preetham, Shirley & Smits 1999 for the scene's sun and `turbidity`
  };
  Kind kind = Kind::kNone;
  Rgb zenith_cd_m2{}, horizon_cd_m2{}, ground_cd_m2{};
  float turbidity = 3;
};

/// A homogeneous participating medium inside an axis-aligned box; single scattering of sun and lamps (not of
/// the sky), attenuation of everything seen through it and of all light that crosses it.
struct Medium {
  Vec3 min_m, max_m;
  float scattering_per_m = 0, absorption_per_m = 0;
  float anisotropy = 0;  ///< Henyey-Greenstein g in (−1, 1)
};

/// Openings through which light from sky and sun enters an interior: sampled explicitly where the whole sky,
/// and the patches the sun shines on behind them, would be noisy. A parallelogram corner + a·edge_u +
/// b·edge_v.
struct SkyPortal {
  Vec3 corner_m, edge_u_m, edge_v_m;
};

/// The camera grid: all cameras look along `forward`; columns run to the right, rows down.
struct GridCamera {
  Vec3 centre_m{0, 0, 0};  ///< centre of the camera grid
  Vec3 forward{0, 1, 0};   ///< unit
  Vec3 up{0, 0, 1};        ///< unit, orthogonal to forward
  float fov_h_deg = 60;
};

/// How a scene is recorded in one preset.
struct GridPreset {
  int columns = 5, rows = 3;
  double spacing_x_m = 0.1, spacing_y_m = 0.1;
  int width = 480, height = 270;
  int paths_per_pixel = 64;  ///< per delivered pixel, a multiple of 16 (4 × 4 block, section 3.1.1)
};

/// Everything there is to render.
struct Scene {
  std::string id;           ///< name on the command line, e.g. "cellar"
  std::string title;        ///< for people, e.g. "Cellar"
  std::string description;  ///< one sentence: what it provokes
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::optional<Sun> sun;
  Sky sky;
  std::vector<SkyPortal> portals;  ///< empty: the whole sky is sampled
  std::optional<Medium> medium;
  GridCamera camera;
  GridPreset quick, paper;
  int max_bounces = 6;  ///< scattering events of one path, ideal reflection and refraction included
  /// Whether lamps and the sun also light diffuse and glossy surfaces by way of ideal mirrors and smooth
  /// dielectrics (the sun's caustics below water, a lantern's reflection off a lake onto a hull). Such light
  /// is found by chance only and is noisy; false leaves it out of every view and of the ground truth alike,
  /// and takes glossy surfaces as at least α = 0.3 rough where their light has been spread by another rough
  /// surface on its way to the camera: a property of the scene, not an approximation of the renderer. What
  /// the camera sees through any chain of mirrors and dielectrics always counts.
  bool caustics = true;
  /// Names an altered copy of a scene ("roughness=0.1") in the render cache. Whoever changes a scene after it
  /// was built must change this too, because cached views are found by id, variant and source text. Empty: as
  /// built.
  std::string variant;
};

/// Throws InputError with one sentence that names the first thing wrong: an index out of range, a number of
/// normals or uvs that differs from the vertices', a coordinate that is not finite, a direction that is not a
/// unit vector, a negative radiance, a turbidity, roughness or anisotropy out of range. Triangles without
/// area are allowed.
void validate(const Scene& scene);

}  // namespace plenolab
