#pragma once

#include <cstdint>

#include "stimuli/scene.h"

namespace plenolab {

/// Uniform in [0, 1) for an integer cell: what gives every board, stone or leaf its own colour and size.
float cell_random(int x, int y, int z, std::uint32_t seed);

/// Gradient noise (Perlin 2002, hashed gradients) in about [−1, 1], mean 0, features of size 1.
float gradient_noise(const Vec3& p, std::uint32_t seed = 0);
/// Its exact derivative by p.
Vec3 gradient_noise_slope(const Vec3& p, std::uint32_t seed = 0);

/// Fractal sum of `octaves` ≥ 1 gradient noises, each of twice the frequency and half the amplitude, scaled
/// to about [−1, 1].
float fractal_noise(const Vec3& p, int octaves, std::uint32_t seed = 0);
/// Its exact derivative by p.
Vec3 fractal_noise_slope(const Vec3& p, int octaves, std::uint32_t seed = 0);

/// Cellular noise (Worley 1996): distances to the nearest and second nearest of one jittered point per unit
/// cell, and a random number of the nearest one.
struct CellularNoise {
  float nearest = 0, second = 0, cell = 0;
};
CellularNoise cellular_noise(const Vec3& p, std::uint32_t seed = 0);

/// Cubic step from 0 at `from` to 1 at `to`; from ≠ to, in either order.
float smooth_step(float from, float to, float x);

/// a·(1 − t) + b·t with t clamped to [0, 1].
Rgb mix(Rgb a, Rgb b, float t);

}  // namespace plenolab
