#pragma once

#include <cstdint>

#include "stimuli/scene.h"

namespace plenolab {

/// Procedural surfaces as functions of position or part coordinates (parts.h). Albedos stay within [0, 1].

/// One colour everywhere.
ColourTexture plain(Rgb albedo);
/// One value everywhere.
ScalarTexture constant(float value);

/// Sawn timber: grain along v of the part, each part with its own tone between `dark` and `light`;
/// `weathering` in [0, 1] greys it and adds stains.
struct WoodLook {
  Rgb light{0.42f, 0.29f, 0.17f}, dark{0.16f, 0.09f, 0.045f};
  float ring_m = 0.012f;  ///< distance of grain lines
  float weathering = 0.3f;
  std::uint32_t seed = 1;
};
ColourTexture wood(const WoodLook& look);

/// Natural stone: each part its own tone, mottled at `grain_m`, darker in blotches.
struct StoneLook {
  Rgb light{0.46f, 0.42f, 0.36f}, dark{0.24f, 0.22f, 0.20f};
  float grain_m = 0.05f;
  float tone_spread = 0.6f;  ///< how much parts differ, in [0, 1]
  std::uint32_t seed = 2;
};
ColourTexture stone(const StoneLook& look);

/// Mottled colour without parts: `base` to `stain` by fractal noise of `scale_m`, shifted by `balance` in
/// [−1, 1].
ColourTexture mottled(Rgb base, Rgb stain, float scale_m, float balance, std::uint32_t seed);

/// Furrowed bark: ridges along v of a tube.
ColourTexture bark(Rgb ridge, Rgb furrow, std::uint32_t seed);

/// Shading normal of a surface whose height is fractal noise over space: n tilted against the tangential
/// gradient (bump mapping, Blinn 1978). `height_m` is the largest height, `frequency_per_m` of its features
/// along each axis.
struct BumpLook {
  float height_m = 0.003f;
  Vec3 frequency_per_m{40, 40, 40};
  int octaves = 2;
  std::uint32_t seed = 5;
};
NormalTexture bumpy(const BumpLook& look);

}  // namespace plenolab
