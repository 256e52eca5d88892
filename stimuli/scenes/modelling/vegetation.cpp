#include "stimuli/scenes/modelling/vegetation.h"

#include <cmath>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {
namespace {

constexpr float kTurn = 2 * static_cast<float>(EIGEN_PI);

struct Branch {
  Vec3 start, direction;
  float length, radius;
  int level;
  bool bare;
};

class Grower {
 public:
  explicit Grower(const TreeLook& look) : look_(look), random_(look.seed, 0x67726f77, 0) {}

  void grow(const Branch& branch) {
    const std::vector<Vec3> path = wander(branch);
    add_tube(branch, path);
    if (branch.level >= look_.levels - 2 && !branch.bare) add_leaves(branch, path);
    if (branch.level < look_.levels) fork(branch, path);
  }

  TreeMeshes take() { return std::move(tree_); }

 private:
  float between(float low, float high) { return low + (high - low) * random_.next_float(); }

  Vec3 any_direction() {
    const float z = between(-1, 1), angle = between(0, kTurn), r = std::sqrt(std::max(0.f, 1 - z * z));
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  /// Crooked path that droops a little when long and strives upwards when thick.
  std::vector<Vec3> wander(const Branch& branch) {
    const int pieces = branch.level == 0 ? 10 : (branch.level < 3 ? 8 : 4);
    const float step = branch.length / static_cast<float>(pieces);
    const float crook = branch.level == 0 ? 0.07f : 0.2f;
    const float rise = branch.level < 2 ? 0.06f : -0.02f;
    std::vector<Vec3> path{branch.start};
    Vec3 direction = branch.direction;
    for (int i = 0; i < pieces; ++i) {
      direction = (direction + crook * any_direction() + Vec3(0, 0, rise)).normalized();
      path.push_back(path.back() + step * direction);
    }
    return path;
  }

  void add_tube(const Branch& branch, const std::vector<Vec3>& path) {
    std::vector<float> radii;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(path.size() - 1);
      const float flare = branch.level == 0 ? 0.5f * std::exp(-7 * t) : 0;
      radii.push_back(branch.radius * (1 - (branch.level == look_.levels ? 0.75f : 0.42f) * t + flare));
    }
    const int sides = branch.level == 0 ? 24 : (branch.level < 3 ? 10 : (branch.level == 3 ? 5 : 3));
    append(tree_.branches, numbered(tube(path, radii, sides), ++number_));
  }

  void add_leaves(const Branch& branch, const std::vector<Vec3>& path) {
    const int count = branch.level == look_.levels ? look_.leaves_per_twig : look_.leaves_per_twig / 2;
    for (int i = 0; i < count; ++i) {
      const float at = between(0.25f, 1) * static_cast<float>(path.size() - 1);
      const auto k = std::min(static_cast<std::size_t>(at), path.size() - 2);
      const Vec3 place = path[k] + (path[k + 1] - path[k]) * (at - static_cast<float>(k));
      const Vec3 along = (any_direction() + 0.5f * branch.direction - Vec3(0, 0, 0.35f)).normalized();
      const Vec3 facing = any_direction() + Vec3(0, 0, 0.9f);
      const Vec3 side = along.cross(facing);
      if (side.squaredNorm() < 1e-4f) continue;
      Eigen::Affine3f pose = Eigen::Affine3f::Identity();
      const Vec3 x = side.normalized();
      pose.linear() << x, along, x.cross(along);
      pose.linear() *= look_.leaf_m * between(0.65f, 1.2f);
      pose.translation() = place + 0.03f * any_direction();
      append(tree_.leaves, numbered(placed(leaf(0.62f, 0.16f, 0.12f), pose), ++number_));
    }
  }

  void fork(const Branch& parent, const std::vector<Vec3>& path) {
    const int count = look_.children + (parent.level == 0 ? 1 : (random_.next_float() < 0.5f ? 0 : -1));
    const float first_turn = between(0, kTurn);
    for (int i = 0; i < count; ++i) {
      const float share = (static_cast<float>(i) + random_.next_float()) / static_cast<float>(count);
      const float at = (parent.level == 0 ? 0.72f + 0.28f * share : 0.25f + 0.75f * share);
      const float position = at * static_cast<float>(path.size() - 1);
      const auto k = std::min(static_cast<std::size_t>(position), path.size() - 2);
      const Vec3 start = path[k] + (path[k + 1] - path[k]) * (position - static_cast<float>(k));
      const Vec3 trend = (path[k + 1] - path[k]).normalized();
      const Vec3 x =
          trend.cross(std::abs(trend.z()) < 0.9f ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX())).normalized();
      const Vec3 y = trend.cross(x);
      const float turn = first_turn + 2.4f * static_cast<float>(i);  // near the golden angle: evenly around
      const float open = parent.level == 0 ? between(0.45f, 1.05f) : between(0.5f, 1.0f);
      const Vec3 out = std::cos(turn) * x + std::sin(turn) * y;
      Branch child;
      child.start = start;
      child.direction = (std::cos(open) * trend + std::sin(open) * out).normalized();
      child.length = parent.length * (parent.level == 0 ? between(1.05f, 1.4f) : between(0.5f, 0.68f));
      child.radius = parent.radius * (1 - 0.42f * at) *
                     (parent.level == 0 ? between(0.42f, 0.6f) : between(0.36f, 0.5f));
      child.level = parent.level + 1;
      child.bare = parent.bare || (child.level == 2 && random_.next_float() < look_.bare_share);
      grow(child);
    }
  }

  TreeLook look_;
  RandomStream random_;
  TreeMeshes tree_;
  int number_ = 0;
};

/// Blade from root to tip: two quads' worth of triangles, bent towards +y.
Mesh blade(float height, float width, float bend) {
  Mesh mesh;
  constexpr std::array<std::array<float, 2>, 2> kStations{{{0.f, 0.5f}, {0.55f, 0.36f}}};
  for (const auto& [up, half] : kStations) {
    for (const float side : {-1.f, 1.f}) {
      mesh.positions_m.push_back({side * half * width, bend * height * up * up, height * up});
      mesh.uvs.push_back({side * half, up});
    }
  }
  mesh.positions_m.push_back({0, bend * height, height * (1 - 0.35f * bend)});
  mesh.uvs.push_back({0, 1});
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 4}};
  // Lit like the ground they stand on: steep normals would make grass dark and noisy.
  mesh.normals.assign(mesh.positions_m.size(), Vec3(0, -0.5f, 0.85f).normalized());
  return mesh;
}

}  // namespace

TreeMeshes grow_tree(const Vec3& foot_m, const TreeLook& look) {
  Grower grower(look);
  grower.grow({foot_m, Vec3(0.03f, 0, 1).normalized(), look.trunk_m, look.radius_m, 0, false});
  return grower.take();
}

Mesh grass(const GrassLook& look, const std::function<float(float x, float y)>& terrain_m) {
  RandomStream random(look.seed, 0x67726173, 0);
  const float half_angle = look.half_angle_deg * kTurn / 360;
  Mesh mesh;
  for (int i = 0; i < look.blades; ++i) {
    const float distance = look.near_m * std::pow(look.far_m / look.near_m, random.next_float());
    const float angle = half_angle * (2 * random.next_float() - 1);
    const float x = distance * std::sin(angle), y = distance * std::cos(angle);
    const float tuft = 0.6f + 0.5f * fractal_noise({x * 0.9f, y * 0.9f, 0}, 3, look.seed);
    const float height = look.height_m * std::max(0.25f, tuft) * (0.55f + 0.7f * random.next_float());
    const float width = look.width_m * (0.7f + 0.6f * random.next_float()) * std::max(1.f, distance / 6);
    const Mesh one = numbered(blade(height, width, 0.2f + 0.5f * random.next_float()), i);
    append(mesh, placed(one, pose({x, y, terrain_m(x, y) - 0.01f}, 360 * random.next_float())));
  }
  return mesh;
}

}  // namespace plenolab
