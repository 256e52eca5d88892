#include "experiments/session/simulate.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/session/runner.h"
#include "experiments/session/same_study.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/simulated_stage.h"
#include "experiments/session/sqlite.h"
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

/// Why a session that is there cannot be gone on with; empty if it can, or there is none.
std::string fault_of(const fs::path& folder) {
  try {
    if (!holds_session(folder)) return "";
    const StoredSession stored = read_session(folder);
    require_own_folder(stored.identity, folder);
    summarise(stored.identity, study_of(stored.identity), stored.events);
  } catch (const DatabaseInUse&) {
    throw;
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* kRecordFile = "simulation.json";

/// The options in words: "observer ideal, rate 0, seed 1, wrong near 0.1".
std::string options_in(const ObserverOptions& observer) {
  std::string text =
      fmt::format("observer {}, rate {:g}, seed {}",
                  observer_names()[static_cast<std::size_t>(observer.kind)], observer.rate, observer.seed);
  for (const auto& entry : observer.wrong) text += fmt::format(", wrong {} {:g}", entry.first, entry.second);
  return text;
}

/// What decides how simulated participants behave, as stored beside their sessions.
nlohmann::ordered_json record_of(const ObserverOptions& observer) {
  return {{"format", "plenolab-simulation"},
          {"version", 1},
          {"options", options_in(observer)},
          {"observer", observer_names()[static_cast<std::size_t>(observer.kind)]},
          {"rate", observer.rate},
          {"seed", observer.seed},
          {"wrong", nlohmann::ordered_json(observer.wrong)}};
}

bool holds_only_a_torn_record(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (!is_partial_of(folder / kRecordFile, entry.path())) return false;
  return true;
}

/// Records the options in a new folder; one that exists must have been simulated with the same.
void require_same_options(const fs::path& sessions, const ObserverOptions& observer, Durability durability) {
  const nlohmann::ordered_json record = record_of(observer);
  const fs::path file = sessions / kRecordFile;
  if (!fs::exists(sessions) || (fs::is_directory(sessions) && holds_only_a_torn_record(sessions))) {
    create_private_folder(sessions);
    return create_private_file(file, record.dump(2) + "\n", durability);
  }
  if (!fs::is_regular_file(file))
    throw InputError(fmt::format("{} is there and no simulation: give a new folder (-o)", sessions.string()));
  const auto before = nlohmann::ordered_json::parse(read_text_file(file, 16u << 20), nullptr, false);
  if (before == record) return;
  if (!before.is_object() || !before.contains("options") || !before["options"].is_string())
    throw InputError(fmt::format("{} is damaged: give a new folder (-o)", file.string()));
  throw InputError(fmt::format("{} was simulated with {}, not with {}: give a new folder (-o)",
                               sessions.string(), before["options"].get<std::string>(),
                               options_in(observer)));
}

}  // namespace

std::vector<TrialRecord> simulate_study(const fs::path& study_path, const fs::path& sessions,
                                        const SimulationOptions& options) {
  const StudyDefinition study = read_study(study_path);
  if (fs::weakly_canonical(sessions) == fs::weakly_canonical(study_folder(study_path) / "sessions"))
    throw InputError(
        fmt::format("{} is where the sessions of people go: give another folder (-o)", sessions.string()));
  if (fs::is_directory(sessions)) require_same_study(sessions, study, SessionMode::kSimulated);
  require_same_options(sessions, options.observer, options.durability);
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  std::vector<TrialRecord> records;
  for (int number = 1; number <= options.participants; ++number) {
    const std::string fault = fault_of(sessions / pseudonym(SessionMode::kSimulated, number));
    if (!fault.empty() && !options.on_unread) throw InputError(fault);
    if (!fault.empty()) {
      options.on_unread(fault);
      continue;
    }
    SessionStore store = open_or_create(sessions, study, number, options.durability);
    ObserverOptions observer = options.observer;
    observer.number = number;
    SimulatedStage stage(observer);
    RunnerOptions runner{
        .images = study_folder(study_path), .note = options_in(observer), .on_event = options.on_event};
    run_session(store, stage, runner);
    const SessionSummary summary = summarise(store.identity(), study, store.events());
    records.insert(records.end(), summary.trials.begin(), summary.trials.end());
    if (options.progress) options.progress(static_cast<double>(number) / options.participants);
  }
  return records;
}

}  // namespace plenolab
