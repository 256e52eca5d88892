#include "stimuli/scenes/modelling/textures.h"

#include <algorithm>
#include <cmath>

#include "stimuli/scenes/modelling/noise.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {
namespace {

float to_unit(float signed_noise) {
  return std::clamp(0.5f + 0.5f * signed_noise, 0.f, 1.f);
}

}  // namespace

ColourTexture plain(Rgb albedo) {
  return [albedo](const SurfacePoint&) { return albedo; };
}

ScalarTexture constant(float value) {
  return [value](const SurfacePoint&) { return value; };
}

ColourTexture wood(const WoodLook& look) {
  return [look](const SurfacePoint& point) {
    const PartPoint part = part_of(point);
    const auto layer = static_cast<float>(part.number) * 3.7f;
    const float tone = cell_random(part.number, 0, 0, look.seed);
    // Rings of the trunk cut lengthwise: lines along v, bent slowly by noise, closer on one side of the
    // board.
    const float bend = gradient_noise({part.u * 6, part.v * 0.9f, layer}, look.seed);
    const float rings = (part.u + 0.03f * bend) / look.ring_m;
    const float line = to_unit(gradient_noise({rings, part.v * 0.6f, layer}, look.seed + 1));
    const float fibre = to_unit(gradient_noise({part.u * 350, part.v * 7, layer}, look.seed + 2));
    const float grain = 0.8f * line + 0.14f * fibre + 0.45f * (tone - 0.5f) + 0.035f;
    const Rgb fresh = mix(look.dark, look.light, grain);
    const float stain = to_unit(fractal_noise({part.u * 5, part.v * 1.5f, layer + 9}, 3, look.seed + 3));
    const Rgb grey = Rgb{0.27f, 0.25f, 0.225f} * (0.35f + 0.8f * grain);
    return mix(fresh, grey, look.weathering * (0.35f + 0.9f * stain)) * (0.75f + 0.25f * stain);
  };
}

ColourTexture stone(const StoneLook& look) {
  return [look](const SurfacePoint& point) {
    const PartPoint part = part_of(point);
    const float tone = cell_random(part.number, 0, 0, look.seed) - 0.5f;
    const float warmth = cell_random(part.number, 1, 0, look.seed) - 0.5f;
    const Vec3 p = point.position_m / look.grain_m;
    const float mottle = fractal_noise(p, 3, look.seed + 1);
    const float speck = gradient_noise(p * 6, look.seed + 5);
    const float blotch = to_unit(fractal_noise(p * 0.12f, 3, look.seed + 9));
    const float t = 0.5f + look.tone_spread * tone + 0.35f * mottle + 0.14f * speck;
    const Rgb base = mix(look.dark, look.light, t);
    const float tint = 0.14f * look.tone_spread * warmth;
    return Rgb{base.r * (1 + tint), base.g, base.b * (1 - tint)} * (0.62f + 0.38f * blotch);
  };
}

ColourTexture mottled(Rgb base, Rgb stain, float scale_m, float balance, std::uint32_t seed) {
  return [=](const SurfacePoint& point) {
    const Vec3 p = point.position_m / scale_m;
    const float t =
        0.5f + 0.5f * balance + 0.6f * fractal_noise(p, 4, seed) + 0.1f * gradient_noise(p * 23, seed + 7);
    return mix(base, stain, t);
  };
}

ColourTexture bark(Rgb ridge, Rgb furrow, std::uint32_t seed) {
  return [=](const SurfacePoint& point) {
    const PartPoint part = part_of(point);
    const Vec3 p(point.position_m.x() * 14, point.position_m.y() * 14, point.position_m.z() * 3.5f);
    const CellularNoise cells = cellular_noise(p, seed);
    const float plate = cells.second - cells.nearest;
    const float fine = to_unit(fractal_noise(point.position_m * 30, 3, seed + 4));
    return mix(furrow, ridge, smooth_step(0.02f, 0.45f, plate)) * (0.6f + 0.5f * fine) *
           (0.85f + 0.15f * cell_random(part.number, 0, 0, seed));
  };
}

NormalTexture bumpy(const BumpLook& look) {
  return [look](const SurfacePoint& point) {
    const Vec3 slope =
        fractal_noise_slope(point.position_m.cwiseProduct(look.frequency_per_m), look.octaves, look.seed);
    const Vec3 gradient = look.height_m * slope.cwiseProduct(look.frequency_per_m);
    const Vec3 tangential = gradient - point.normal * gradient.dot(point.normal);
    return Vec3((point.normal - tangential).normalized());
  };
}

}  // namespace plenolab
