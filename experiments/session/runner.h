#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/session/stage.h"
#include "experiments/session/store.h"
#include "experiments/session/trials.h"

namespace plenolab {

struct RunnerOptions {
  std::filesystem::path images;  ///< the study's folder
  /// Go on with a display whose flips do not wait for it or do not keep the rate it states. Refused for real
  /// participants otherwise: the black between images could not be trusted.
  bool any_timing = false;
  /// The display that is open on the stage (require_displays): the session begins on it as it is. Displays
  /// that are opened later are measured again.
  std::optional<DisplayReport> display;
  bool keyboard = false;  ///< the keyboard was asked for; stored with the start of the run
  std::string note;       ///< stored with the start of the run, e.g. the simulated observer
  std::function<void(const SessionEvent&)> on_event;  ///< called once an event is stored; may be empty
};

/// Opens every display that the study needs and loads the images it is to show from the folder `images`, so
/// that a session does not begin that cannot be run. Throws InputError if a display is not there, an image is
/// damaged or larger than its display, or, for real sessions and unless `any_timing`, a display cannot be
/// trusted with time. The report of the display that is open when it returns, on which the session begins.
DisplayReport require_displays(Stage& stage, const StudyDefinition& study,
                               const std::filesystem::path& images, SessionMode mode, bool any_timing);

/// Runs a session from where it stands to its end, or until it is stopped:
/// consent → questions about the person → instructions → blocks of trials → questionnaire → end.
/// Every event is stored before anything else is shown. Throws InputError if something cannot be stored or
/// shown: the session can be resumed.
SessionState run_session(SessionStore& store, Stage& stage, const RunnerOptions& options);

}  // namespace plenolab
