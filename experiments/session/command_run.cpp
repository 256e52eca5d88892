#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <functional>
#include <iostream>
#include <memory>
#include <string_view>

#include "core/base/error.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/stop_signals.h"
#include "experiments/cli/suggest.h"
#include "experiments/session/commands.h"
#include "experiments/session/runner.h"
#include "experiments/session/same_study.h"
#include "experiments/session/sdl_stage.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/simulate.h"
#include "experiments/session/sqlite.h"
#include "experiments/session/study_files.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct StageOptions {
  bool keyboard = false, window = false, any_timing = false, echo = false;
  std::string screenshots;
};

struct RunOptions {
  std::string study, out;
  bool pilot = false;
  StageOptions stage;
};

struct ResumeOptions : RunOptions {
  std::string participant;
  bool yes = false;
};

void add_stage_options(CLI::App& app, StageOptions& options) {
  app.add_flag(
      "--keyboard", options.keyboard,
      "Go on without a pad: space bar, left and right arrow, return (they always work beside a pad)");
  app.add_flag("--window", options.window, "In a window instead of the full screen; pilots only");
  app.add_flag("--any-timing", options.any_timing,
               "Go on with a display whose flips do not keep its rate; stored with the session");
  app.add_flag("--echo", options.echo, "Print every event once it is stored");
  app.add_option("--screenshots", options.screenshots,
                 "Keep a picture of all that is drawn here; pilots only")
      ->check(not_empty());
}

void print_event(const SessionEvent& e) {
  fmt::print("{} {:.3f} s {}{}{}{}{}\n", e.sequence, static_cast<double>(e.t_us) * 1e-6, e.kind,
             e.what.empty() ? "" : " ", e.what, e.outcome.empty() ? "" : " ", e.outcome);
  std::fflush(stdout);
}

void require_trying_out(const StageOptions& options, SessionMode mode) {
  if (mode != SessionMode::kReal) return;
  if (options.window) throw UsageError("--window is for pilots: real sessions have the whole screen");
  if (!options.screenshots.empty()) throw UsageError("--screenshots is for pilots: taking them costs time");
}

void warn(const std::string& line) {
  fmt::print(stderr, "plenolab: {}\n", line);
}

/// A word as it is typed into a shell: quoted if it holds anything but letters, digits and what paths are
/// made of.
std::string for_shell(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/._-+:,@%=").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The command that goes on with a session.
std::string resume_command(const RunOptions& options, const std::string& participant) {
  return fmt::format("plenolab session resume {} {}{}", for_shell(options.study), participant,
                     options.out.empty() ? "" : " -o " + for_shell(options.out));
}

/// Makes sure of display and pad before `begin` creates or opens the session: nothing is left by a failed
/// start.
SessionState run_on_stage(SdlStage& stage, const StudyDefinition& study, SessionMode mode,
                          const std::function<SessionStore()>& begin, const RunOptions& options) {
  const StageOptions& how = options.stage;
  const StageEquipment equipment = stage.equipment();
  if (!how.keyboard && equipment.pad.empty())
    throw InputError("no pad is connected: plug one in, or give --keyboard to go on with the keyboard");
  if (!equipment.audio) warn("there is no audio: no tone will be heard");
  const DisplayReport display =
      require_displays(stage, study, study_folder(options.study), mode, how.any_timing);
  SessionStore store = begin();
  const std::string& who = store.identity().participant;
  const std::string kept = fmt::format("everything so far is stored in {}; to go on: {}",
                                       store.folder().string(), resume_command(options, who));
  say_on_stop(kept);
  fmt::print("session {} ({}) {}\n", who, mode == SessionMode::kPilot ? "PILOT: not data" : "real",
             store.events().empty() ? "begins" : "goes on");
  std::fflush(stdout);
  RunnerOptions runner{.images = study_folder(options.study),
                       .any_timing = how.any_timing,
                       .display = display,
                       .keyboard = how.keyboard};
  if (how.echo) runner.on_event = print_event;
  const SessionState state = run_session(store, stage, runner);
  if (state == SessionState::kInterrupted)
    fmt::print("session {} was stopped; {}\n", who, kept);
  else
    fmt::print("session {}: {}; stored in {}\n", who, name_of(state), store.folder().string());
  return state;
}

/// A stop signal ends the session as closing its window does, and then the program.
void run_on_screen(const StudyDefinition& study, SessionMode mode, const std::function<SessionStore()>& begin,
                   const RunOptions& options) {
  StopRequest stop;
  SessionState state;
  {
    const SdlLibrary sdl(SdlLibrary::Use::kScreen);
    SdlStage stage({options.stage.window, options.stage.screenshots, [&] { return stop.requested(); }});
    state = run_on_stage(stage, study, mode, begin, options);
  }
  if (state == SessionState::kInterrupted) stop.end_if_requested();
}

/// Nobody can agree to the text that `session new` writes.
void require_own_consent(const StudyDefinition& study, SessionMode mode, const fs::path& file) {
  if (!is_placeholder(study.consent)) return;
  const std::string what = fmt::format(
      "the consent text in {} is still the placeholder: write the one that your ethics board agreed to",
      study_file(file).string());
  if (mode == SessionMode::kReal) throw InputError(what + " before the first participant comes");
  warn(what + "; pilots only until then");
}

/// The mode in which a study is run: a pilot study only as one, any study with --pilot as one.
SessionMode mode_of(const StudyDefinition& study, const RunOptions& options) {
  if (study.mode == SessionMode::kPilot && !options.pilot)
    throw UsageError(
        "this study is in pilot mode: its sessions are no data; give --pilot to try it out, or set \"mode\" "
        "to \"real\" "
        "in the study file");
  return options.pilot ? SessionMode::kPilot : SessionMode::kReal;
}

void run_new(const RunOptions& options) {
  const StudyDefinition study = read_study(options.study);
  const SessionMode mode = mode_of(study, options);
  require_trying_out(options.stage, mode);
  require_own_consent(study, mode, options.study);
  const fs::path sessions = sessions_folder(options.out, options.study);
  for (const std::string& line : require_same_study(sessions, study, mode)) warn("not read: " + line);
  const auto begin = [&] { return create_next_session(sessions, study, mode, Durability::kPowerCut); };
  run_on_screen(study, mode, begin, options);
}

StoredSession read_own_session(const fs::path& folder) {
  StoredSession stored = read_session(folder);
  require_own_folder(stored.identity, folder);
  return stored;
}

bool is_interrupted(const StoredSession& stored) {
  return stored.identity.mode != SessionMode::kSimulated &&
         summarise(stored.identity, study_of(stored.identity), stored.events).state ==
             SessionState::kInterrupted;
}

/// Sessions of people that were interrupted; those in use by another station are not, and those that cannot
/// be read are told and passed by.
std::vector<std::string> interrupted_sessions(const fs::path& sessions) {
  std::vector<std::string> names;
  for (const fs::path& folder : session_folders(sessions)) {
    try {
      if (!holds_session(folder)) continue;
      const StoredSession stored = read_own_session(folder);
      if (is_interrupted(stored)) names.push_back(stored.identity.participant);
    } catch (const DatabaseInUse&) {
    } catch (const InputError& error) {
      warn(std::string("not read: ") + error.what());
    }
  }
  return names;
}

/// The session named, or the only interrupted one.
std::string session_to_resume(const ResumeOptions& options, const fs::path& sessions) {
  const auto folders = session_folders(sessions);
  const bool named = !options.participant.empty();
  if (named && std::find(folders.begin(), folders.end(), sessions / options.participant) != folders.end() &&
      is_interrupted(read_own_session(sessions / options.participant)))
    return options.participant;
  const std::vector<std::string> names = interrupted_sessions(sessions);
  if (named)
    throw UsageError(fmt::format("{} holds no interrupted session '{}'{}", sessions.string(),
                                 options.participant, did_you_mean(options.participant, names)));
  if (names.empty()) throw InputError(fmt::format("{} holds no interrupted session", sessions.string()));
  if (names.size() == 1) return names.front();
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw UsageError(fmt::format("several sessions were interrupted: name one of {}", list));
}

bool agreed_to_resume(const StoredSession& stored) {
  const SessionSummary summary = summarise(stored.identity, study_of(stored.identity), stored.events);
  const std::string last = stored.events.empty() ? stored.identity.created_utc : stored.events.back().utc;
  fmt::print("session {} ({}) was interrupted at {} after {} of {} trials; resume it? [y/N] ",
             stored.identity.participant, name_of(stored.identity.mode), last, summary.trials.size(),
             summary.trials_planned);
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

void resume(const ResumeOptions& options) {
  const StudyDefinition study = read_study(options.study);
  const fs::path sessions = sessions_folder(options.out, options.study);
  const fs::path folder = sessions / session_to_resume(options, sessions);
  const StoredSession stored = read_own_session(folder);
  require_trying_out(options.stage, stored.identity.mode);
  const std::string different = difference(stored.identity, study);
  if (!different.empty())
    throw InputError(fmt::format("{} {} than the one of {}: it cannot go on with it", folder.string(),
                                 different, study_file(options.study).string()));
  require_own_consent(study, stored.identity.mode, options.study);
  if (!options.yes && !agreed_to_resume(stored)) {
    fmt::print("nothing was changed\n");
    return;
  }
  const auto begin = [&] { return SessionStore::open(folder, Durability::kPowerCut); };
  run_on_screen(study, stored.identity.mode, begin, options);
}

}  // namespace

fs::path sessions_folder(const std::string& option, const fs::path& study) {
  return option.empty() ? study_folder(study) / "sessions" : fs::path(option);
}

fs::path existing_sessions_folder(const fs::path& given) {
  return fs::is_directory(given / "sessions") ? given / "sessions" : given;
}

void add_session_run(CLI::App& session) {
  CLI::App& app = *session.add_subcommand("run", "Run the session of the next participant");
  auto options = std::make_shared<RunOptions>();
  app.add_option("study", options->study, "Study file, or its folder")->required()->check(not_empty());
  app.add_option("-o,--out", options->out, "Folder of the sessions (default: sessions beside the study file)")
      ->check(not_empty());
  app.add_flag("--pilot", options->pilot, "Try the study out: stored and exported as a pilot, never as data");
  add_stage_options(app, options->stage);
  app.footer("Esc asks whether to stop. Example: plenolab session run study --pilot --keyboard");
  app.callback([options] { run_new(*options); });
}

void add_session_resume(CLI::App& session) {
  CLI::App& app =
      *session.add_subcommand("resume", "Go on with an interrupted session; its last trial is repeated");
  auto options = std::make_shared<ResumeOptions>();
  app.add_option("study", options->study, "Study file, or its folder")->required()->check(not_empty());
  app.add_option("participant", options->participant, "Session to resume (default: the only interrupted one)")
      ->check(not_empty());
  app.add_option("-o,--out", options->out, "Folder of the sessions (default: sessions beside the study file)")
      ->check(not_empty());
  app.add_flag("--yes", options->yes, "Do not ask first");
  add_stage_options(app, options->stage);
  app.footer("Example: plenolab session resume study real-003");
  app.callback([options] { resume(*options); });
}

}  // namespace plenolab
