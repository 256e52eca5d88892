#pragma once

#include <array>
#include <span>

#include "core/image/image.h"

namespace plenolab {

/// The response curve of Reinhard & Devlin 2005, shared by the operators that use it:
///   V[i] = C[i] / (C[i] + (factor·I_a[i])^contrast), 0 where C[i] = 0, of C = exposure·input,
///   I_a[i] = l·(c·C[i] + (1 − c)·L) + (1 − l)·global[i].
struct Photoreceptor {
  double exposure = 1;             ///< > 0
  double contrast = 0.5;           ///< m in [0, 4]
  double factor = 1;               ///< e^(−b)
  double colour_adaptation = 0;    ///< c in [0, 1]
  double light_adaptation = 1;     ///< l in [0, 1]
  std::array<double, 3> global{};  ///< I_global, unit of C
};

/// Smallest and largest luma of responses.
struct LumaRange {
  float min = 2, max = -1;  ///< of no pixels: empty
};

/// Responses in [0, 1] of scene values that are finite and ≥ 0; returns the range of their luma.
LumaRange respond_row(const Photoreceptor& receptor, std::span<const Rgb> scene, std::span<Rgb> out);

/// Response to grey of input luminance L, with the global level of the first channel.
double respond_to_grey(const Photoreceptor& receptor, double luminance);

/// m = 0.3 + 0.7·k^1.4, k = (log_max − log_average)/(log_max − log_min) cut to [0, 1], 0.5 for a zero range.
double contrast_of(double log_min, double log_average, double log_max);

/// Throw InputError unless b is in [−8, 8], and c and l in [0, 1].
void validate_photoreceptor(double brightness, double colour_adaptation, double light_adaptation);

}  // namespace plenolab
