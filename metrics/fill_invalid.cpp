#include "metrics/fill_invalid.h"

#include "metrics/comparison.h"

namespace plenolab {

Plane<float> fill_invalid(Plane<float> plane, const Mask* valid) {
  if (valid == nullptr) return plane;
  double sum = 0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    sum += static_cast<double>(plane.pixels()[i]);
    ++count;
  }
  for (std::size_t i = 0; i < plane.size(); ++i)
    if (!is_valid(valid, i)) plane.pixels()[i] = static_cast<float>(sum / static_cast<double>(count));
  return plane;
}

}  // namespace plenolab
