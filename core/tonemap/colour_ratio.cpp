#include "core/tonemap/colour_ratio.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr std::size_t kBlock = 256;  // pixels: the buffers stay in the nearest cache

using Ratios = std::array<float, 3 * kBlock>;

void divide_by_luminance(std::span<const Rgb> scene, Ratios& ratio) {
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const float l = luminance(scene[i]);
    const bool black = !(l > 0);
    ratio[3 * i] = black ? 1.0f : scene[i].r / l;
    ratio[3 * i + 1] = black ? 1.0f : scene[i].g / l;
    ratio[3 * i + 2] = black ? 1.0f : scene[i].b / l;
  }
}

float cut(float v, std::int64_t& clipped) {
  clipped += v > 1 ? 1 : 0;
  return std::min(v, 1.0f);
}

std::int64_t colour_block(std::span<const Rgb> scene, std::span<const float> luma, float exponent,
                          std::span<Rgb> out) {
  Ratios ratio;
  divide_by_luminance(scene, ratio);
  const std::span<float> used(ratio.data(), 3 * scene.size());
  if (exponent != 1) power_row(used, exponent, used);
  std::int64_t clipped = 0;
  for (std::size_t i = 0; i < scene.size(); ++i)
    out[i] = {cut(luma[i] * ratio[3 * i], clipped), cut(luma[i] * ratio[3 * i + 1], clipped),
              cut(luma[i] * ratio[3 * i + 2], clipped)};
  return clipped;
}

}  // namespace

std::int64_t apply_colour_ratio(std::span<const Rgb> scene, std::span<const float> luma, double exponent,
                                std::span<Rgb> out) {
  PLENOLAB_CHECK(scene.size() == luma.size() && scene.size() == out.size(), "rows of equal length");
  std::int64_t clipped = 0;
  for (std::size_t begin = 0; begin < scene.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, scene.size() - begin);
    clipped += colour_block(scene.subspan(begin, count), luma.subspan(begin, count),
                            static_cast<float>(exponent), out.subspan(begin, count));
  }
  return clipped;
}

}  // namespace plenolab
