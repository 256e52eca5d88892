#pragma once

#include "core/lightfield/light_field.h"
#include "core/synthesis/options.h"

namespace plenolab::testing_support {

/// What the naive synthesis says about one pixel.
struct NaivePixel {
  double r = 0, g = 0, b = 0;
  int visible = 0;
  bool unseen = false, restored = false;
  /// Smallest distance of any decision taken for this pixel from its threshold; decisions nearer than
  /// rounding may go either way in another implementation.
  double margin = 1e300;
};

/// A deliberately plain synthesis in double precision, written from the description of the method alone, as a
/// judge of the product's. Scene-referred, slow.
Plane<NaivePixel> naive_synthesis(const LightField& field, CameraPosition position,
                                  const SynthesisOptions& options);

}  // namespace plenolab::testing_support
