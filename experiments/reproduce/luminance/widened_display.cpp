#include "experiments/reproduce/luminance/widened_display.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace plenolab {

WidenedDisplay::WidenedDisplay(const ProjectorDisplay& display, double factor)
    : display_(display), factor_(factor) {
  if (!(factor >= 1.0 / 3 && factor <= 100))
    throw InputError(
        fmt::format("a diffuser must be 1/3 to 100 times as wide as projectors are apart, not {:g}", factor));
}

double WidenedDisplay::weight(const Ray& ray, ObserverPosition observer) const {
  return diffuser_profile((observer.x_m - display_.position(ray).x_m) /
                          (factor_ * display_.spread_m(ray.image)));
}

}  // namespace plenolab
