#pragma once

#include "core/lightfield/light_field.h"

namespace plenolab {

/// The middle of every view, `divisor` ≥ 1 times narrower and lower (at least one pixel): the same cameras
/// with smaller opening angles, so that disparities stay. Views are loaded as they are asked for.
LightField central_part(const LightField& field, int divisor);

}  // namespace plenolab
