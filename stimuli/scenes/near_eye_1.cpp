// Near-eye 1, many objects: blocks and balls of all sizes float between 0.3 m and 4 m before a papered wall,
// so that depth edges run through every subimage, none of them with much disparity between neighbouring
// cameras.

#include <array>

#include "core/base/random.h"
#include "stimuli/scenes/modelling/near_eye.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

constexpr int kObjects = 140;

constexpr std::array<std::array<Rgb, 2>, 6> kColours{{{Rgb{0.62f, 0.16f, 0.10f}, Rgb{0.38f, 0.07f, 0.06f}},
                                                      {Rgb{0.14f, 0.30f, 0.55f}, Rgb{0.07f, 0.15f, 0.32f}},
                                                      {Rgb{0.70f, 0.58f, 0.20f}, Rgb{0.50f, 0.36f, 0.10f}},
                                                      {Rgb{0.20f, 0.45f, 0.20f}, Rgb{0.09f, 0.25f, 0.10f}},
                                                      {Rgb{0.68f, 0.66f, 0.62f}, Rgb{0.45f, 0.42f, 0.40f}},
                                                      {Rgb{0.45f, 0.22f, 0.50f}, Rgb{0.25f, 0.10f, 0.30f}}}};

}  // namespace

Scene build_near_eye_1() {
  SceneAssembler scene;
  add_surroundings(scene, -0.55f, {0.55f, 0.52f, 0.45f}, {0.45f, 0.32f, 0.22f}, 31);
  RandomStream random(101, 0x6e656172, 1);
  for (int i = 0; i < kObjects; ++i) {
    // Even in disparity, so that near and far are both crowded.
    const float near_share = random.next_float();
    const float y = 1 / (1 / 4.0f + near_share * near_share * (1 / 0.32f - 1 / 4.0f));
    const float half = 1.05f * half_extent_m(y);
    const float x = half * (2 * random.next_float() - 1), z = half * (2 * random.next_float() - 1);
    const float size = (0.05f + 0.09f * random.next_float()) * half;
    const auto& colours = kColours[random.next_u64() % kColours.size()];
    const int material = add_mottled(scene, colours[0], colours[1], y, 7, static_cast<std::uint32_t>(i));
    const Vec3 at(x, y, z);
    if (random.next_float() < 0.5f)
      scene.add(material, placed(ellipsoid({size, size, size}, 28), at));
    else
      scene.add(material, placed(placed(bevelled_box({2 * size, 1.6f * size, 1.5f * size}, 0.1f * size),
                                        pose({0, 0, 0}, 90 * random.next_float())),
                                 at));
  }
  return finish_near_eye(
      scene, "near-eye-1", "Many objects",
      "Blocks and balls of all sizes between 0.3 m and 4 m: depth edges everywhere, each with "
      "little disparity between neighbouring cameras.");
}

}  // namespace plenolab
