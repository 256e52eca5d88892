#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/session/observer.h"
#include "experiments/session/trials.h"

namespace plenolab {

struct SimulationOptions {
  int participants = 34;
  ObserverOptions observer;  ///< its `number` is set for each participant
  /// Every event is waited for as in a real session; otherwise it survives the end of the program but perhaps
  /// not a power cut, which saves most of the time.
  Durability durability = Durability::kProcessEnd;
  std::function<void(const SessionEvent&)> on_event;  ///< called once an event is stored; may be empty
  std::function<void(double)> progress;               ///< share of participants done; may be empty
  /// Told why a session that is there cannot be read; it stays as it is, without rows. If empty, that is
  /// thrown.
  std::function<void(const std::string&)> on_unread;
};

/// Runs simulated participants 1 … n through the whole session: consent, questions, trials, questionnaire, by
/// a virtual pad. Sessions in `sessions` that are done stay as they are, interrupted ones are resumed,
/// missing ones created; what they behave by is in simulation.json there. Throws InputError if the folder was
/// simulated with other options (their number aside), holds sessions of another study or of people, or is
/// not empty and no simulation.
std::vector<TrialRecord> simulate_study(const std::filesystem::path& study,
                                        const std::filesystem::path& sessions,
                                        const SimulationOptions& options);

}  // namespace plenolab
