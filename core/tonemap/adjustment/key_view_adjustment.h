#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/base/progress.h"
#include "core/image/image.h"
#include "core/image/repair.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// Key-view adjustment (thesis of Altmeier, section 5.3): draws the luma of corresponding pixels of tone
/// mapped key views together, so that views synthesised from them show no borders, and leaves differences
/// that are in the HDR views too (material, media) and those over large distances on the camera plane.
struct KeyViewAdjustmentOptions {
  double sigma_views = 2;  ///< σ_s: of the distance between key views, in key views, in [1e-3, 1e3]
  /// Key views farther apart take nothing from each other, ≥ 0 (0: no others). At 3 σ_s, the default, results
  /// differ by less than 0.001 from those with all views on 17 × 5 views mapped with random gains; at 2 σ_s
  /// by 0.01.
  double support_views = 6;
  double sigma_d_px = 0.5;           ///< σ_d: of the difference in disparity, pixels, in [1e-6, 1e6]
  double sigma_log_luminance = 0.1;  ///< σ_l: of the difference in HDR luminance, log10 units, in [1e-6, 1e6]
  /// The second filter, which smooths the factors inside a view (σ' of the section).
  double smoothing_share = 0.02;      ///< its σ_s, share of the larger side of the view, in [1e-6, 10]
  double smoothing_sigma_d_px = 0.5;  ///< two-sided disparity weight, pixels, in [1e-6, 1e6]
  double smoothing_sigma_log_luminance = 0.1;  ///< HDR luminance, log10 units, in [1e-6, 1e6]

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// What was done, added up over all views.
struct KeyViewAdjustmentCounts {
  std::int64_t pixels = 0;
  std::int64_t correspondences = 0;  ///< pixels of other views that lie inside their image
  std::int64_t kept_dark = 0;        ///< pixels with luma below 1/1024: factor 1 before smoothing
  std::int64_t clipped_high = 0;     ///< channel values above 1 after the factor, set to 1
  std::int64_t floored_pixels = 0;   ///< HDR pixels of luminance 0: the smallest positive one was used
  PixelRepairs hdr_repairs;          ///< HDR channel values that were NaN, infinite or negative
  std::int64_t display_repairs = 0;  ///< tone mapped channel values outside [0, 1], brought there (NaN to 0)
  friend bool operator==(const KeyViewAdjustmentCounts&, const KeyViewAdjustmentCounts&) = default;
};

/// How to run; does not change any result.
struct KeyViewAdjustmentRun {
  int threads = 0;                                        ///< 0 = all cores
  std::size_t memory_bound_bytes = std::size_t{1} << 30;  ///< of the views in work; each view is read once
                                                          ///< for every batch of views that fit
  Progress progress;
};

/// Receives the adjusted views, each once, row by row in order of (row, column).
using AdjustedViewSink = std::function<void(int column, int row, const DisplayImage& view)>;

/// Adjusts all views; all reads are from the originals. For pixel p of view F_p and every view within
/// support, its own included: q = p + (F_p − F_q)·disp(p) (vertically times the grid's vertical ratio),
/// nearest pixel, if inside; weight G_σs(|F_p − F_q|) · G_σd(disp(p) − disp(q)) · G_σl(log L_p − log L_q).
/// The weighted mean of the tone mapped luma over its own luma is the pixel's factor (1 where the luma is
/// below 1/1024); a cross bilateral filter within the view (distance, two-sided disparity, HDR log luminance)
/// smooths the factors, and r, g and b are multiplied by them. Luma is the luminance-weighted sum of the
/// encoded channels, disparity that of the HDR light field. Time: about (views within support) × pixels.
/// Throws InputError if the light fields differ in their grids or cannot be read.
KeyViewAdjustmentCounts adjust_key_views(const LightField& hdr, const DisplayLightField& tone_mapped,
                                         const KeyViewAdjustmentOptions& options,
                                         const AdjustedViewSink& sink, const KeyViewAdjustmentRun& run = {});

/// The factor image of one view before smoothing, by the definition alone: view by view, pixel by pixel, in
/// double precision. The reference for adjust_key_views; slow.
Plane<float> literal_adjustment_factors(const LightField& hdr, const DisplayLightField& tone_mapped,
                                        const KeyViewAdjustmentOptions& options, int column, int row);

/// One adjusted view by the definition: literal factors, smoothed by bilateral_exact's method.
DisplayImage adjust_key_view_literally(const LightField& hdr, const DisplayLightField& tone_mapped,
                                       const KeyViewAdjustmentOptions& options, int column, int row);

}  // namespace plenolab
