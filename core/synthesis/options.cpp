#include "core/synthesis/options.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace plenolab {
namespace {

void require(bool ok, const char* name, double value, const char* range) {
  if (!ok) throw InputError(fmt::format("the synthesis option {} is {}, it must be {}", name, value, range));
}

}  // namespace

void SynthesisOptions::validate() const {
  require(step_px >= 0.25 && step_px <= 4, "step_px", step_px, "between 0.25 and 4");
  require(disocclusion_px > 0 && std::isfinite(disocclusion_px), "disocclusion_px", disocclusion_px,
          "positive and finite");
  require(occlusion_margin_px >= 0 && std::isfinite(occlusion_margin_px), "occlusion_margin_px",
          occlusion_margin_px, "0 or more and finite");
  require(border_fraction > 0 && border_fraction <= 0.5, "border_fraction", border_fraction,
          "above 0 and at most 0.5");
  require(border_delta >= 0 && border_delta <= 1, "border_delta", border_delta, "between 0 and 1");
  require(key_views == 1 || key_views == 2 || key_views == 4, "key_views", key_views, "1, 2 or 4");
  if (camera == CameraKind::kFixedScreen)
    require(screen_depth_m > 0, "screen_depth_m", screen_depth_m, "positive for the fixed-screen camera");
  resolve_threads(threads);
}

}  // namespace plenolab
