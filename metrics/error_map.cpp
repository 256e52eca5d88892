#include "metrics/error_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"

namespace plenolab {
namespace {

/// Coefficients c0 … c6 of the fit to inferno by M. Zucker (public domain, "matplotlib colormaps", 2019).
constexpr std::array<Rgb, 7> kInferno{{{0.00021894037f, 0.0016510046f, -0.019480899f},
                                       {0.10651341949f, 0.5639564368f, 3.9327123889f},
                                       {11.6024930825f, -3.9728539657f, -15.9423941063f},
                                       {-41.7039961311f, 17.4363988825f, 44.3541451987f},
                                       {77.1629356994f, -33.4023589421f, -81.8073092579f},
                                       {-71.3194282450f, 32.6260642640f, 73.2095198580f},
                                       {25.1311262248f, -12.2426689524f, -23.0703249990f}}};

float clamp_unit(float v) {
  return std::clamp(v, 0.0f, 1.0f);
}

float largest_difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

}  // namespace

Rgb inferno(float value) {
  const float t = clamp_unit(value);
  Rgb sum = kInferno.back();
  for (std::size_t i = kInferno.size() - 1; i-- > 0;) sum = sum * t + kInferno[i];
  return {clamp_unit(sum.r), clamp_unit(sum.g), clamp_unit(sum.b)};
}

void ErrorMapOptions::validate() const {
  if (!(full_scale > 0 && full_scale <= 1)) {
    throw InputError(fmt::format("full_scale of an error map is {} but must lie in (0, 1]", full_scale));
  }
}

DisplayImage error_map(const DisplayImage& test, const DisplayImage& reference,
                       const ComparisonConditions& conditions, const ErrorMapOptions& options) {
  options.validate();
  check_comparable(test, reference, conditions);
  DisplayImage map(test.width(), test.height(), options.invalid);
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (!is_valid(conditions.valid, i)) continue;
    map.pixels()[i] =
        inferno(largest_difference(test.pixels()[i], reference.pixels()[i]) / options.full_scale);
  }
  return map;
}

DisplayImage error_map(const SceneImage& test, const SceneImage& reference,
                       const ComparisonConditions& conditions, const ErrorMapOptions& options) {
  check_comparable(test, reference, conditions);
  return error_map(expose(test, conditions.exposure), expose(reference, conditions.exposure), conditions,
                   options);
}

}  // namespace plenolab
