#pragma once

#include <string>
#include <vector>

#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/adaptation_pace.h"
#include "experiments/reproduce/tonemap/mappings.h"

namespace plenolab {

/// The figures that compare how mappings adapt over a motion (42 to 44 of the thesis).

/// One mapping over the motion.
struct MotionShown {
  Shown shown = Shown::kReinhardNaive;
  Mapping mapping;
  const MappedMotion* motion = nullptr;
  Adaptation adaptation;
};

struct MotionStudy {
  std::string scene, title;
  const RecordedMotion* recording = nullptr;
  std::vector<MotionShown> mappings;

  /// Throws an internal error for one that was not asked for.
  const MotionShown& of(Shown shown) const;
};

/// The motion of the bench over a scene, with some mappings.
MotionStudy study_motion(MappingBench& bench, const std::string& scene, const std::vector<Shown>& shown);

/// Maps shown behind the mappings, e.g. of visibility.
struct MotionMaps {
  std::vector<ReportImage> before, event;  ///< of the frames' size
  std::vector<ReportImage> epi;            ///< of the epipolar image's size before it is stretched
};

/// Adds what all these figures show: the frames before and at the event, the epipolar images, mean luma and
/// the adaptation of surfaces over the camera position, and the table of numbers. Images start with the HDR
/// frames at one exposure (figure_exposure at the event).
void show_motion(ReproductionResult& result, const MotionStudy& study, const MotionMaps& maps = {});

/// Visibility at the frames before and at the event and along the epipolar image.
MotionMaps visibility_over(MappingBench& bench, const MotionStudy& study);

/// Who adapts at which pace, by how much, and what happens before the event.
std::string pace_words(const MotionStudy& study);
std::string event_words(const MotionStudy& study);

/// What the thesis reports of a mapping.
struct ExpectedPace {
  Shown shown = Shown::kReinhardNaive;
  std::vector<Pace> paces;  ///< any of them agrees
};
/// Whether the paces of the run are those of the thesis, one by one.
std::string comparison_words(const MotionStudy& study, const std::vector<ExpectedPace>& expected);

}  // namespace plenolab
