#include "core/image/repair.h"

#include <algorithm>
#include <cmath>

namespace plenolab {

namespace {

void count(float v, PixelRepairs& repairs) {
  if (std::isnan(v))
    ++repairs.nan;
  else if (v < 0)
    ++repairs.negative;
  else if (std::isinf(v))
    ++repairs.positive_infinity;
}

}  // namespace

float largest_finite(const SceneImage& image) {
  float largest = 0;
  for (const Rgb& c : image.pixels())
    for (const float v : {c.r, c.g, c.b})
      if (std::isfinite(v)) largest = std::max(largest, v);
  return largest;
}

float repaired_value(float v, float largest) {
  if (std::isnan(v) || v < 0) return 0;
  return std::isinf(v) ? largest : v;
}

PixelRepairs count_defects(const SceneImage& image) {
  PixelRepairs repairs;
  for (const Rgb& c : image.pixels())
    for (const float v : {c.r, c.g, c.b}) count(v, repairs);
  return repairs;
}

PixelRepairs repair(SceneImage& image) {
  const PixelRepairs repairs = count_defects(image);
  if (repairs.total() == 0) return repairs;
  const float largest = largest_finite(image);
  for (Rgb& c : image.pixels())
    c = {repaired_value(c.r, largest), repaired_value(c.g, largest), repaired_value(c.b, largest)};
  return repairs;
}

}  // namespace plenolab
