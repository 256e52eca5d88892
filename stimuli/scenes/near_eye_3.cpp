// Near-eye 3, objects behind each other: five rows of posts and balls from 0.25 m to 3 m, staggered so that
// each row shows through the gaps of the one before: surfaces that one corner camera sees are hidden from
// another.

#include <array>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/near_eye.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

constexpr std::array kRows_m{0.25f, 0.45f, 0.8f, 1.5f, 3.0f};
constexpr std::array<Rgb, 5> kColours{{{0.55f, 0.36f, 0.20f},
                                       {0.20f, 0.42f, 0.40f},
                                       {0.62f, 0.20f, 0.18f},
                                       {0.66f, 0.60f, 0.36f},
                                       {0.24f, 0.30f, 0.55f}}};

}  // namespace

Scene build_near_eye_3() {
  SceneAssembler scene;
  add_surroundings(scene, -0.6f, {0.58f, 0.56f, 0.52f}, {0.36f, 0.30f, 0.26f}, 33);
  RandomStream random(103, 0x6e656172, 3);
  for (std::size_t row = 0; row < kRows_m.size(); ++row) {
    const float y = kRows_m[row], half = half_extent_m(y);
    const int material =
        add_mottled(scene, kColours[row], kColours[row] * 0.55f, y, 8, static_cast<std::uint32_t>(row + 10));
    const int posts = 3 + static_cast<int>(row);
    for (int i = 0; i <= posts; ++i) {
      const float shift = row % 2 == 0 ? 0.5f : 0.0f;
      const float x = half * (2 * (static_cast<float>(i) + shift) / static_cast<float>(posts) - 1.0f);
      const float radius = half * (0.05f + 0.04f * random.next_float());
      const float top = half * (0.1f + 0.8f * random.next_float());
      scene.add(material, rod({x, y, -1.2f * half}, {x, y, top}, radius, 0.8f * radius, 40));
      scene.add(material,
                placed(ellipsoid({1.7f * radius, 1.7f * radius, 1.7f * radius}, 32), Vec3(x, y, top)));
    }
  }
  return finish_near_eye(
      scene, "near-eye-3", "Objects behind each other",
      "Five staggered rows of posts from 0.25 m to 3 m: what one corner camera sees through a gap "
      "is hidden from another.");
}

}  // namespace plenolab
