#pragma once

#include <optional>

#include "core/image/image.h"

namespace plenolab {

/// A channel value of an image and its pixel.
struct ValueAtPixel {
  float value = 0;
  int x = 0, y = 0;
};

/// The first value, row by row, that a file format cannot hold, or nothing.
template <class Refused>
std::optional<ValueAtPixel> find_value(const Plane<Rgb>& image, Refused refused) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.at(x, y);
      for (const float v : {c.r, c.g, c.b})
        if (refused(v)) return ValueAtPixel{v, x, y};
    }
  return std::nullopt;
}

}  // namespace plenolab
