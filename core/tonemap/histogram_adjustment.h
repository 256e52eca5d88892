#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// How high a bin may be (Ward Larson, Rushmeier & Piatko 1997; thesis, section 5.1.4).
enum class HistogramCeiling {
  kPerceptual,  ///< the linear ceiling times ΔL_t(L_d)·L_w / (ΔL_t(L_w)·L_d): needs cd/m²
  kLinear,      ///< t = T·Δb / (log L_dmax − log L_dmin): no contrast larger than in the scene
  kAsPrinted,  ///< perceptual with the thesis' ratio, t = T·log c / ((log L_max − log L_min)·N): the inverse
               ///< of the right one, which trims far too much
  kLinearAsPrinted,  ///< the same without the perceptual factor
};

/// Histogram adjustment.
///
/// Input: scene-referred in cd/m²; relative radiance is multiplied with `cd_m2_per_unit`. Output: display
/// values in [0, 1]: luma = ((L_d − L_dmin)/(L_dmax − L_dmin))^(1/2.2), then apply_colour_ratio. Slips of the
/// thesis corrected: the inverse ratio of the ceiling (kept as kAsPrinted), and the missing logs in log L_d =
/// log L_dmin + (log L_dmax − log L_dmin)·p(b).
struct HistogramOptions {
  HistogramCeiling ceiling = HistogramCeiling::kPerceptual;
  int bins = 4096;           ///< 2 … 65536
  double tolerance = 0.025;  ///< trimming ends when a pass trims at most this share of the initial total
  std::optional<int> fixed_passes;  ///< exactly so many passes instead (thesis: 4 for Cellar); 0 … 1000
  double display_max_cd_m2 = 300, display_min_cd_m2 = 0.3;
  double colour_exponent = kColourExponent;  ///< [0, 1]
  double cd_m2_per_unit = 1;                 ///< (0, 1e12]
  void validate() const;
};

/// Pixels by log10 luminance: bin b covers [log_min + b·Δ, log_min + (b+1)·Δ), Δ = (log_max − log_min)/bins,
/// the last bin includes log_max. Luminance 0 counts as the log floor.
struct LogHistogram {
  double log_min = 0, log_max = 0;
  std::vector<double> counts;
  friend bool operator==(const LogHistogram&, const LogHistogram&) = default;
};

/// Histogram of a view between log10 luminances (those of the view, or of several); values outside count in
/// the end bins. `floor` > 0 in the unit of the view (see log_floor).
LogHistogram measure_histogram(const SceneImage& view, double floor, double log_min, double log_max, int bins,
                               int threads = 0);
/// Sum of histograms with equal range and bins.
LogHistogram merge(const LogHistogram& a, const LogHistogram& b);

/// Smallest visible difference ΔL_t in cd/m² at adaptation luminance L in cd/m² (Ferwerda et al. 1996, as
/// Ward Larson et al. and Radiance use it); piecewise, continuous within 3 %.
double just_noticeable_difference_cd_m2(double luminance_cd_m2);

/// One pass of trimming.
struct TrimmingPass {
  double total = 0;    ///< T before the pass
  double trimmed = 0;  ///< removed by it
  int bins = 0;        ///< how many bins were cut
};

/// The curve, and how it came about.
struct HistogramParameters {
  bool linear = false;         ///< whether the mapping is L_d = L·L_dmax/L_max instead of the histogram's
  std::string linear_because;  ///< one sentence if so
  double floor = 1;            ///< of the light field, unit of the view
  double log_min = 0, log_max = 0;  ///< of the histogram, log10 of the unit of the view
  std::vector<double> cumulative;   ///< p at the bins + 1 bin edges, 0 … 1, never falling; empty if linear
  std::vector<TrimmingPass> passes;
  double log_display_min = 0, log_display_max = 0;  ///< log10 cd/m²
  double colour_exponent = kColourExponent;
};

/// Whether log10 luminances between these fit the display, so that nothing is to be done: the counts of a
/// histogram over this range are then not looked at.
bool fits_display(const HistogramOptions& options, double log_min, double log_max);

/// Trims the histogram and sums it up. Nothing is to be done if the range fits the display, and too little is
/// left if the total falls below the tolerance: then the mapping is linear with the largest luminance at
/// L_dmax, which is what the curve tends to as the range shrinks to that of the display (so neighbouring
/// views on both sides of the limit look alike), and the identity in cd/m² if L_max = L_dmax.
HistogramParameters fit(const HistogramOptions& options, const LogHistogram& histogram, double floor);

/// log10 L_d in cd/m² of log10 L in the unit of the view; log L outside the histogram counts as its end.
double display_log_luminance(const HistogramParameters& parameters, double log_luminance);

ToneMapped apply(const HistogramParameters& parameters, const SceneImage& view, int threads = 0);

}  // namespace plenolab
