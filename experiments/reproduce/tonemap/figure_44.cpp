// Figure 44: adaptation over a vertical motion in the Dunes, where the sun sets behind the crest.
#include <fmt/format.h>

#include "experiments/reproduce/tonemap/motion_figure.h"

namespace plenolab {

ReproductionResult reproduce_dunes_adaptation(Laboratory& laboratory);

ReproductionResult reproduce_dunes_adaptation(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 44: more or less of the sun is seen behind the dunes, and the peak changes smoothly. Naive "
      "Reinhard 2005 and, less, histogram adjustment adapt slowly; with interpolated statistics the "
      "adaptation is undesirably fast. Key-view adjustment adapts less and more evenly.";
  const MotionStudy study =
      study_motion(laboratory.mapping_bench(), "dunes",
                   {Shown::kReinhardNaive, Shown::kReinhardAdjusted, Shown::kReinhardResults,
                    Shown::kReinhardStatistics, Shown::kHistogram, Shown::kRobust});
  show_motion(result, study);
  result.ours_shows = pace_words(study) + " " + event_words(study);
  result.differs = comparison_words(study, {{Shown::kReinhardNaive, {Pace::kGradual, Pace::kSteady}},
                                            {Shown::kReinhardStatistics, {Pace::kAbrupt}},
                                            {Shown::kReinhardAdjusted, {Pace::kSteady, Pace::kGradual}},
                                            {Shown::kHistogram, {Pace::kGradual, Pace::kSteady}}});
  const double naive = study.of(Shown::kReinhardNaive).adaptation.range;
  const auto less = [&](Shown shown, const char* what) {
    const double range = study.of(shown).adaptation.range;
    return fmt::format(" {} adapts {} than the naive variant ({:.3f} against {:.3f}), {} in the thesis.",
                       what, range < naive ? "less" : "more", range, naive, range < naive ? "as" : "unlike");
  };
  result.differs +=
      less(Shown::kHistogram, "Histogram adjustment") + less(Shown::kReinhardAdjusted, "Key-view adjustment");
  return result;
}

}  // namespace plenolab
