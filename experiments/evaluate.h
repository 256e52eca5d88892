#pragma once

#include <functional>

#include "analysis/result_table.h"
#include "core/base/progress.h"
#include "core/lightfield/light_field.h"
#include "core/synthesis/novel_view.h"
#include "core/synthesis/options.h"

namespace plenolab {

/// How a captured light field is judged with only part of its views as key views.
struct EvaluateOptions {
  int key_stride = 2;  ///< every key_stride-th column and row is a key view, ≥ 2
  SynthesisOptions synthesis;
  /// Scale before gamma encoding, for scene-referred views; 0 = from the captured middle view.
  double exposure = 0;
  double cd_m2_per_unit = 1;  ///< luminance of a value of 1, for PQ

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// A captured view that was synthesised from the others.
template <class Referral>
struct EvaluatedView {
  int column = 0, row = 0;  ///< in the captured grid
  const RgbImage<Referral>& captured;
  const NovelView<Referral>& synthesised;
  float exposure = 1;
};

/// Takes every key_stride-th view of a light field as key view, synthesises all other captured views that lie
/// between key views and scores each against what was captured. Rows: every metric per view (columns stride,
/// view), then totals (view "all"): PSNR of the pooled error, mean and worst SSIM, unseen share, median
/// seconds, and the number of views that lie outside the key views and could not be scored. Non-finite and
/// negative captured values are repaired before scoring and counted (repaired_values). `receive` is called
/// for every view, in order; it may be empty.
///
/// Throws InputError if no view is left to score (e.g. a single view, or a stride beyond the grid).
template <class Referral>
ResultTable evaluate(const BasicLightField<Referral>& captured, const EvaluateOptions& options,
                     const Progress& progress = {},
                     const std::function<void(const EvaluatedView<Referral>&)>& receive = {});

}  // namespace plenolab
