#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "core/base/error.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/suggest.h"
#include "experiments/session/commands.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/store.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct WithdrawOptions {
  std::string folder, participant;
  bool yes = false;
};

void withdraw(const WithdrawOptions& options) {
  const fs::path sessions = existing_sessions_folder(options.folder);
  std::vector<std::string> names;
  for (const fs::path& folder : session_folders(sessions)) names.push_back(folder.filename().string());
  if (!holds_participant(sessions, options.participant))
    throw UsageError(fmt::format("{} holds no session '{}'{}", sessions.string(), options.participant,
                                 did_you_mean(options.participant, names)));
  if (!options.yes) {
    fmt::print("remove session {} and its consent from {} for ever? [y/N] ", options.participant,
               sessions.string());
    std::fflush(stdout);
    std::string answer;
    std::getline(std::cin, answer);
    if (answer != "y" && answer != "Y" && answer != "yes") {
      fmt::print("nothing was changed\n");
      return;
    }
  }
  const Withdrawal removed = withdraw_session(sessions, options.participant);
  fmt::print("removed {} {}{}; backups and exports made before still hold it\n",
             removed.session ? "session" : "the consent of", options.participant,
             removed.session && removed.consent ? " and its consent"
             : removed.session                  ? ", which had no consent"
                                                : "");
  for (const fs::path& copy : removed.copies)
    fmt::print("not removed: {} holds a copy of the session\n", copy.string());
}

}  // namespace

void add_session_withdraw(CLI::App& session) {
  CLI::App& app = *session.add_subcommand("withdraw", "Remove a participant who has withdrawn");
  auto options = std::make_shared<WithdrawOptions>();
  app.add_option("folder", options->folder, "Folder of sessions, or of the study that has them")
      ->required()
      ->check(not_empty());
  app.add_option("participant", options->participant, "Pseudonym of the session")
      ->required()
      ->check(not_empty());
  app.add_flag("--yes", options->yes, "Do not ask first");
  app.footer("Its number is not given again. Example: plenolab session withdraw study real-003");
  app.callback([options] { withdraw(*options); });
}

}  // namespace plenolab
