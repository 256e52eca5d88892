#include "experiments/session/simulate.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "experiments/session/runner.h"
#include "experiments/session/same_study.h"
#include "experiments/session/simulated_stage.h"
#include "experiments/session/study_files.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

SessionStore open_or_create(const fs::path& sessions, const StudyDefinition& study, int number,
                            Durability durability) {
  const SessionIdentity identity = new_identity(study, SessionMode::kSimulated, number);
  const fs::path folder = sessions / identity.participant;
  return holds_session(folder) ? SessionStore::open(folder, durability)
                               : SessionStore::create(sessions, identity, durability);
}

std::string note_of(const ObserverOptions& observer) {
  return fmt::format("observer {} rate {:g} seed {}",
                     observer_names()[static_cast<std::size_t>(observer.kind)], observer.rate, observer.seed);
}

}  // namespace

std::vector<TrialRecord> simulate_study(const fs::path& study_path, const fs::path& sessions,
                                        const SimulationOptions& options) {
  const StudyDefinition study = read_study(study_path);
  require_same_study(sessions, study, SessionMode::kSimulated);
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  std::vector<TrialRecord> records;
  for (int number = 1; number <= options.participants; ++number) {
    SessionStore store = open_or_create(sessions, study, number, options.durability);
    ObserverOptions observer = options.observer;
    observer.number = number;
    SimulatedStage stage(observer);
    RunnerOptions runner{
        .images = study_folder(study_path), .note = note_of(observer), .on_event = options.on_event};
    run_session(store, stage, runner);
    const SessionSummary summary = summarise(store.identity(), study, store.events());
    records.insert(records.end(), summary.trials.begin(), summary.trials.end());
    if (options.progress) options.progress(static_cast<double>(number) / options.participants);
  }
  return records;
}

}  // namespace plenolab
