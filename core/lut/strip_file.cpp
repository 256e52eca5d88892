#include "core/lut/strip_file.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace plenolab {

namespace {
/// Of programs that compute nodes in 32 bits or less; a strip of 16 bits has steps of 1.5e-5.
constexpr float kRounding = 1e-4f;
}  // namespace

Lut lut_of_strip(const DisplayImage& strip, const std::string& name) {
  const int size = strip.height();
  if (size < kSmallestLut || size > kLargestLut || strip.width() != size * size)
    throw InputError(fmt::format(
        "{} has {} × {} pixels and is no strip of a look-up table, which has N² × N with N of {} to {}", name,
        strip.width(), strip.height(), kSmallestLut, kLargestLut));
  Lut lut;
  lut.size = size;
  lut.nodes.resize(strip.size());
  for (int b = 0; b < size; ++b)
    for (int g = 0; g < size; ++g)
      for (int r = 0; r < size; ++r) lut.node(r, g, b) = strip.at(b * size + r, g);
  lut.validate();
  return lut;
}

DisplayImage strip_of_lut(const Lut& lut) {
  lut.validate();
  if (lut.domain_min != Rgb{0, 0, 0} || lut.domain_max != Rgb{1, 1, 1})
    throw InputError("an image strip holds only look-up tables of the domain 0 to 1: write a .cube file");
  DisplayImage strip(lut.size * lut.size, lut.size);
  for (int b = 0; b < lut.size; ++b)
    for (int g = 0; g < lut.size; ++g)
      for (int r = 0; r < lut.size; ++r) {
        const Rgb& c = lut.node(r, g, b);
        const auto outside = [](float v) { return !(v >= -kRounding && v <= 1 + kRounding); };
        if (outside(c.r) || outside(c.g) || outside(c.b))
          throw InputError(fmt::format(
              "an image strip holds only outputs of 0 to 1, but node ({}, {}, {}) has ({:g}, "
              "{:g}, {:g}): write a .cube file, or cut the outputs (plenolab lut convert --clamp)",
              r, g, b, c.r, c.g, c.b));
        strip.at(b * lut.size + r, g) = cut_to_unit(c);
      }
  return strip;
}

}  // namespace plenolab
