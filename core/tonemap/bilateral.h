#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "core/image/image.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Bilateral operator (Durand & Dorsey 2002; thesis, sections 2.1.2, 5.1.2 and 5.1.3).
///
/// Input: scene-referred, any unit (automatic settings make the result independent of it, to 0.001 log10
/// units). Output: display values in [0, 1]. With I = log10 L and base = bilateral(I; σ_s, σ_l):
///   naive      log10 L_target = base·compression + (I − base) − brightness
///   enhanced   log10 L_target = base_m·compression + foreground·scale + (I − base_m) − brightness,
/// luma = L_target^(1/2.2), then apply_colour_ratio. Where compression is 1 and nothing of the foreground is
/// added, log10 L_target = I − brightness exactly. base_m takes nothing across depth edges; foreground =
/// base_m − temporary, where the temporary layer lets foreground pixels take from the background and not the
/// other way round: W'_d = G(max(disp(q) − disp(p), 0)). Slip of the thesis corrected: it prints p and q the
/// other way round, against its own text, which puts the half profile on the background.
struct BilateralToneOptions {
  bool enhanced = false;              ///< needs a disparity map
  bool exact = false;                 ///< the O(σ_s²) filter instead of the fast approximation
  double sigma_s_share = 0.02;        ///< σ_s as a share of the larger image side, (0, 1]
  double sigma_log10 = 0.4;           ///< σ_l, log10 units, (0, 100]
  double sigma_d_px = 0.5;            ///< σ_d, pixels of disparity, (0, 1e6]
  double contrast = 5;                ///< of all bases on the display, for automatic compression, [1.1, 1e6]
  std::optional<double> compression;  ///< (0, 1]; absent: min(1, log10 contrast / range of all bases
                                      ///< without outliers)
  std::optional<double> brightness;   ///< log10 units; absent: compression · upper end of that range
  std::optional<double> foreground_scale;  ///< [0, 4]; absent: 1 − compression, with which the foreground
                                           ///< equals the naive operator and the background keeps no profile
  /// Share of all base values left out at each end of the range that automatic compression and brightness
  /// rest on, [0, 0.2]. With 0, the extremes, a single nearly black pixel washes out a photograph.
  double outliers = 0.01;
  /// [0, 1]; absent: colour_exponent_of(compression).
  std::optional<double> colour_exponent;
  /// Whether stages that cannot change the result are left out: the depth weights and the foreground layer
  /// where all disparities are equal, the base layer where compression is 1. False computes them, to compare.
  bool prune = true;
  void validate() const;
};

/// Exponent of the colour ratio that keeps colours as saturated as they were seen before contrasts were
/// compressed: s/2.2 with s = (1 + k1)·c^k2/(1 + k1·c^k2), k1 = 1.48, k2 = 0.82 (Mantiuk, Mantiuk,
/// Tomaszewska & Heidrich 2009, who raise ratios of linear light to s, as pfstmo's operator does). At
/// compression 1 it is 1/2.2, which leaves linear ratios as they are; a fixed larger one would make dark
/// saturated colours, whose luma compression raises, glaring: their ratios reach 4.7 (red) and 13.9 (blue).
double colour_exponent_of(double compression);

/// The layers, log10 units of L, for display and for the result. `base` is the naive base or base_m;
/// `foreground` is empty for the naive operator and where no depth edge can change a weight.
struct BilateralLayers {
  Plane<float> log_luminance, base, foreground;
  /// I − base.
  Plane<float> detail() const;
};

/// Computes the layers of a view. `floor` > 0 stands for luminance 0 (log_floor of the light field).
/// `disparity` of the same size is required by the enhanced operator and unused by the naive one; InputError
/// otherwise. `foreground` false leaves the foreground layer empty: fits look at the base alone.
BilateralLayers bilateral_layers(const BilateralToneOptions& options, const SceneImage& view,
                                 const DisparityMap* disparity, double floor, int threads = 0,
                                 bool foreground = true);

/// A range of base values, log10 units.
struct BaseRange {
  double min = 0, max = 0;
  friend bool operator==(const BaseRange&, const BaseRange&) = default;
};

/// How often base values occur, in bins of 2^-10 log10 units; those of several views can be merged.
struct BaseHistogram {
  std::map<std::int32_t, std::int64_t> bins;  ///< count by floor(1024·value)
  BaseRange extremes{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};
/// Throws InputError for layers without pixels.
BaseHistogram measure_base(const BilateralLayers& layers);
BaseHistogram merge(BaseHistogram a, const BaseHistogram& b);
/// The range without a share `outliers` in [0, 0.2] of the values at each end, to 0.001 log10 units; exactly
/// the extremes for 0.
BaseRange range_of(const BaseHistogram& bases, double outliers);

struct BilateralToneParameters {
  BilateralToneOptions options;  ///< of the layers
  double floor = 1;
  double compression = 1, brightness = 0, foreground_scale = 0;
  double colour_exponent = 1 / 2.2;
};

/// Parameters for a whole light field: `bases` is the range over all of its views (range_of with
/// BilateralToneOptions::outliers), so that all views are mapped alike.
BilateralToneParameters fit(const BilateralToneOptions& options, const BaseRange& bases, double floor);

/// log10 L_target of layers.
Plane<float> target_log_luminance(const BilateralToneParameters& parameters, const BilateralLayers& layers);

ToneMapped apply(const BilateralToneParameters& parameters, const SceneImage& view,
                 const DisparityMap* disparity, int threads = 0);

}  // namespace plenolab
