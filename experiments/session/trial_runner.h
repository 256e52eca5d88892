#pragma once

#include "experiments/session/plan.h"
#include "experiments/session/recorder.h"
#include "experiments/session/stage.h"
#include "experiments/session/study.h"

namespace plenolab {

/// Thrown when the session is stopped by the experimenter (Esc, closed window); everything is stored by then.
struct SessionStopped {};

/// One trial on a stage: what its display is to show, and the images of its buttons.
struct TrialScene {
  Picture black, reference, left, right;
  const Picture& of(Stimulus stimulus) const;
};

/// The pictures of a planned trial.
TrialScene trial_scene(const StudyDefinition& study, const std::filesystem::path& images,
                       const StudyBlock& block, const PlannedTrial& trial);

/// What trials of a session share.
struct TrialContext {
  Stage& stage;
  Recorder& recorder;
  TrialOptions options;
  double interval_ms = 1000.0 / 60;  ///< of the display
};

/// Runs a trial to its choice, storing every event: shown (or shown_again after a pause), press, choice, tone
/// and vibration as they are given, pauses. Throws SessionStopped.
void run_trial(const TrialContext& context, const TrialScene& scene);

/// Shows pages until the question is answered; the answer. Throws SessionStopped.
std::string ask(Stage& stage, Recorder& recorder, const FormQuestion& question, const std::string& banner);

}  // namespace plenolab
