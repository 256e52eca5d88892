#include "stimuli/direct/walk_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {

namespace {

/// Objects collected with their names, one material each.
class Objects {
 public:
  void add(const std::string& name, Material material, const std::vector<Mesh>& parts) {
    const int index = scene_.material(std::move(material));
    for (const Mesh& part : parts) scene_.add(index, part);
    names_.push_back(name);
  }
  void add(const std::string& name, ColourTexture albedo, const std::vector<Mesh>& parts) {
    add(name, diffuse(std::move(albedo)), parts);
  }
  std::vector<std::string> finish(Scene& scene) {
    scene_.finish(scene);
    return names_;
  }

 private:
  SceneAssembler scene_;
  std::vector<std::string> names_;
};

/// Box between two corners.
Mesh block(const Vec3& min_m, const Vec3& max_m) {
  const Vec3 size = max_m - min_m;
  return placed(bevelled_box(size, 0.02f * size.minCoeff()), Vec3(0.5f * (min_m + max_m)));
}

/// Square tiles on horizontal surfaces, each of its own tone.
ColourTexture tiled(Rgb light, Rgb dark, float side_m, std::uint32_t seed) {
  return [=](const SurfacePoint& point) {
    const int across = static_cast<int>(std::floor(point.position_m.x() / side_m)),
              along = static_cast<int>(std::floor(point.position_m.y() / side_m));
    const float tone = 0.8f + 0.3f * cell_random(across, along, 0, seed);
    return mix(dark, light, (across + along) % 2 == 0 ? 1.0f : 0.0f) * tone;
  };
}

/// Horizontal panels with a dark line between them.
ColourTexture panelled(Rgb colour, float height_m, std::uint32_t seed) {
  return [=](const SurfacePoint& point) {
    const Vec3& p = point.position_m;
    const float row = p.z() / height_m;
    const float edge = std::abs(row - std::round(row)) * height_m;
    const float tone = 0.75f + 0.35f * cell_random(static_cast<int>(std::floor(row)), 0, 0, seed) +
                       0.12f * fractal_noise(p * 1.5f, 3, seed);
    return colour * (tone * (edge < 0.015f ? 0.4f : 1.0f));
  };
}

/// Stripes along the walking direction.
ColourTexture striped(Rgb a, Rgb b, float width_m) {
  return [=](const SurfacePoint& point) {
    return mix(a, b, smooth_step(-0.1f, 0.1f, std::sin(6.2831853f * point.position_m.x() / width_m)));
  };
}

Mesh ball(const Vec3& centre_m, float radius_m) {
  return placed(ellipsoid({radius_m, radius_m, radius_m}, 32), centre_m);
}

constexpr float kCorridorEnd_m = 10, kHallFront_m = 12.4f, kHallBack_m = 21, kHallSide_m = 5,
                kGardenLeft_m = 8.2f, kGardenRight_m = 16;

void add_corridor(Objects& objects) {
  const ColourTexture wall = panelled({0.42f, 0.45f, 0.48f}, 0.6f, 11);
  const float end = kCorridorEnd_m;
  objects.add("corridor left wall", wall, {block({-1.8f, -0.2f, 0}, {-1.5f, end, 3})});
  objects.add("corridor right wall", wall, {block({1.5f, -0.2f, 0}, {1.8f, end, 3})});
  objects.add("corridor end wall", wall, {block({-1.8f, -0.5f, 0}, {1.8f, -0.2f, 3})});
  objects.add("corridor ceiling", mottled({0.5f, 0.5f, 0.52f}, {0.3f, 0.31f, 0.34f}, 0.5f, 0, 12),
              {block({-1.8f, -0.5f, 3}, {1.8f, end, 3.3f})});
  objects.add("corridor floor", tiled({0.36f, 0.37f, 0.40f}, {0.22f, 0.23f, 0.26f}, 0.5f, 13),
              {block({-1.8f, -0.5f, -0.2f}, {1.8f, end, 0})});
  for (int i = 0; i < 4; ++i) {
    const float y = 1.5f + 2.2f * static_cast<float>(i), x = i % 2 == 0 ? -1.15f : 1.15f;
    const float side = 0.45f + 0.1f * static_cast<float>(i % 3);
    const Rgb colour = i % 2 == 0 ? Rgb{0.55f, 0.30f, 0.12f} : Rgb{0.16f, 0.32f, 0.42f};
    objects.add(fmt::format("crate {}", i + 1), mottled(colour, colour * 0.6f, 0.1f, 0, 14),
                {block({x - side / 2, y, 0}, {x + side / 2, y + side, side})});
    objects.add(fmt::format("corridor lamp {}", i + 1), lamp({420, 460, 500}),
                {block({-0.25f, y + 0.2f, 2.94f}, {0.25f, y + 0.8f, 2.99f})});
  }
}

void add_hall_walls(Objects& objects) {
  const ColourTexture wall = panelled({0.55f, 0.44f, 0.33f}, 1.25f, 21);
  const float front = kHallFront_m, back = kHallBack_m, side = kHallSide_m;
  objects.add(
      "hall front wall", wall,
      {block({-side, front, 0}, {-1.3f, front + 0.3f, 5}), block({1.3f, front, 0}, {side, front + 0.3f, 5}),
       block({-1.3f, front, 3}, {1.3f, front + 0.3f, 5})});
  objects.add("hall left wall", wall, {block({-side - 0.3f, front, 0}, {-side, back, 5})});
  objects.add("hall back wall", wall, {block({-side, back - 0.3f, 0}, {side, back, 5})});
  objects.add(
      "hall right wall", wall,
      {block({side, front, 0}, {side + 0.3f, 14.6f, 5}), block({side, 17.6f, 0}, {side + 0.3f, back, 5}),
       block({side, 14.6f, 3.2f}, {side + 0.3f, 17.6f, 5})});
  objects.add("hall ceiling", wood({.ring_m = 0.05f, .seed = 22}),
              {block({-side - 0.3f, front, 5}, {side + 0.3f, back, 5.3f})});
  objects.add("hall floor", tiled({0.50f, 0.42f, 0.32f}, {0.30f, 0.18f, 0.12f}, 0.8f, 23),
              {block({-side - 0.3f, front, -0.2f}, {side + 0.3f, back, 0})});
}

void add_hall(Objects& objects) {
  add_hall_walls(objects);
  for (int i = 0; i < 4; ++i) {
    const float x = i % 2 == 0 ? -2.9f : 2.9f, y = i < 2 ? 14.2f : 18.6f;
    objects.add(fmt::format("column {}", i + 1),
                mottled({0.60f, 0.55f, 0.48f}, {0.35f, 0.28f, 0.24f}, 0.3f, 0, 24),
                {rod({x, y, 0}, {x, y, 5}, 0.28f, 0.24f, 40),
                 block({x - 0.4f, y - 0.4f, 0}, {x + 0.4f, y + 0.4f, 0.3f})});
    objects.add(fmt::format("banner {}", i + 1),
                plain(i % 2 == 0 ? Rgb{0.50f, 0.08f, 0.07f} : Rgb{0.10f, 0.14f, 0.42f}),
                {block({-3.6f + 2.1f * static_cast<float>(i), kHallBack_m - 0.36f, 1.5f},
                       {-2.5f + 2.1f * static_cast<float>(i), kHallBack_m - 0.32f, 4.2f})});
  }
  objects.add("hall table", wood({.seed = 25}),
              {block({-1.2f, 18.4f, 0.7f}, {1.2f, 19.4f, 0.8f}),
               block({-1.0f, 18.6f, 0}, {-0.8f, 19.2f, 0.7f}), block({0.8f, 18.6f, 0}, {1.0f, 19.2f, 0.7f})});
  objects.add("red bowl", plain({0.62f, 0.10f, 0.06f}), {ball({-0.6f, 18.9f, 1.0f}, 0.2f)});
  objects.add("yellow bowl", plain({0.75f, 0.58f, 0.08f}), {ball({0.1f, 18.8f, 1.05f}, 0.25f)});
  objects.add("blue bowl", plain({0.08f, 0.18f, 0.55f}), {ball({0.75f, 19.0f, 0.98f}, 0.18f)});
  objects.add("chandelier", lamp({520, 400, 240}),
              {ball({0, 16.5f, 4.1f}, 0.22f), ball({-0.5f, 16.5f, 4}, 0.12f), ball({0.5f, 16.5f, 4}, 0.12f)});
}

void add_garden_frame(Objects& objects) {
  const ColourTexture frame = plain({0.62f, 0.64f, 0.60f});
  const float left = kGardenLeft_m, right = kGardenRight_m, front = kHallFront_m, back = kHallBack_m;
  std::vector<Mesh> posts;
  for (int i = 0; i <= 4; ++i) {
    const float x = left + 0.1f + (right - left - 0.2f) * static_cast<float>(i) / 4;
    for (const float y : {front + 0.1f, back - 0.1f})
      posts.push_back(block({x - 0.08f, y - 0.08f, 0}, {x + 0.08f, y + 0.08f, 4}));
    posts.push_back(block({x - 0.06f, front, 4}, {x + 0.06f, back, 4.2f}));
  }
  for (const float y : {14.2f, 18.0f}) {
    posts.push_back(block({left, y - 0.08f, 0}, {left + 0.16f, y + 0.08f, 4}));
    posts.push_back(block({right - 0.16f, y - 0.08f, 0}, {right, y + 0.08f, 4}));
  }
  objects.add("garden house frame", frame, posts);
  objects.add("garden house sill", mottled({0.52f, 0.46f, 0.40f}, {0.30f, 0.30f, 0.26f}, 0.3f, 0, 31),
              {block({left, back - 0.25f, 0}, {right, back, 0.8f}),
               block({left, front, 0}, {right, front + 0.25f, 0.8f}),
               block({right - 0.25f, front, 0}, {right, back, 0.8f})});
  objects.add("garden house floor", tiled({0.46f, 0.40f, 0.34f}, {0.34f, 0.32f, 0.28f}, 0.6f, 32),
              {block({left, front, -0.2f}, {right, back, 0})});
}

void add_garden(Objects& objects) {
  add_garden_frame(objects);
  for (int i = 0; i < 6; ++i) {
    const float x = 9.6f + 1.1f * static_cast<float>(i), y = i % 2 == 0 ? 13.6f : 19.4f;
    const float tall = 0.5f + 0.25f * static_cast<float>(i % 3);
    objects.add(fmt::format("pot {}", i + 1), plain({0.52f, 0.24f, 0.12f}),
                {rod({x, y, 0}, {x, y, 0.5f}, 0.24f, 0.34f, 32)});
    const Rgb leaf{0.10f + 0.04f * static_cast<float>(i % 3), 0.34f, 0.08f};
    objects.add(fmt::format("plant {}", i + 1), mottled(leaf, leaf * 0.4f, 0.12f, 0.2f, 33),
                {placed(ellipsoid({0.55f, 0.55f, tall}, 40), Vec3(x, y, 0.5f + tall))});
    const Rgb flower = i % 2 == 0 ? Rgb{0.75f, 0.20f, 0.35f} : Rgb{0.80f, 0.65f, 0.12f};
    objects.add(
        fmt::format("flowers {}", i + 1), plain(flower),
        {ball({x - 0.3f, y - 0.3f, 0.6f + tall}, 0.16f), ball({x + 0.35f, y - 0.25f, 0.8f + tall}, 0.13f)});
  }
  objects.add(
      "garden bench", wood({.weathering = 0.6f, .seed = 34}),
      {block({13.2f, 15.2f, 0.4f}, {13.8f, 17.6f, 0.5f}), block({13.7f, 15.2f, 0.5f}, {13.8f, 17.6f, 1.0f}),
       block({13.3f, 15.3f, 0}, {13.5f, 15.5f, 0.4f}), block({13.3f, 17.3f, 0}, {13.5f, 17.5f, 0.4f})});
}

/// What lies in more than one room.
void add_crossing(Objects& objects) {
  objects.add("carpet", striped({0.52f, 0.10f, 0.10f}, {0.30f, 0.05f, 0.08f}, 0.35f),
              {block({-0.7f, 5, 0}, {0.7f, 16, 0.015f})});
  objects.add("pipe", plain({0.50f, 0.40f, 0.26f}),
              {rod({-1.1f, 0, 2.6f}, {-1.1f, 13.6f, 2.6f}, 0.12f, 0.12f, 24)});
  std::vector<Mesh> pergola;
  for (const float y : {14.8f, 17.4f})
    pergola.push_back(block({3.4f, y - 0.07f, 2.85f}, {11, y + 0.07f, 3.05f}));
  for (int i = 0; i < 10; ++i) {
    const float x = 3.6f + 0.8f * static_cast<float>(i);
    pergola.push_back(block({x - 0.05f, 14.6f, 3.05f}, {x + 0.05f, 17.6f, 3.15f}));
  }
  objects.add("pergola", wood({.weathering = 0.5f, .seed = 41}), pergola);
  objects.add("long bench", wood({.seed = 42}),
              {block({4.2f, 17.0f, 0.4f}, {9.6f, 17.4f, 0.5f}), block({4.4f, 17.0f, 0}, {4.6f, 17.4f, 0.4f}),
               block({9.2f, 17.0f, 0}, {9.4f, 17.4f, 0.4f})});
}

void add_park(Objects& objects) {
  objects.add("lawn", mottled({0.20f, 0.30f, 0.10f}, {0.10f, 0.18f, 0.05f}, 1.5f, 0.1f, 51),
              {block({-80, -80, -0.6f}, {100, 110, -0.21f})});
  objects.add(
      "path", mottled({0.46f, 0.42f, 0.36f}, {0.34f, 0.30f, 0.26f}, 0.3f, 0, 52),
      {block({-1.6f, 9.9f, -0.3f}, {1.6f, 12.5f, -0.01f}), block({5.2f, 14.2f, -0.3f}, {8.3f, 18, -0.01f})});
  for (int i = 0; i < 22; ++i) {
    const float angle = 6.2831853f * (static_cast<float>(i) + 0.4f * cell_random(i, 0, 0, 53)) / 22;
    const float away = 26 + 16 * cell_random(i, 1, 0, 53), x = 3 + away * std::cos(angle),
                y = 12 + away * std::sin(angle), tall = 3 + 3 * cell_random(i, 2, 0, 53);
    const Rgb leaf{0.12f + 0.1f * cell_random(i, 3, 0, 53), 0.26f, 0.07f};
    objects.add(fmt::format("trunk {}", i + 1), plain({0.22f, 0.15f, 0.10f}),
                {rod({x, y, -0.3f}, {x, y, tall}, 0.4f, 0.25f, 16)});
    objects.add(fmt::format("crown {}", i + 1), mottled(leaf, leaf * 0.45f, 0.8f, 0.1f, 54),
                {placed(ellipsoid({0.6f * tall, 0.6f * tall, 0.7f * tall}, 40), Vec3(x, y, 1.5f * tall))});
  }
}

/// Blue with veils of cloud, paler towards the horizon.
Rgb daylight(const Vec3& direction) {
  const float height = std::max(0.0f, direction.z());
  const Rgb clear = mix({230, 255, 285}, {80, 135, 265}, std::min(1.0f, 2 * height));
  const float cloud = smooth_step(0.05f, 0.6f, fractal_noise(direction * 3, 4, 61));
  return mix(clear, {300, 296, 290}, 0.7f * cloud);
}

void add_lights(LitScene& lit) {
  for (int i = 0; i < 4; ++i)
    lit.points.push_back({{0, 1.9f + 2.2f * static_cast<float>(i), 2.8f}, Rgb{190, 210, 230}});
  lit.points.push_back({{0, 16.5f, 3.8f}, {2100, 1600, 980}});
  lit.directions.push_back({Vec3(0.45f, -0.55f, 0.70f).normalized(), {1300, 1200, 1000}});
  lit.scene.sky = {.kind = Sky::Kind::kUniform, .zenith_cd_m2 = {24, 28, 36}, .ground_cd_m2 = {14, 13, 10}};
  lit.environment = daylight;
}

}  // namespace

WalkScene build_walk_scene() {
  WalkScene walk;
  Objects objects;
  add_corridor(objects);
  add_hall(objects);
  add_garden(objects);
  add_crossing(objects);
  add_park(objects);
  walk.objects = objects.finish(walk.lit.scene);
  walk.lit.scene.id = "walk";
  walk.lit.scene.title = "Walk";
  walk.lit.scene.description = "A corridor, a hall and a garden house in a park, to be walked through.";
  add_lights(walk.lit);
  walk.rooms = {{{"corridor", {-2, -0.6f, -0.25f}, {2, kCorridorEnd_m + 0.1f, 3.4f}},
                 {"hall",
                  {-kHallSide_m - 0.4f, kHallFront_m - 0.1f, -0.25f},
                  {kHallSide_m + 0.4f, kHallBack_m + 0.1f, 5.4f}},
                 {"garden house",
                  {kGardenLeft_m - 0.1f, kHallFront_m - 0.1f, -0.25f},
                  {kGardenRight_m + 0.1f, kHallBack_m + 0.1f, 4.4f}}}};
  return walk;
}

}  // namespace plenolab
