#pragma once

#include <cstddef>

#include "stimuli/scene.h"

namespace plenolab {

/// Collects the parts of a scene, one mesh per material.
class SceneAssembler {
 public:
  /// Registers a material; the result names it in add().
  int material(Material material);
  /// Appends a part to the mesh of a material.
  void add(int material, const Mesh& part);
  /// Moves materials and meshes into `scene`; meshes without triangles are left out.
  void finish(Scene& scene);

 private:
  std::vector<Material> materials_;
  std::vector<Mesh> meshes_;
};

/// Materials in one line.
Material diffuse(ColourTexture albedo, NormalTexture normal = {});
Material glossy(ColourTexture albedo, ScalarTexture roughness, float ior, NormalTexture normal = {});
/// A light source with a closed surface: shines outwards only.
Material lamp(Rgb radiance_cd_m2);

}  // namespace plenolab
