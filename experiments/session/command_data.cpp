#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/wide_table.h"
#include "experiments/session/commands.h"
#include "experiments/session/example_study.h"
#include "experiments/session/export.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/sqlite.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct NewOptions {
  std::string folder, images;
};

void write_new_study(const NewOptions& options) {
  const fs::path folder = options.folder;
  if (fs::exists(folder) && !fs::is_empty(folder))
    throw InputError(fmt::format("{} is not empty: a study is never overwritten", folder.string()));
  const StudyDefinition study =
      options.images.empty() ? example_study() : study_of_images(options.images, folder);
  if (options.images.empty()) write_example_images(folder);
  write_text_file(folder / "study.json", format_study(study));
  fmt::print(
      "wrote {} with {} images and {} blocks: a pilot until its texts are yours and \"mode\" is \"real\"\n",
      (folder / "study.json").string(), study.images.size(), study.blocks.size());
}

struct ListOptions {
  CommonOptions common;
  std::string folder;
};

/// Sessions that reached trials, by mode and order of blocks.
using OrderCounts = std::map<std::pair<std::string, std::string>, int>;

void add_session_rows(ResultTable& table, OrderCounts& orders, const StoredSession& stored) {
  const std::string mode = name_of(stored.identity.mode);
  const SessionSummary summary = summarise(stored.identity, study_of(stored.identity), stored.events);
  const std::vector<std::pair<std::string, Cell>> columns{{"session", stored.identity.participant},
                                                          {"mode", mode},
                                                          {"state", std::string(name_of(summary.state))},
                                                          {"created", stored.identity.created_utc},
                                                          {"study", stored.identity.study_hash.substr(0, 8)}};
  table.add({"trials_completed", static_cast<double>(summary.trials.size()), "trials", columns});
  table.add({"trials_planned", static_cast<double>(summary.trials_planned), "trials", columns});
  table.add({"runs", static_cast<double>(summary.runs), "runs", columns});
  table.add({"events", static_cast<double>(stored.events.size()), "events", columns});
  if (!summary.trials.empty()) ++orders[{mode, summary.trials.front().order}];
}

void list_sessions(const Invocation& invocation, const ListOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  ResultTable table;
  std::vector<std::string> unread;
  OrderCounts orders;
  int in_use = 0;
  for (const fs::path& folder : session_folders(existing_sessions_folder(options.folder))) {
    try {
      const StoredSession stored = read_session(folder);
      require_own_folder(stored.identity, folder);
      add_session_rows(table, orders, stored);
    } catch (const DatabaseInUse&) {
      ++in_use;
      tell(options.common, "running: " + folder.filename().string());
    } catch (const InputError& error) {
      unread.push_back(error.what());
    }
  }
  if (!output_is_for_programs(options.common))
    fmt::print("{}", to_wide_text(table, {"session", "mode", "state", "created", "study"},
                                  {{"trials_completed", "trials"},
                                   {"trials_planned", "planned"},
                                   {"runs", "runs"},
                                   {"events", "events"}}));
  for (const auto& [which, count] : orders) {
    tell(options.common,
         fmt::format("{} sessions with trials in the order {}: {}", which.first, which.second, count));
    table.add({"sessions_with_trials",
               static_cast<double>(count),
               "sessions",
               {{"mode", which.first}, {"order", which.second}}});
  }
  for (const std::string& line : unread) tell(options.common, "not read: " + line);
  table.add({"sessions_running", static_cast<double>(in_use), "sessions", {}});
  table.add({"sessions_not_read", static_cast<double>(unread.size()), "sessions", {}});
  write_results(table, provenance, options.common);
}

struct ExportCommandOptions {
  CommonOptions common;
  std::string folder, out, mode = "real";
  bool force = false;
  ExportOptions choices;
};

SessionMode mode_named(const std::string& name) {
  return name == "real"    ? SessionMode::kReal
         : name == "pilot" ? SessionMode::kPilot
                           : SessionMode::kSimulated;
}

void export_command(const Invocation& invocation, const ExportCommandOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  provenance.parameters["mode"] = options.mode;
  const fs::path sessions = existing_sessions_folder(options.folder);
  ExportCounts counts;
  const std::string item = fmt::format("{} --mode {}", item_path(sessions), options.mode);
  write_result_folder({options.out, "session export", item, options.force, true}, provenance,
                      [&](const fs::path& folder) {
                        counts = export_sessions(sessions, mode_named(options.mode), folder, options.choices);
                      });
  ResultTable table;
  const auto add = [&](const char* quantity, int value, const char* unit, const std::string& order = "") {
    std::vector<std::pair<std::string, Cell>> columns{{"mode", options.mode}};
    if (!order.empty()) columns.push_back({"order", order});
    table.add({quantity, static_cast<double>(value), unit, columns});
  };
  add("sessions", counts.sessions, "sessions");
  add("sessions_done", counts.done, "sessions");
  for (const auto& entry : counts.orders) add("sessions_with_trials", entry.second, "sessions", entry.first);
  add("sessions_left_out", static_cast<int>(counts.left_out.size()), "sessions");
  add("trials", counts.trials, "trials");
  add("events", counts.events, "events");
  emit_results(table, provenance, options.common);
  for (const LeftOutSession& left : counts.left_out)
    tell(options.common, fmt::format("left out: {}: {}", left.session, left.reason));
  tell(options.common, fmt::format("wrote trials.csv, events.csv and a BIDS data set to {}", options.out));
}

}  // namespace

void add_session_new(CLI::App& session, const Invocation&) {
  CLI::App& app = *session.add_subcommand("new", "Write a study to start from");
  auto options = std::make_shared<NewOptions>();
  app.add_option("folder", options->folder, "Folder for the study, which must be empty or not exist")
      ->required()
      ->check(not_empty());
  app.add_option(
         "--images", options->images,
         "Image set of 'plenolab reproject --image-set', or folder of pairs NAME-reference.png and "
         "NAME-test.png (for the monitor NAME-monitor-reference.png and -test.png; default: example images "
         "are drawn)")
      ->check(not_empty());
  app.footer("Example: plenolab session new study");
  app.callback([options] { write_new_study(*options); });
}

void add_session_list(CLI::App& session, const Invocation& invocation) {
  CLI::App& app = *session.add_subcommand("list", "What sessions there are and how far they have come");
  auto options = std::make_shared<ListOptions>();
  app.add_option("folder", options->folder, "Folder of sessions, or of the study that has them")
      ->required()
      ->check(not_empty());
  add_common_options(app, options->common);
  app.footer("Example: plenolab session list study");
  app.callback([options, &invocation] { list_sessions(invocation, *options); });
}

void add_session_export(CLI::App& session, const Invocation& invocation) {
  CLI::App& app =
      *session.add_subcommand("export", "Write trials and events as tables, and as a BIDS data set");
  auto options = std::make_shared<ExportCommandOptions>();
  app.add_option("folder", options->folder, "Folder of sessions, or of the study that has them")
      ->required()
      ->check(not_empty());
  app.add_option("-o,--out", options->out, "Folder for the tables")->required()->check(not_empty());
  app.add_option("--mode", options->mode, "Which sessions; they are never mixed")
      ->check(one_of({"real", "pilot", "simulated"}))
      ->capture_default_str();
  app.add_flag("--leave-out-damaged", options->choices.leave_out_damaged,
               "Go on without sessions that cannot be read; otherwise nothing is exported");
  app.add_flag("--wall-clock", options->choices.wall_clock,
               "With date and time of every event, which may tell who somebody is");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer("Example: plenolab session export study -o exported");
  app.callback([options, &invocation] { export_command(invocation, *options); });
}

}  // namespace plenolab
