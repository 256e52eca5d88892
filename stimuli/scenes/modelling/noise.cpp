#include "stimuli/scenes/modelling/noise.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace plenolab {
namespace {

std::uint64_t cell_word(int x, int y, int z, std::uint32_t seed) {
  const auto word = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
  return mix64(word(x) * 0x9e3779b97f4a7c15ull ^ word(y) * 0xc2b2ae3d27d4eb4full ^
               word(z) * 0x165667b19e3779f9ull ^ (std::uint64_t{seed} << 17));
}

/// Dot product of (x, y, z) with one of the twelve edge directions of a cube.
float edge_gradient(std::uint64_t word, float x, float y, float z) {
  const unsigned h = static_cast<unsigned>(word >> 60);
  const float a = h < 8 ? x : y;
  const float b = h < 4 ? y : (h == 12 || h == 14 ? x : z);
  return ((h & 1u) != 0 ? -a : a) + ((h & 2u) != 0 ? -b : b);
}

float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
float lerp(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

float cell_random(int x, int y, int z, std::uint32_t seed) {
  return unit_float(cell_word(x, y, z, seed));
}

float gradient_noise(const Vec3& p, std::uint32_t seed) {
  const int ix = static_cast<int>(std::floor(p.x())), iy = static_cast<int>(std::floor(p.y())),
            iz = static_cast<int>(std::floor(p.z()));
  const float x = p.x() - static_cast<float>(ix), y = p.y() - static_cast<float>(iy),
              z = p.z() - static_cast<float>(iz);
  const auto corner = [&](int dx, int dy, int dz) {
    return edge_gradient(cell_word(ix + dx, iy + dy, iz + dz, seed), x - static_cast<float>(dx),
                         y - static_cast<float>(dy), z - static_cast<float>(dz));
  };
  const float u = fade(x), v = fade(y), w = fade(z);
  const float low =
      lerp(lerp(corner(0, 0, 0), corner(1, 0, 0), u), lerp(corner(0, 1, 0), corner(1, 1, 0), u), v);
  const float high =
      lerp(lerp(corner(0, 0, 1), corner(1, 0, 1), u), lerp(corner(0, 1, 1), corner(1, 1, 1), u), v);
  return lerp(low, high, w);
}

float fractal_noise(const Vec3& p, int octaves, std::uint32_t seed) {
  float sum = 0, amplitude = 1, scale = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * gradient_noise(p * scale, seed + static_cast<std::uint32_t>(i));
    amplitude *= 0.5f;
    scale *= 2;
  }
  return sum * 0.75f;
}

CellularNoise cellular_noise(const Vec3& p, std::uint32_t seed) {
  const int ix = static_cast<int>(std::floor(p.x())), iy = static_cast<int>(std::floor(p.y())),
            iz = static_cast<int>(std::floor(p.z()));
  CellularNoise result{9, 9, 0};
  for (int n = 0; n < 27; ++n) {
    const int x = ix + n % 3 - 1, y = iy + n / 3 % 3 - 1, z = iz + n / 9 - 1;
    const Vec3 point(static_cast<float>(x) + cell_random(x, y, z, seed),
                     static_cast<float>(y) + cell_random(x, y, z, seed + 1),
                     static_cast<float>(z) + cell_random(x, y, z, seed + 2));
    const float distance = (point - p).norm();
    if (distance < result.nearest) {
      result = {distance, result.nearest, cell_random(x, y, z, seed + 3)};
    } else {
      result.second = std::min(result.second, distance);
    }
  }
  return result;
}

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.f, 1.f);
  return t * t * (3 - 2 * t);
}

Rgb mix(Rgb a, Rgb b, float t) {
  const float k = std::clamp(t, 0.f, 1.f);
  return a * (1 - k) + b * k;
}

}  // namespace plenolab
