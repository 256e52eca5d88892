#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// What the photometric self-check tried: the correspondence q = p + (F_p − F_q)·disp(p) and its usual
/// mistakes.
enum class DisparityHypothesis {
  kAsStated,
  kFlippedX,     ///< columns run the other way
  kFlippedY,     ///< rows run the other way
  kFlippedBoth,  ///< both, or the sign of disparity
  kSwappedAxes,  ///< rows and columns exchanged
  kHalved,       ///< the true disparity is half of what is stated
  kDoubled,      ///< the true disparity is twice what is stated
  kNoShift,      ///< no displacement at all
};

/// Words for a hypothesis, e.g. "x flipped".
const char* describe(DisparityHypothesis hypothesis);

/// Mean over view pairs of the median absolute difference of gamma-encoded luminance after warping.
struct HypothesisError {
  DisparityHypothesis hypothesis = DisparityHypothesis::kAsStated;
  double error = 0;
};

enum class SelfCheckVerdict {
  kConsistent,
  kWrongSignX,
  kWrongSignY,
  kWrongSignBoth,
  kSwappedAxes,
  kWrongScale,    ///< see best_scale
  kInconsistent,  ///< no displacement explains the views better than the stated one, nor does the stated one
  kUndecidable,   ///< too little texture, disparity or overlap, or a single view
};

struct SelfCheckResult {
  SelfCheckVerdict verdict = SelfCheckVerdict::kUndecidable;
  std::vector<HypothesisError> errors;  ///< one for each hypothesis tried, in the order of the enumeration
  /// Factor on disparity with the least error, of a search over [0.4, 2.5].
  double best_scale = 1;
  /// The same between columns alone and between rows alone, 1 without such pairs: they differ if the ratio of
  /// the spacings is wrong.
  double best_scale_x = 1, best_scale_y = 1;
  int pairs = 0;            ///< neighbouring view pairs compared
  std::string explanation;  ///< one sentence for people
  double error(DisparityHypothesis hypothesis) const;
};

struct SelfCheckOptions {
  int max_pairs_per_axis = 4;  ///< neighbouring pairs compared along each axis, spread over the grid
  int max_samples = 60000;     ///< pixels compared per pair
  int threads = 0;             ///< 0 = all
  void validate() const;
};

/// Warps neighbouring views onto each other by their disparity and compares gamma-encoded luminance, robustly
/// (median over textured pixels that are not occluded), against the usual mistakes: flipped signs, exchanged
/// axes, wrong scale. Exposure is taken from the views themselves. Radiance may hold NaN and Inf; such pixels
/// are left out.
SelfCheckResult self_check(const LightField& light_field, const SelfCheckOptions& options = {},
                           const Progress& progress = {});
SelfCheckResult self_check(const DisplayLightField& light_field, const SelfCheckOptions& options = {},
                           const Progress& progress = {});

/// Throws InputError, naming the light field and what is wrong, unless the verdict is consistent or
/// undecidable.
void require_consistent(const SelfCheckResult& result, const std::string& light_field_name);

}  // namespace plenolab
