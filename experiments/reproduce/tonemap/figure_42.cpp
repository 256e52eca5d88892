// Figure 42: adaptation over a motion on the Desk, whose brightest highlights are outliers.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/reproduce/tonemap/motion_figure.h"

namespace plenolab {

ReproductionResult reproduce_desk_adaptation(Laboratory& laboratory);

namespace {

/// Why the mapping changes as little or as much as it does: how far the frames' peaks and limits differ.
std::string outlier_words(const MotionStudy& study) {
  double low = 1e300, high = -1e300, limit_low = 1e300, limit_high = -1e300;
  for (const ReferenceFrame& frame : study.recording->frames) {
    low = std::min(low, log_peak(frame.hdr));
    high = std::max(high, log_peak(frame.hdr));
  }
  for (const auto& fit : study.of(Shown::kReinhardStatistics).motion->fits)
    for (const FittedValue& value : fit)
      if (value.name == "luma_max") {
        limit_low = std::min(limit_low, value.value);
        limit_high = std::max(limit_high, value.value);
      }
  return fmt::format(
      "Over the motion the largest luminance varies by {:.2f} log10 units, which moves the upper limit of "
      "luma of "
      "the variant with interpolated statistics from {:.4f} to {:.4f}: Reinhard 2005 maps what is far above "
      "the "
      "average close to its limit, however bright it is.",
      high - low, limit_low, limit_high);
}

}  // namespace

ReproductionResult reproduce_desk_adaptation(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 42: outliers decide the mapping of Reinhard 2005. With interpolated statistics it changes as "
      "soon as one of them is hidden, with the naive variant gradually, along with the contributions of key "
      "views. Histogram adjustment and key-view adjustment are consistent.";
  const MotionStudy study =
      study_motion(laboratory.mapping_bench(), "desk",
                   {Shown::kReinhardNaive, Shown::kReinhardAdjusted, Shown::kReinhardResults,
                    Shown::kReinhardStatistics, Shown::kHistogram, Shown::kRobust});
  show_motion(result, study);
  result.ours_shows = pace_words(study) + " " + event_words(study);
  result.differs = comparison_words(study, {{Shown::kReinhardNaive, {Pace::kGradual}},
                                            {Shown::kReinhardStatistics, {Pace::kAbrupt}},
                                            {Shown::kReinhardAdjusted, {Pace::kSteady, Pace::kGradual}},
                                            {Shown::kHistogram, {Pace::kSteady}}});
  result.differs += fmt::format(" {}", outlier_words(study));
  return result;
}

}  // namespace plenolab
