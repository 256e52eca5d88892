#include "stimuli/tracer/emitters.h"

#include <algorithm>

namespace plenolab::tracer {

namespace {

double flux_per_area(const Material& material) {
  return static_cast<double>(luminance(material.radiance_cd_m2)) * (material.two_sided ? 2.0 : 1.0);
}

}  // namespace

Rgb emitted(const Material& material, const Vec3& normal, const Vec3& direction) {
  return material.two_sided || normal.dot(direction) > 0 ? material.radiance_cd_m2 : Rgb{};
}

Emitters::Emitters(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (material.kind != Material::Kind::kEmitter || !(flux_per_area(material) > 0)) continue;
    for (const auto& corner : mesh.triangles) {
      const Vec3& p = mesh.positions_m[corner[0]];
      const Vec3 e1 = mesh.positions_m[corner[1]] - p, e2 = mesh.positions_m[corner[2]] - p;
      const Eigen::Vector3d cross = e1.cast<double>().cross(e2.cast<double>());
      const double area = 0.5 * cross.norm();
      if (!(area > 0)) continue;
      triangles_.push_back({p, e1, e2, cross.normalized().cast<float>(), &material});
      total_weight_ += area * flux_per_area(material);
      cumulative_.push_back(total_weight_);
    }
  }
  for (double& c : cumulative_) c /= total_weight_;
  const std::size_t shares = triangles_.size();
  for (std::size_t i = 0; i <= shares; ++i) {
    const double start = static_cast<double>(i) / static_cast<double>(shares);
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), start);
    guide_.push_back(static_cast<std::uint32_t>(found - cumulative_.begin()));
  }
}

std::optional<EmitterPoint> Emitters::sample(float select, std::array<float, 2> u) const {
  if (triangles_.empty()) return std::nullopt;
  // The guide leaves a few entries to search where the whole list would miss the cache at every step.
  const auto share =
      std::min(static_cast<std::size_t>(static_cast<double>(select) * static_cast<double>(triangles_.size())),
               triangles_.size() - 1);
  const auto first = cumulative_.begin() + guide_[share];
  const auto last = cumulative_.begin() + guide_[share + 1];
  const auto found = std::upper_bound(first, last, static_cast<double>(select));
  const auto index =
      std::min<std::size_t>(static_cast<std::size_t>(found - cumulative_.begin()), triangles_.size() - 1);
  const Triangle& t = triangles_[index];
  const float root = std::sqrt(u[0]);
  const float b = 1.0f - root, c = root * u[1];
  return EmitterPoint{t.corner + b * t.edge_1 + c * t.edge_2, t.normal, pdf_area(*t.material), t.material};
}

float Emitters::pdf_area(const Material& material) const {
  return total_weight_ > 0 ? static_cast<float>(flux_per_area(material) / total_weight_) : 0.0f;
}

}  // namespace plenolab::tracer
