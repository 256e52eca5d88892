#pragma once

#include <span>

namespace plenolab {

/// v^2.2 for v ≥ 0 in place, with vector instructions, the same bits on every processor; relative error below
/// 1e-6 where the result is a normal float. Results that rounding would carry past the largest float are that
/// float. Input must be finite, not negative.
void decode_gamma(std::span<float> values);

}  // namespace plenolab
