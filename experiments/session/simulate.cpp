#include "experiments/session/simulate.h"

#include <fmt/format.h>

#include "analysis/provenance.h"
#include "core/base/error.h"
#include "experiments/session/runner.h"
#include "experiments/session/simulated_stage.h"
#include "experiments/session/sqlite.h"

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

/// The study that a session ran; none if another station is just running it.
std::optional<std::string> hash_in(const fs::path& folder) {
  try {
    return read_session(folder).identity.study_hash;
  } catch (const DatabaseInUse&) {
    return std::nullopt;
  }
}

std::string note_of(const ObserverOptions& observer) {
  return fmt::format("observer {} rate {:g} seed {}",
                     observer_names()[static_cast<std::size_t>(observer.kind)], observer.rate, observer.seed);
}

}  // namespace

SessionIdentity new_identity(const StudyDefinition& study, SessionMode mode, int number) {
  const BuildInfo build = build_info();
  return {.participant = pseudonym(mode, number),
          .number = number,
          .mode = mode,
          .study_json = format_study(study),
          .study_hash = study_hash(study),
          .created_utc = utc_now(),
          .program = fmt::format("plenolab {} {}{}", build.version, build.revision,
                                 build.dirty ? " (changed)" : "")};
}

void require_same_study(const fs::path& sessions, const StudyDefinition& study, SessionMode mode) {
  if (!fs::is_directory(sessions)) return;
  const std::string hash = study_hash(study);
  for (const fs::path& folder : session_folders(sessions)) {
    const std::string name = folder.filename().string();
    const bool simulated = name.starts_with(name_of(SessionMode::kSimulated));
    if (simulated != (mode == SessionMode::kSimulated))
      throw InputError(fmt::format("{} holds {} sessions: keep {} ones in a folder of their own (-o)",
                                   sessions.string(), simulated ? "simulated" : "real or pilot",
                                   name_of(mode)));
    if (!name.starts_with(name_of(mode))) continue;  // pilots of earlier versions harm nobody
    if (hash_in(folder).value_or(hash) != hash)
      throw InputError(fmt::format(
          "{} ran another version of the study: keep sessions of this one in a folder of their own (-o)",
          folder.string()));
  }
}

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
