#pragma once

#include <deque>
#include <optional>

#include "experiments/session/plan.h"
#include "experiments/session/recorder.h"
#include "experiments/session/stage.h"
#include "experiments/session/study.h"

namespace plenolab {

/// Thrown when the session is stopped by the experimenter (Esc, closed window); everything is stored by then.
struct SessionStopped {};

/// The inputs of a session, one after the other, across its pages and trials: what comes in one batch with a
/// choice or an answer is not lost with it. Stores when the pad is plugged in (with its name) and unplugged.
class SessionInputs {
 public:
  SessionInputs(Stage& stage, Recorder& recorder) : stage_(stage), recorder_(recorder) {}

  /// Asks the stage for what has happened since.
  void poll();
  /// The next input, for whose time the recorder is set; none when all were handed out.
  std::optional<RawInput> next();
  /// Forgets presses that wait, which were meant for what is over; plugs, Esc and closing stay.
  void drop_presses();
  /// The pad was unplugged, and neither plugged in again nor done without.
  bool pad_is_missing() const { return pad_is_missing_; }
  void go_on_with_keyboard() { pad_is_missing_ = false; }

 private:
  Stage& stage_;
  Recorder& recorder_;
  std::deque<RawInput> waiting_;
  bool pad_is_missing_ = false;
};

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
  SessionInputs& inputs;
  TrialOptions options;
  double interval_ms = 1000.0 / 60;  ///< of the display
};

/// Runs a trial to its choice, storing every event: shown (or shown_again after a pause), press with the tone
/// and vibration that it brought, choice, pauses. Begins paused while the pad is missing. Throws
/// SessionStopped.
void run_trial(const TrialContext& context, const TrialScene& scene);

/// Shows pages until the question is answered; the answer. Throws SessionStopped.
std::string ask(Stage& stage, Recorder& recorder, SessionInputs& inputs, const FormQuestion& question,
                const std::string& banner);

}  // namespace plenolab
