#pragma once

#include <optional>
#include <vector>

#include "core/luminance/log_average.h"
#include "core/luminance/ray_images.h"

namespace plenolab {

/// The luminance level that an observer of a display adapts to, as a function of where the observer stands:
/// what tone mapping needs for every ray (Doronin & Barsi 2018, sections 3 to 6).
enum class LuminanceMethod {
  kAll,           ///< one log-average over all rays
  kBruteForce,    ///< for each sample the log-average of the simulated perceived image (algorithm 1)
  kAccumulative,  ///< each ray counts for the sample nearest to its X (algorithm 2; its line 11 lacks the
                  ///< exp)
  kSpread,  ///< each ray counts for all samples that it reaches, with its weight (section 5.3, not built
            ///< there)
};
/// "all", "brute-force", "accumulative", "spread", and back. The latter throws InputError for another name.
const char* name_of(LuminanceMethod method);
LuminanceMethod luminance_method_named(const std::string& name);
const std::vector<std::string>& luminance_method_names();

struct LuminanceOptions {
  LuminanceMethod method = LuminanceMethod::kAccumulative;
  LogAverageOptions average;
  /// Accumulative: a sample also takes half of what its neighbours have (equation 4), on a plane along both
  /// axes.
  bool smoothed = false;
  /// Spread: weights of the rays that light a point of the screen add up to 1 for each sample, as those of
  /// perceived images do. Then the mean of logarithms is at most the logarithm of the mean: brute force at
  /// the display's resolution() is never below spread where all rays are above ε, and equal where the rays
  /// that reach an observer at one point agree.
  bool normalised_spread = true;
  PinholeSize pinhole;  ///< of brute force; the display's resolution() shows all rays
  int threads = 0;

  void validate() const;
};

/// ln L̄ along the observers' line, or over their plane.
struct GlobalLuminance {
  ObserverSamples samples;
  /// For each sample, in cd/m². Where it is undefined (no pixel above ε) it is filled from the neighbours:
  /// linear between the nearest defined ones, beyond the last ones constant. Empty if no sample is defined.
  std::vector<double> ln_luminance;
  std::vector<unsigned char> defined;  ///< 0 where a value is filled in, or there is none

  int undefined() const;
  bool known() const { return !ln_luminance.empty(); }
  /// Linear in ln L̄ between samples; beyond the outermost ones their value. Nothing unless known().
  std::optional<double> ln_at(ObserverPosition position) const;
};

/// Estimates L̄ at the samples. Rays beyond the range of the samples are not accumulated; All takes them.
/// Results are the same for any number of threads. Throws InputError for luminance of another size than the
/// display's.
GlobalLuminance estimate_luminance(const RayDisplay& display, const RayValues<float>& luminance,
                                   const ObserverSamples& samples, const LuminanceOptions& options);

/// The same by the letter of the definitions: ray by ray and pixel by pixel in double precision, with a
/// logarithm for each, on one thread. What estimate_luminance is tested and timed against.
GlobalLuminance estimate_luminance_literally(const RayDisplay& display, const RayValues<float>& luminance,
                                             const ObserverSamples& samples, const LuminanceOptions& options);

}  // namespace plenolab
