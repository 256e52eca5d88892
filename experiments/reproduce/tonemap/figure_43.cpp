// Figure 43: adaptation over a motion in the Cellar, where the timber hides a slit with direct sunlight.
#include <fmt/format.h>

#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/tonemap/measures.h"
#include "experiments/reproduce/tonemap/motion_figure.h"
#include "experiments/reproduce/tonemap/view_figure.h"

namespace plenolab {

ReproductionResult reproduce_cellar_adaptation(Laboratory& laboratory);

namespace {

/// The part of the frame before the event where the naive variant steps most across borders of visibility.
void enlarge_steps(ReproductionResult& result, MappingBench& bench, const MotionStudy& study,
                   const MotionMaps& maps) {
  const ReferenceFrame& frame = study.recording->frames[study.recording->event - 1];
  // One fit for all key views, synthesised from them alike: what differs is the fit of each key view.
  const MappedMotion& joint =
      bench.motion(study.scene, mapping_for(bench, study.scene, Shown::kReinhardJoint));
  const MappedMotion& naive = *study.of(Shown::kReinhardNaive).motion;
  const PixelBox box = densest_box(border_step_weights(luma_difference(naive.before, joint.before), frame),
                                   crop_size(frame.hdr.width(), frame.hdr.height()));
  std::vector<ReportImage> images;
  for (const MotionShown& m : study.mappings) images.push_back({m.mapping.label, m.motion->before});
  add_enlarged(result, "crop", study.title + ", the frame before the event", frame.hdr, images, box,
               maps.before);
}

}  // namespace

ReproductionResult reproduce_cellar_adaptation(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 43: where the timber hides a slit with direct sunlight, Reinhard 2005 with interpolated "
      "statistics adapts rapidly and at once, the naive variant gradually and before the light changes, with "
      "steps at borders of visibility. Key-view adjustment leaves none of these, adapts slowly and loses "
      "most "
      "of the sudden adaptation.";
  MappingBench& bench = laboratory.mapping_bench();
  const MotionStudy study =
      study_motion(bench, "cellar",
                   {Shown::kReinhardNaive, Shown::kReinhardAdjusted, Shown::kReinhardResults,
                    Shown::kReinhardStatistics, Shown::kHistogramFixed, Shown::kRobust});
  const MotionMaps maps = visibility_over(bench, study);
  show_motion(result, study, maps);
  enlarge_steps(result, bench, study, maps);
  result.ours_shows = pace_words(study) + " " + event_words(study);
  result.differs = comparison_words(study, {{Shown::kReinhardNaive, {Pace::kGradual}},
                                            {Shown::kReinhardStatistics, {Pace::kAbrupt}},
                                            {Shown::kReinhardAdjusted, {Pace::kGradual, Pace::kSteady}}});
  const auto naive = study.of(Shown::kReinhardNaive).adaptation.share_before,
             statistics = study.of(Shown::kReinhardStatistics).adaptation.share_before;
  if (naive && statistics)
    result.differs += fmt::format(
        " {} the naive variant is further ahead of the light: {} of its change around the event comes before "
        "it, {} with interpolated statistics.",
        *naive > *statistics ? "As in the thesis," : "It is not so that, as in the thesis,", percent(*naive),
        percent(*statistics));
  return result;
}

}  // namespace plenolab
