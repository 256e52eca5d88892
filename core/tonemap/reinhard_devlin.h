#pragma once

#include <optional>
#include <span>

#include "core/tonemap/photoreceptor.h"
#include "core/tonemap/statistics.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Photoreceptor operator of Reinhard & Devlin 2005 (thesis, sections 2.1.2, 5.1.5, 5.1.6 and 5.2).
///
/// Input: scene-referred; the formula depends on the unit (m < 1), as printed: scale relative radiance with
/// `exposure`. Output: display values in [0, 1], V itself being luma (no gamma after it):
///   I_local = c·C[i] + (1−c)·L,   I_global = c·C_avg[i] + (1−c)·L_avg,   I_a = l·I_local + (1−l)·I_global,
///   V[i] = C[i] / (C[i] + (e^(−b)·I_a)^m)   (0 where C[i] = 0),
///   m = 0.3 + 0.7·k^1.4,   k = (log L_max − log L_av)/(log L_max − log L_min)   (0.5 for a zero range).
/// The thesis leaves m's formula out and does not say which average is logarithmic: L_av is, C_avg and L_avg
/// are arithmetic, as in the original. Then each channel is normalised, (V − Y_min)/(Y_max − Y_min), with
/// limits taken from luma (a zero range leaves V as it is); values outside [0, 1] are cut and counted.
struct ReinhardDevlinOptions {
  double brightness = 0;           ///< b in [−8, 8]
  double colour_adaptation = 0;    ///< c in [0, 1]
  double light_adaptation = 1;     ///< l in [0, 1]
  std::optional<double> contrast;  ///< m in [0.1, 1]; automatic if absent
  double exposure = 1;             ///< factor on the input, (0, 1e9]
  void validate() const;
};

/// Limits of luma for the normalisation; {0, 1} leaves values as they are.
struct LumaLimits {
  double min = 0, max = 1;
  friend bool operator==(const LumaLimits&, const LumaLimits&) = default;
};

/// Throws InputError unless both are finite and 0 ≤ min < max ≤ 1.
void validate(const LumaLimits& manual);

/// The smallest limits that enclose both.
LumaLimits enclose(const LumaLimits& a, const LumaLimits& b);

/// What apply needs: the curve with its global levels.
using ReinhardDevlinParameters = Photoreceptor;

/// m of statistics by the automatic formula.
double automatic_contrast(const ImageStatistics& statistics);

ReinhardDevlinParameters fit(const ReinhardDevlinOptions& options, const ImageStatistics& statistics);

/// Response V before normalisation, all channels in [0, 1].
struct Response {
  Plane<Rgb> value;
  LumaLimits limits;  ///< smallest and largest luma; {0, 1} without pixels
  PixelRepairs repairs;
};
Response respond(const ReinhardDevlinParameters& parameters, const SceneImage& view, int threads = 0);

/// Section 5.2.1 up to the normalisation: Σ weights·V(parameters). Equal numbers of both, weights ≥ 0 with a
/// sum within 1e-6 of 1.
Response respond_interpolated(std::span<const ReinhardDevlinParameters> parameters,
                              std::span<const double> weights, const SceneImage& view, int threads = 0);

/// The normalisation; consumes the response.
ToneMapped normalise(Response response, const LumaLimits& limits, int threads = 0);

/// respond + normalise in one pass: what the naive and joint variants do once their limits are known.
ToneMapped apply(const ReinhardDevlinParameters& parameters, const LumaLimits& limits, const SceneImage& view,
                 int threads = 0);

/// Limits of a view under given parameters. Naive: of each view. Joint, automatic: `enclose` over all key
/// views.
LumaLimits measure_limits(const ReinhardDevlinParameters& parameters, const SceneImage& view,
                          int threads = 0);

}  // namespace plenolab
