#pragma once

#include "core/tonemap/statistics.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// A photoreceptor operator for light fields that few pixels cannot steer; not in the thesis. It keeps the
/// curve of Reinhard & Devlin 2005 and replaces everything that one pixel decides:
///  - radiance is taken relative to the robust log average, so that the unit does not matter;
///  - k = (log p99 − log average)/(log p99 − log p1) instead of the extremes (0.5 for a zero range);
///  - the output is not normalised by the extremes of its luma: with V(p1) and V(p99) known from the curve,
///  luma
///    goes through straight lines (0, 0), (V(p1), toe), (V(p99), 1 − shoulder), (1, 1). Nothing is clipped,
///    and the gain between the percentiles never exceeds max_gain (the knots move apart around their centre
///    instead), so that a flat view does not become noise.
/// Fitted to statistics of key views blended bilinearly and adapted in time (adaptation.h), it follows
/// changes of light that fill more than a percent of the view, with the time constant of the eye.
///
/// Input: scene-referred, any unit. Output: display values in [0, 1]. Every channel by the same curve of C
/// and I_a; V(p) is the response to grey of luminance p.
struct RobustAdaptiveOptions {
  double brightness = 0;         ///< b in [−8, 8]
  double colour_adaptation = 0;  ///< c in [0, 1]
  double light_adaptation = 1;   ///< l in [0, 1]; global levels are those of grey at the log average
  double toe = 0.03;             ///< luma of the first percentile, [0, 0.4]
  double shoulder = 0.08;        ///< luma kept for what is above the 99th, [0, 0.4]
  double max_gain = 4;           ///< [1, 100]
  void validate() const;
};

struct RobustAdaptiveParameters {
  double scale = 1;  ///< 1 / average, in 1 / unit
  double contrast = 0.5, factor = 1;
  double colour_adaptation = 0, light_adaptation = 1;
  double knot_low = 0, luma_low = 0;    ///< V and luma of the lower knot
  double knot_high = 1, luma_high = 1;  ///< V and luma of the upper knot
};

RobustAdaptiveParameters fit(const RobustAdaptiveOptions& options, const ImageStatistics& statistics);
ToneMapped apply(const RobustAdaptiveParameters& parameters, const SceneImage& view, int threads = 0);

}  // namespace plenolab
