#pragma once

#include "core/tonemap/photoreceptor.h"
#include "core/tonemap/statistics.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// A photoreceptor operator for light fields that few pixels cannot steer; not in the thesis. It keeps the
/// curve of Reinhard & Devlin 2005 and replaces everything that one pixel decides:
///  - radiance is taken relative to the robust log average, so that the unit does not matter;
///  - k = (log p99 − log average)/(log p99 − log p1) instead of the extremes (0.5 for a zero range);
///  - the output is not normalised by the extremes of its luma: with V(p1) and V(p99) known from the curve,
///    luma goes through the straight lines (0, 0), (V(p1), low), (V(p99), high), (1, 1), with low = toe and
///    high = 1 − shoulder; ratios of the channels to luma are raised to the colour exponent. Nothing is
///    clipped: colours too bright to show are drawn towards grey. Between the percentiles luma rises by at
///    most `max_slope` per log10 unit on average (low and high move together around their centre instead), so
///    that a flat view does not become noise;
///  - m is at most 0.9: at 1 the curve would no longer tell luminances apart;
///  - light sources too small for percentiles are not forgotten: where the light at the eye (eye_average,
///  which
///    leaves out glints and noise) exceeds the log average by more than a decade, everything up to the 99th
///    percentile is shown darker by `glare` log10 units for each further decade, as behind a pupil that
///    closes; what is brighter stays.
/// Frames take percentiles from the key views, blended bilinearly, and the light at the eye from the frame
/// itself, both adapted in time (adaptation.h): the operator follows light that fills more than a percent of
/// the view as the camera moves, and the sun when it appears, with the time constant of the eye.
///
/// Input: scene-referred, any unit. Output: display values in [0, 1]. V(p) is the response to grey of
/// luminance p.
struct RobustAdaptiveOptions {
  double brightness = 0;         ///< b in [−8, 8]
  double colour_adaptation = 0;  ///< c in [0, 1]
  double light_adaptation = 1;   ///< l in [0, 1]; global levels are those of grey at the log average
  double toe = 0.03;             ///< luma of the first percentile, [0, 0.4]
  double shoulder = 0.08;        ///< luma kept for what is above the 99th, [0, 0.4]
  double max_slope = 1;          ///< luma per log10 unit of luminance, [0.05, 10]
  /// Of channels over luma: 1 keeps the ratios that the curve gives, which as code values are saturated in
  /// shadows; 0 makes grey; [0, 1].
  double colour_exponent = 1 / 2.2;
  double glare = 0.05;  ///< log10 units of display luminance per decade of light at the eye, [0, 0.5]
  void validate() const;
};

struct RobustAdaptiveParameters {
  Photoreceptor receptor;               ///< its exposure is 1 / average
  double knot_low = 0, luma_low = 0;    ///< V and luma of the lower knot
  double knot_high = 1, luma_high = 1;  ///< V and luma of the upper knot
  double colour_exponent = 1 / 2.2;
  double dimming = 0;  ///< by glare, log10 units of display luminance, ≥ 0
};

/// log10 of an eye_average, for statistics of the same view or views: of a black one, that of its statistics.
double log_eye_average(double eye_average, const ImageStatistics& statistics);

RobustAdaptiveParameters fit(const RobustAdaptiveOptions& options, const ImageStatistics& statistics,
                             double log_eye_average);
ToneMapped apply(const RobustAdaptiveParameters& parameters, const SceneImage& view, int threads = 0);

}  // namespace plenolab
