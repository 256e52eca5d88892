#pragma once

#include <span>

#include "core/image/image.h"

namespace plenolab {

/// Vectorised elementary functions over rows. They take the same steps for every instruction set, so results
/// are bit-identical on all processors. Input and output may be the same memory. Errors are bounds that the
/// tests hold against double precision.

/// log10(x) of x > 0, normal and denormal floats; absolute error ≤ 2e-7 + 1.5e-7·|log10 x|.
void log10_row(std::span<const float> x, std::span<float> out);

/// 10^x; relative error ≤ 2e-7 + 4e-7·|x|. Results beyond the largest float become the largest float, below
/// 2^-125 0.
void exp10_row(std::span<const float> x, std::span<float> out);

/// x^p for x ≥ 0, 0 ≤ p ≤ 4: relative error ≤ 3e-7·(1 + |p·log2 x|). 0^p is 0 for p > 0 and 1 for p = 0; 1^p
/// is exactly 1. Range as exp10_row.
void power_row(std::span<const float> x, float p, std::span<float> out);

/// luminance(c) of each pixel.
void luminance_row(std::span<const Rgb> c, std::span<float> out);

/// The channels apart.
void split_row(std::span<const Rgb> c, std::span<float> r, std::span<float> g, std::span<float> b);

/// Whether every channel value is finite and ≥ 0.
bool all_usable(std::span<const Rgb> c);

}  // namespace plenolab
