#pragma once

#include "metrics/comparison.h"

/// Dynamic range independent metric (DRIM): where a test image loses contrast that is visible in the
/// reference, shows contrast that is invisible there, or shows it reversed. Aydin, Mantiuk, Myszkowski &
/// Seidel 2008, Dynamic range independent image quality assessment. The images may have any dynamic ranges;
/// both are luminance in cd/m². Contrast is that of the front end of HDR-VDP 1 (vision/perceived_contrast.h),
/// in bands and orientations of the cortex transform (vision/cortex.h).
namespace plenolab {

struct DrimOptions {
  int bands = 5;             ///< of the cortex transform, an octave each, [1, 12]
  int orientations = 6;      ///< [1, 24]
  double threshold_jnd = 1;  ///< contrast of a band that is seen with probability 1 − 1/e, (0, 100]
  /// How far visible and invisible contrast lie apart, log10 units, [0, 2]: contrast is visible with
  /// P(C·10^(−m/2)) and invisible with 1 − P(C·10^(m/2)), P(C) = 1 − exp(−|C/threshold|^3.5).
  double margin_log10 = 0.3;

  /// Throws InputError naming the first value out of range.
  void validate() const;
};

/// Probabilities in [0, 1] at each pixel, each 1 − Π(1 − P) over bands and orientations:
///   loss           P_reference,visible · P_test,invisible
///   amplification  P_reference,invisible · P_test,visible
///   reversal       P_reference,visible · P_test,visible where the contrasts have opposite signs
/// Invisibility is that of the largest contrast within a quarter of a period of the band's lowest frequency,
/// as contrast of a band is 0 somewhere next to every one of its peaks. There is no loss where that is not
/// below the reference's contrast, nor amplification where the reference's is not below the test's: contrast
/// near the threshold is half visible and half invisible, and equal images have no distortion at all.
struct DrimMaps {
  Plane<float> loss, amplification, reversal;
};

/// Luminance in cd/m², finite and ≥ 0, of equal size with at least one pixel. Takes 21 transforms of each
/// image for 5 bands and 6 orientations, and about 170 bytes a pixel: 350 MB for 1920×1080. Bit-identical for
/// any number of threads. Throws InputError for options out of range and for images of different or no size.
DrimMaps drim_maps(const Plane<float>& test_cd_m2, const Plane<float>& reference_cd_m2,
                   const ViewingConditions& viewing, const DrimOptions& options = {}, int threads = 0);

/// Maps of images under conditions: scene images are scaled by cd_m2_per_unit, display images shown on the
/// display of the viewing conditions. Pixels outside the mask get 0, and the average luminance of the others
/// stands in for them. Throws InputError for images that cannot be compared (comparison.h).
DrimMaps drim_maps(const SceneImage& test, const SceneImage& reference,
                   const ComparisonConditions& conditions, const DrimOptions& options = {});
DrimMaps drim_maps(const DisplayImage& test, const SceneImage& reference,
                   const ComparisonConditions& conditions, const DrimOptions& options = {});
DrimMaps drim_maps(const DisplayImage& test, const DisplayImage& reference,
                   const ComparisonConditions& conditions, const DrimOptions& options = {});

/// Over the valid pixels:
///   drim_share_any, drim_share_loss, drim_share_amplification, drim_share_reversal
///                                 share of pixels where any, or that probability is 0.5 or more
///   drim_mean_loss, drim_mean_amplification, drim_mean_reversal      mean probability in %
///   drim_mean_total                                                  their sum, up to 300 %
std::vector<Measurement> drim_measurements(const DrimMaps& maps, const Mask* valid = nullptr);

/// The measurements of the maps with default options.
std::vector<Measurement> drim(const SceneImage& test, const SceneImage& reference,
                              const ComparisonConditions& conditions);
std::vector<Measurement> drim(const DisplayImage& test, const SceneImage& reference,
                              const ComparisonConditions& conditions);
std::vector<Measurement> drim(const DisplayImage& test, const DisplayImage& reference,
                              const ComparisonConditions& conditions);

/// Picture of the maps over a grey version of `backdrop` (of their size): green loss, blue amplification, red
/// reversal; at each pixel the most probable kind, as strong as it is probable.
DisplayImage drim_false_colour(const DrimMaps& maps, const DisplayImage& backdrop);

}  // namespace plenolab
