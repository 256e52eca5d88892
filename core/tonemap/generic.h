#pragma once

#include "core/tonemap/statistics.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Generic tone mapping operator (Mantiuk & Seidel 2008, equations 2 and 4): a sigmoid with four numbers that
/// can take the shape of most global operators, and gains of three bands of spatial frequency. Its seven
/// parameters are what plenolab optimises.
///
/// Input: scene-referred, any unit. With x = log10(L/L̄), a_l = (c·d_l − 1)/d_l and a_h alike:
///   luma = 0                                  for x ≤ b − d_l
///        = ½c(x − b)/(1 − a_l(x − b)) + ½     up to b
///        = ½c(x − b)/(1 + a_h(x − b)) + ½     up to b + d_h
///        = 1                                  beyond,
/// then the gains (modulate_bands), cut to [0, 1], then the colour ratio. The paper takes x absolute;
/// relative to the log average L̄ the range of b reaches every image.
struct GenericOptions {
  double brightness = 0;                    ///< b, log10 units: x that becomes luma ½; [−2, 2]
  double low_range = 1.5;                   ///< d_l, log10 units shown below b; [0.001, 2.5]
  double high_range = 1.5;                  ///< d_h, above b; [0.001, 2.5]
  double contrast = 0.5;                    ///< c, slope at b is c/2 luma per log10 unit; [0.2, 1.5]
  double fine = 0, middle = 0, coarse = 0;  ///< m₁, m₂, m₃: log2 gains of ¼, 1/16 and 1/64 cycles/px; [−2, 2]
  double colour_exponent = 0.7;             ///< [0, 1]
  /// Bands are those of the image averaged down by this, [1, 64]: centres of ¼, 1/16, 1/64 over it. For
  /// parameters that were found on a smaller image.
  double band_scale = 1;
  void validate() const;
};

struct GenericParameters {
  GenericOptions options;
  double log_average = 0;  ///< log10 L̄
};

/// Luma in [0, 1] of x = log10(L/L̄); rises with x. The definition, not clipped by gains.
double generic_curve(const GenericOptions& options, double x);

/// Log2 gain of a spatial frequency (cycles/px, ≥ 0): Σ mᵢ·Bᵢ with Bᵢ = ½(1 + cos(π·log2(f/fᵢ)/2)) within two
/// octaves of fᵢ, 0 elsewhere (fᵢ over band_scale); B of the finest band stays 1 above its centre. 0 at f =
/// 0.
double band_log2_gain(const GenericOptions& options, double cycles_per_px);

/// Multiplies frequencies of the plane (mirrored at its borders) by 2^band_log2_gain. Gains of 0 leave it as
/// it is, without transforming it.
void modulate_bands(const GenericOptions& options, Plane<float>& luma);

GenericParameters fit(const GenericOptions& options, const ImageStatistics& statistics);
ToneMapped apply(const GenericParameters& parameters, const SceneImage& view, int threads = 0);

}  // namespace plenolab
