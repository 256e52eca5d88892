#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Content adaptive operator for rendered scenes, after Khaldieh, Ploumis, Pourazad, Nasiopoulos & Leung 2018
/// (Tone mapping for video gaming applications), as Zhao 2019 uses it: luminance is binned evenly in PQ
/// (steps of which are about equally visible), and a photographic curve gives up slope in bins that hold few
/// pixels for slope in bins that hold many.
///
/// The source leaves the bound on the slopes of low bins open; here it follows the response of the retina
/// R(L) = L^0.73/(L^0.73 + σ^0.73), σ the log average: a low bin keeps at most kappa times the part of the
/// curve's whole rise that R has of its own, and never more than the photographic curve gives it. Slopes are
/// of luma, (L_s/(1 + L_s))^(1/2.2) with L_s = key·L/σ: what equal steps add to the image is equally visible.
///
/// Luminance has to be in cd/m²: PQ and with it the bins depend on it.
struct ContentAdaptiveOptions {
  double key = 0.18;                 ///< of the photographic curve, (0, 4]
  double kappa = 0.25;               ///< bound on the slopes of low bins, [0, 1]
  std::optional<double> slope_cap;   ///< most that a heavy bin's slope may rise to, × photographic, ≥ 1
  double colour_exponent = 1 / 2.2;  ///< [0, 1]
  double cd_m2_per_unit = 1;         ///< luminance of radiance 1, > 0

  /// Throws InputError with one sentence that names the value out of range.
  void validate() const;
};

/// Population of even bins of the PQ signal over [0, signal_max], of one view or, merged, of several.
struct PqHistogram {
  static constexpr int kBins = 1024;
  double signal_max = 1;
  std::vector<std::int64_t> counts;  ///< kBins
  double log10_sum = 0;              ///< of positive luminances, cd/m²
  std::int64_t positive = 0;

  double log_average() const { return positive > 0 ? log10_sum / static_cast<double>(positive) : 0; }
};

/// Of luminances in cd/m², finite and ≥ 0. Bins reach up to max(1, signal of `largest_cd_m2`), which takes
/// what lies above; signals above 1.95 (1e13 cd/m²) count as that. Bit-identical for any number of threads.
PqHistogram measure_pq_histogram(const Plane<float>& luminance_cd_m2, double largest_cd_m2, int threads = 0);

/// Of both together; they must have the same signal_max.
PqHistogram merge(const PqHistogram& a, const PqHistogram& b);

/// How bins were split by the method of maximum entropy (Kapur, Sahoo & Wong 1985): populations in rising
/// order are cut in two where the entropies of both parts add up to most; heavy bins have more than the
/// largest population of the first part.
struct BinSplit {
  std::vector<bool> heavy;
  int heavy_count = 0;
};
BinSplit split_by_entropy(const std::vector<std::int64_t>& counts);

/// A monotone curve from PQ signals to luma.
struct ContentAdaptiveCurve {
  double signal_max = 1;
  std::vector<float> luma;  ///< at the kBins + 1 ends of the bins, rising
  int heavy_bins = 0, capped_bins = 0;
  double largest_rise = 1;  ///< of a bin's slope, × photographic
  std::string plain;        ///< why the curve is the photographic one; empty if it is adapted

  float at(double luminance_cd_m2) const;
};
ContentAdaptiveCurve fit_curve(const ContentAdaptiveOptions& options, const PqHistogram& histogram);

/// Luma of luminances in cd/m², e.g. for virtual photographs.
Plane<float> apply_curve(const ContentAdaptiveCurve& curve, const Plane<float>& luminance_cd_m2);

struct ContentAdaptiveParameters {
  ContentAdaptiveCurve curve;
  double colour_exponent = 1 / 2.2;
  double cd_m2_per_unit = 1;
};
ContentAdaptiveParameters fit(const ContentAdaptiveOptions& options, const PqHistogram& histogram);
ToneMapped apply(const ContentAdaptiveParameters& parameters, const SceneImage& view, int threads = 0);

}  // namespace plenolab
