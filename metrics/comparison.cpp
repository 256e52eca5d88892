#include "metrics/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {
namespace {

bool is_finite(Rgb c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

void check_finite(const Plane<Rgb>& image, const char* role, const Mask* valid) {
  std::size_t bad = 0;
  for (std::size_t i = 0; i < image.size(); ++i) bad += is_valid(valid, i) && !is_finite(image.pixels()[i]);
  if (bad > 0) {
    throw InputError(fmt::format(
        "the {} image has {} pixel{} with NaN or infinity; repair it or mask these pixels before comparing",
        role, bad, bad == 1 ? "" : "s"));
  }
}

void check_mask(const Plane<Rgb>& image, const Mask& mask) {
  if (mask.width() != image.width() || mask.height() != image.height()) {
    throw InputError(
        fmt::format("the mask has {}×{} pixels but the images have {}×{}; give a mask of their size",
                    mask.width(), mask.height(), image.width(), image.height()));
  }
  const auto is_set = [](unsigned char v) { return v != 0; };
  if (std::none_of(mask.pixels().begin(), mask.pixels().end(), is_set)) {
    throw InputError("the mask leaves no pixel to compare");
  }
}

void check_planes(const Plane<Rgb>& test, const Plane<Rgb>& reference,
                  const ComparisonConditions& conditions) {
  conditions.validate();
  if (test.width() != reference.width() || test.height() != reference.height()) {
    throw InputError(fmt::format(
        "the test image has {}×{} pixels but the reference has {}×{}; images must be of equal size",
        test.width(), test.height(), reference.width(), reference.height()));
  }
  if (test.empty()) throw InputError("the images to compare have no pixels");
  if (conditions.valid != nullptr) check_mask(reference, *conditions.valid);
  check_finite(test, "test", conditions.valid);
  check_finite(reference, "reference", conditions.valid);
}

}  // namespace

Mask mask_of_finite(const Plane<Rgb>& image) {
  Mask mask(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) mask.pixels()[i] = is_finite(image.pixels()[i]) ? 1 : 0;
  return mask;
}

void ComparisonConditions::validate() const {
  if (!(exposure > 0) || !std::isfinite(exposure)) {
    throw InputError(fmt::format("exposure is {} but must be a positive number", exposure));
  }
  if (!(cd_m2_per_unit > 0) || !std::isfinite(cd_m2_per_unit)) {
    throw InputError(fmt::format("cd_m2_per_unit is {} but must be a positive number", cd_m2_per_unit));
  }
  if (!(difference_threshold >= 0 && difference_threshold <= 1)) {
    throw InputError(fmt::format("difference_threshold is {} but must lie in [0, 1]", difference_threshold));
  }
  viewing.validate();
}

void check_comparable(const SceneImage& test, const SceneImage& reference,
                      const ComparisonConditions& conditions) {
  check_planes(test, reference, conditions);
}

void check_comparable(const DisplayImage& test, const DisplayImage& reference,
                      const ComparisonConditions& conditions) {
  check_planes(test, reference, conditions);
}

void check_comparable(const DisplayImage& test, const SceneImage& reference,
                      const ComparisonConditions& conditions) {
  check_planes(test, reference, conditions);
}

}  // namespace plenolab
