#include "stimuli/scenes/modelling/masonry.h"

#include <algorithm>

#include "core/base/random.h"

namespace plenolab {
namespace {

/// Cuts [0, total] into pieces of random length within [least, most]; the last one takes what is left.
std::vector<float> cut_into_pieces(float total, float least, float most, RandomStream& random) {
  std::vector<float> pieces;
  float left = total;
  while (left > most) {
    const float piece = std::min(least + (most - least) * random.next_float(), left - least);
    pieces.push_back(piece);
    left -= piece;
  }
  pieces.push_back(left);
  return pieces;
}

}  // namespace

Mesh stone_courses(float length_m, float height_m, const MasonryLook& look) {
  RandomStream random(look.seed, 0x6d61736f, 0);
  Mesh mesh;
  int number = 0;
  float z = 0;
  for (const float course : cut_into_pieces(height_m, look.course_min, look.course_max, random)) {
    float x = 0;
    for (const float length : cut_into_pieces(length_m, look.stone_min, look.stone_max, random)) {
      const auto seed = static_cast<std::uint32_t>(random.next_u64());
      const float forward = (2 * random.next_float() - 1) * look.proud;
      const Vec3 size(length - look.joint, look.depth, course - look.joint);
      const Mesh block = rough_stone(size, look.rounding, look.roughness, look.cuts, seed);
      append(mesh, numbered(placed(block, Vec3(x + length / 2, look.depth / 2 - forward, z + course / 2)),
                            37 * number++));
      x += length;
    }
    z += course;
  }
  return mesh;
}

Mesh upright_rectangle(float x0, float x1, float z0, float z1, float y) {
  return surface(1, 1, [=](float u, float v) { return Vec3(x0 + u * (x1 - x0), y, z0 + v * (z1 - z0)); },
                 {x1 - x0, z1 - z0});
}

void add_stone_wall(SceneAssembler& scene, int stone, int mortar, const Eigen::Affine3f& at, float length_m,
                    float height_m, const MasonryLook& look, const std::optional<WallOpening>& opening,
                    float reveal_m) {
  MasonryLook panel_look = look;
  // Mortar reaches past the ends of the wall, so that no light leaks through where walls and floor meet.
  constexpr float kPast = 0.12f;
  const auto add_panel = [&](float x0, float x1, float z0, float z1) {
    if (x1 - x0 < 2 * look.rounding || z1 - z0 < 2 * look.rounding) return;
    ++panel_look.seed;
    scene.add(stone, placed(placed(stone_courses(x1 - x0, z1 - z0, panel_look), Vec3(x0, 0, z0)), at));
    const Mesh back =
        upright_rectangle(x0 > 0 ? x0 : -kPast, x1 < length_m ? x1 : length_m + kPast, z0 > 0 ? z0 : -kPast,
                          z1 < height_m ? z1 : height_m + kPast, look.mortar_back);
    scene.add(mortar, placed(back, at));
  };
  if (!opening) {
    add_panel(0, length_m, 0, height_m);
    return;
  }
  const auto [x0, x1, z0, z1] = *opening;
  add_panel(0, x0, 0, height_m);
  add_panel(x1, length_m, 0, height_m);
  add_panel(x0, x1, 0, z0);
  add_panel(x0, x1, z1, height_m);
  constexpr float kThick = 0.06f;
  const auto add_reveal = [&](const Vec3& size, const Vec3& centre) {
    scene.add(mortar, placed(placed(bevelled_box(size, 0.004f), centre), at));
  };
  const float middle = reveal_m / 2 + look.mortar_back;
  for (const auto& [x, side] : {std::pair{x0, -1.f}, std::pair{x1, 1.f}}) {
    add_reveal({kThick, reveal_m, z1 - z0 + 2 * kThick}, {x + side * kThick / 2, middle, (z0 + z1) / 2});
  }
  for (const auto& [z, side] : {std::pair{z0, -1.f}, std::pair{z1, 1.f}}) {
    add_reveal({x1 - x0, reveal_m, kThick}, {(x0 + x1) / 2, middle, z + side * kThick / 2});
  }
}

}  // namespace plenolab
