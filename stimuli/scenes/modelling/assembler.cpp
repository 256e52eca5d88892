#include "stimuli/scenes/modelling/assembler.h"

#include <utility>

#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

int SceneAssembler::material(Material material) {
  materials_.push_back(std::move(material));
  meshes_.emplace_back();
  meshes_.back().material = static_cast<int>(materials_.size()) - 1;
  return meshes_.back().material;
}

void SceneAssembler::add(int material, const Mesh& part) {
  append(meshes_.at(static_cast<std::size_t>(material)), part);
}

void SceneAssembler::finish(Scene& scene) {
  scene.materials = std::exchange(materials_, {});
  for (Mesh& mesh : meshes_) {
    if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
  }
  meshes_.clear();
}

Material diffuse(ColourTexture albedo, NormalTexture normal) {
  Material result;
  result.albedo = std::move(albedo);
  result.normal = std::move(normal);
  return result;
}

Material glossy(ColourTexture albedo, ScalarTexture roughness, float ior, NormalTexture normal) {
  Material result = diffuse(std::move(albedo), std::move(normal));
  result.kind = Material::Kind::kGlossy;
  result.roughness = std::move(roughness);
  result.ior = ior;
  return result;
}

Material lamp(Rgb radiance_cd_m2) {
  Material result;
  result.kind = Material::Kind::kEmitter;
  result.radiance_cd_m2 = radiance_cd_m2;
  result.two_sided = false;
  return result;
}

}  // namespace plenolab
