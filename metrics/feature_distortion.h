#pragma once

#include <functional>
#include <string>
#include <vector>

#include "metrics/comparison.h"

/// Feature-based metric for tone mapped images after Gao, Brooks & Arnold 2017 (A feature-based quality
/// metric for tone mapped images), as Zhao 2019 (section 2.4.1 and chapter 3) describes it. The original is
/// not public; what it leaves open is chosen here and is an option where that makes sense.
///
/// Virtual photographs at several exposures show what the HDR scene holds; brightness, saliency and detail
/// in dark and bright areas of the photographs, merged, are compared with those of the tone mapped image.
namespace plenolab {

/// One virtual photograph: luma in [0, 1] of luminance that lies within the window of an exposure,
/// [centre/2^half_window_ev, centre·2^half_window_ev]. Luma of valid pixels must not depend on the others.
using Photograph =
    std::function<Plane<float>(const Plane<float>& windowed_luminance, double centre, const Mask* valid)>;

/// Gao's version: the photographic operator of Reinhard et al. 2002 with the centre in place of the scaled
/// log average: s = L/centre, luma = (s/(1 + s))^(1/2.2).
Plane<float> photographic_photograph(const Plane<float>& windowed_luminance, double centre,
                                     const Mask* valid = nullptr);

/// Zhao's version: the content adaptive operator (core/tonemap/content_adaptive.h, default options) fitted to
/// the valid pixels in the window. Luminance has to be in cd/m².
Plane<float> content_adaptive_photograph(const Plane<float>& windowed_luminance, double centre,
                                         const Mask* valid = nullptr);

struct FeatureOptions {
  double step_ev = 2;         ///< between exposure centres, (0, 16]
  double half_window_ev = 3;  ///< a photograph shows centre·2^±this, (0, 16]
  double brightness_weight = 1, saliency_weight = 1, detail_weight = 1;  ///< ≥ 0, not all 0
  Photograph photograph = photographic_photograph;

  /// Throws InputError naming the first value out of range.
  void validate() const;
};

/// What the scene shows, merged from its photographs; made once for all tone mapped images of a scene.
struct FeatureReference {
  std::vector<double> centres;   ///< of the exposures, in the unit of luminance, rising
  double brightness = 0;         ///< mean luma over photographs and pixels
  Plane<float> saliency;         ///< distribution over pixels, sums to 1
  Plane<float> gradient_energy;  ///< largest of the photographs at each pixel
  Mask dark, bright;             ///< pixels of the darkest and of the brightest quarter
};

/// `luminance` in any unit, finite and ≥ 0, of at least one pixel. Pixels outside the mask take no part.
/// Exposure centres lie step_ev apart about the middle of the 1st and 99th percentile of positive luminance,
/// as many as cover them.
FeatureReference feature_reference(const Plane<float>& luminance, const FeatureOptions& options,
                                   const Mask* valid = nullptr, int threads = 0);

/// Distortions in [0, 1]; lower is better.
struct FeatureDistortion {
  double brightness = 0;  ///< |difference of mean luma|
  double saliency = 0;    ///< 1 − exp(−KL divergence of the test's saliency from the reference's)
  double detail = 0;      ///< 1 − retained gradient energy, mean of the dark and the bright quarter
  double total = 0;       ///< mean by the weights of the options
};

/// Compares a tone mapped image of the reference's size.
FeatureDistortion feature_distortion(const DisplayImage& test, const FeatureReference& reference,
                                     const FeatureOptions& options, const Mask* valid = nullptr);

/// Saliency of a picture: differences of Gaussians (centres 1, 2, 4 and 8 px, surrounds four times as wide),
/// in magnitude, each scaled to a largest value of 1, added up and scaled to the sum 1 over the valid pixels
/// (after Itti, Koch & Niebur 1998, luma only). An even picture is equally salient everywhere.
Plane<float> saliency_of(const Plane<float>& luma, const Mask* valid = nullptr);

/// feature_photographic, _brightness, _saliency and _detail: distortions with Gao's photographs and default
/// options, unit "1". The scale of the reference does not matter.
/// feature_content_adaptive, _brightness … : the same with Zhao's photographs, of a reference in cd/m² after
/// scaling by cd_m2_per_unit.
std::vector<Measurement> feature_photographic(const DisplayImage& test, const SceneImage& reference,
                                              const ComparisonConditions& conditions);
std::vector<Measurement> feature_content_adaptive(const DisplayImage& test, const SceneImage& reference,
                                                  const ComparisonConditions& conditions);

}  // namespace plenolab
