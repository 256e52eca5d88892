#include "core/lut/curves.h"

#include <algorithm>

#include "core/lut/lattice.h"

namespace plenolab {

namespace {

float between(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

Rgb LutCurves::operator()(Rgb colour) const {
  const auto last = static_cast<float>(nodes.size() - 1);
  const auto along = [&](float value, float low, float high, float Rgb::*channel) {
    const AxisPosition at = position_on(value, low, last / (high - low), last);
    const auto first = static_cast<std::size_t>(at.node), second = std::min(first + 1, nodes.size() - 1);
    return between(nodes[first].*channel, nodes[second].*channel, at.fraction);
  };
  return {along(colour.r, domain_min.r, domain_max.r, &Rgb::r),
          along(colour.g, domain_min.g, domain_max.g, &Rgb::g),
          along(colour.b, domain_min.b, domain_max.b, &Rgb::b)};
}

Lut lut_of_curves(const LutCurves& curves, const Lut* behind, int size) {
  if (size == 0)
    size = behind ? std::max(kCurveLatticeSize, behind->size)
                  : static_cast<int>(std::min<std::size_t>(kCurveLatticeSize, curves.nodes.size()));
  const auto both = [&](Rgb c) {
    return behind ? sample_lut(*behind, curves(c), LutInterpolation::kTetrahedral) : curves(c);
  };
  return bake_lut(size, both, curves.domain_min, curves.domain_max);
}

}  // namespace plenolab
