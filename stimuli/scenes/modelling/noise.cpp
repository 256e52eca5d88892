#include "stimuli/scenes/modelling/noise.h"

#include <algorithm>
#include <array>

namespace plenolab {
namespace {

/// Largest integer ≤ x for |x| < 2³¹, without a call of the mathematical library.
int floor_int(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

// Cells are hashed by 32-bit words: textures call this more often than anything else, and eight corners are
// worked on at once. Finaliser by Wellons ("lowbias32").
constexpr std::uint32_t hash32(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

std::uint32_t cell_word(int x, int y, int z, std::uint32_t seed) {
  return hash32(static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                static_cast<std::uint32_t>(z) * 0xcb1ab31fu ^ seed * 0x9e3779b9u);
}

constexpr float kFractalScale = 0.75f;

float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
float fade_slope(float t) {
  return 30 * t * t * (t * (t - 2) + 1);
}
float lerp(float a, float b, float t) {
  return a + (b - a) * t;
}

/// The cell of a point: random gradients at its eight corners (index 4·dx + 2·dy + dz) and what they give
/// there.
struct Lattice {
  std::array<float, 8> gx, gy, gz, value;
  float x, y, z;  ///< within the cell
};

Lattice lattice_at(const Vec3& p, std::uint32_t seed) {
  const int ix = floor_int(p.x()), iy = floor_int(p.y()), iz = floor_int(p.z());
  Lattice l;
  l.x = p.x() - static_cast<float>(ix);
  l.y = p.y() - static_cast<float>(iy);
  l.z = p.z() - static_cast<float>(iz);
  for (int i = 0; i < 8; ++i) {
    const int dx = i >> 2, dy = (i >> 1) & 1, dz = i & 1;
    const std::uint32_t word = cell_word(ix + dx, iy + dy, iz + dz, seed);
    // Uniform in a cube: even enough, and free of branches.
    const auto k = static_cast<std::size_t>(i);
    l.gx[k] = static_cast<float>(static_cast<int>(word & 1023u) - 512) * (1.3f / 512);
    l.gy[k] = static_cast<float>(static_cast<int>((word >> 10) & 1023u) - 512) * (1.3f / 512);
    l.gz[k] = static_cast<float>(static_cast<int>(word >> 22) - 512) * (1.3f / 512);
    l.value[k] = l.gx[k] * (l.x - static_cast<float>(dx)) + l.gy[k] * (l.y - static_cast<float>(dy)) +
                 l.gz[k] * (l.z - static_cast<float>(dz));
  }
  return l;
}

float blend(const std::array<float, 8>& c, float u, float v, float w) {
  const float near_x = lerp(lerp(c[0], c[1], w), lerp(c[2], c[3], w), v);
  const float far_x = lerp(lerp(c[4], c[5], w), lerp(c[6], c[7], w), v);
  return lerp(near_x, far_x, u);
}

}  // namespace

float cell_random(int x, int y, int z, std::uint32_t seed) {
  return static_cast<float>(cell_word(x, y, z, seed) >> 8) * 0x1.0p-24f;
}

float gradient_noise(const Vec3& p, std::uint32_t seed) {
  const Lattice l = lattice_at(p, seed);
  return blend(l.value, fade(l.x), fade(l.y), fade(l.z));
}

Vec3 gradient_noise_slope(const Vec3& p, std::uint32_t seed) {
  const Lattice l = lattice_at(p, seed);
  const float u = fade(l.x), v = fade(l.y), w = fade(l.z);
  const auto& c = l.value;
  const float across_x = lerp(lerp(c[4] - c[0], c[5] - c[1], w), lerp(c[6] - c[2], c[7] - c[3], w), v);
  const float across_y = lerp(lerp(c[2] - c[0], c[3] - c[1], w), lerp(c[6] - c[4], c[7] - c[5], w), u);
  const float across_z = lerp(lerp(c[1] - c[0], c[3] - c[2], v), lerp(c[5] - c[4], c[7] - c[6], v), u);
  return {blend(l.gx, u, v, w) + fade_slope(l.x) * across_x,
          blend(l.gy, u, v, w) + fade_slope(l.y) * across_y,
          blend(l.gz, u, v, w) + fade_slope(l.z) * across_z};
}

float fractal_noise(const Vec3& p, int octaves, std::uint32_t seed) {
  float sum = 0, amplitude = 1, scale = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * gradient_noise(p * scale, seed + static_cast<std::uint32_t>(i));
    amplitude *= 0.5f;
    scale *= 2;
  }
  return sum * kFractalScale;
}

Vec3 fractal_noise_slope(const Vec3& p, int octaves, std::uint32_t seed) {
  Vec3 sum = Vec3::Zero();
  float scale = 1;  // amplitude · scale = 1
  for (int i = 0; i < octaves; ++i) {
    sum += gradient_noise_slope(p * scale, seed + static_cast<std::uint32_t>(i));
    scale *= 2;
  }
  return sum * kFractalScale;
}

CellularNoise cellular_noise(const Vec3& p, std::uint32_t seed) {
  const int ix = floor_int(p.x()), iy = floor_int(p.y()), iz = floor_int(p.z());
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
