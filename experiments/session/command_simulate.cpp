#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/stop_signals.h"
#include "experiments/cli/suggest.h"
#include "experiments/cli/wide_table.h"
#include "experiments/session/commands.h"
#include "experiments/session/simulate.h"
#include "experiments/session/study_files.h"

namespace plenolab {

namespace {

struct SimulateOptions {
  CommonOptions common;
  std::string study, out, observer = "ideal", wrong_file;
  std::vector<std::string> wrong;
  int participants = 34;
  double rate = -1;
  bool durable = false, echo = false;
};

/// "image=0.3" or "block/image=0.3".
void add_wrong(WrongProbabilities& wrong, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const CLI::Validator probability = number_between(0, 1);
  if (equals == std::string::npos || equals == 0 ||
      !probability(std::string(text.substr(equals + 1))).empty())
    throw UsageError(fmt::format("--wrong: '{}' is not IMAGE=P or BLOCK/IMAGE=P with P from 0 to 1", text));
  const std::string image = text.substr(0, equals);
  if (!wrong.emplace(image, std::stod(text.substr(equals + 1))).second)
    throw UsageError(fmt::format("--wrong: '{}' is given twice", image));
}

/// What a study shows that can be taken wrongly: "image" and "block/image".
std::vector<std::string> names_for_wrong(const StudyDefinition& study) {
  std::vector<std::string> names;
  for (const StudyBlock& block : study.blocks)
    for (const std::string& image : block.images) {
      if (std::find(names.begin(), names.end(), image) == names.end()) names.push_back(image);
      names.push_back(block.id + "/" + image);
    }
  return names;
}

/// The probabilities of the options; those of --wrong go before those of the file.
WrongProbabilities wrong_of(const SimulateOptions& options, const StudyDefinition& study) {
  const std::vector<std::string> names = names_for_wrong(study);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  WrongProbabilities wrong;
  for (const std::string& text : options.wrong) add_wrong(wrong, text);
  for (const auto& entry : wrong)
    if (!known(entry.first))
      throw UsageError(fmt::format("--wrong: the study shows no image '{}'{}", entry.first,
                                   did_you_mean(entry.first, names)));
  if (options.wrong_file.empty()) return wrong;
  for (const auto& entry : read_wrong_probabilities(options.wrong_file)) {
    if (!known(entry.first))
      throw InputError(fmt::format("{}: the study shows no image '{}'{}", options.wrong_file, entry.first,
                                   did_you_mean(entry.first, names)));
    wrong.insert(entry);
  }
  return wrong;
}

SimulationOptions simulation_of(const SimulateOptions& options, const StudyDefinition& study) {
  SimulationOptions simulation;
  simulation.participants = options.participants;
  simulation.observer.kind = observer_named(options.observer);
  simulation.observer.rate = options.rate < 0 ? default_rate(simulation.observer.kind) : options.rate;
  simulation.observer.seed = options.common.seed;
  simulation.observer.wrong = wrong_of(options, study);
  if (options.durable) simulation.durability = Durability::kPowerCut;
  if (options.echo)
    simulation.on_event = [](const SessionEvent& e) {
      fmt::print("{} {} {}\n", e.sequence, e.kind, e.what);
      std::fflush(stdout);
    };
  return simulation;
}

void add_wrong_rows(ResultTable& table, const StudyDefinition& study,
                    const std::vector<TrialRecord>& trials) {
  for (const StudyBlock& block : study.blocks)
    for (const std::string& image : block.images) {
      int wrong = 0, count = 0;
      for (const TrialRecord& trial : trials)
        if (trial.block == block.id && trial.image == image) ++count, wrong += trial.chose_test ? 1 : 0;
      const std::vector<std::pair<std::string, Cell>> columns{{"block", block.id}, {"image", image}};
      table.add({"wrong_choices", static_cast<double>(wrong), "trials", columns});
      table.add({"trials", static_cast<double>(count), "trials", columns});
    }
}

void simulate(const Invocation& invocation, const SimulateOptions& options) {
  const StudyDefinition study = read_study(options.study);
  SimulationOptions simulation = simulation_of(options, study);
  Provenance provenance = begin_run(invocation, options.common);
  provenance.parameters["observer"] = options.observer;
  provenance.parameters["rate"] = simulation.observer.rate;
  provenance.parameters["participants"] = static_cast<long long>(options.participants);
  add_input(provenance, study_file(options.study));
  if (!options.wrong_file.empty()) add_input(provenance, options.wrong_file);
  ProgressBar bar("simulate");
  simulation.progress = bar.callback();
  std::vector<std::string> unread;
  simulation.on_unread = [&](const std::string& why) { unread.push_back(why); };
  say_on_stop(fmt::format(
      "the simulated sessions so far are kept in {}, and the same command goes on with them", options.out));
  const std::vector<TrialRecord> trials = simulate_study(options.study, options.out, simulation);
  bar.clear();
  for (const std::string& why : unread) fmt::print(stderr, "plenolab: not read: {}\n", why);
  ResultTable table;
  add_wrong_rows(table, study, trials);
  if (!output_is_for_programs(options.common) && !options.echo)
    fmt::print("{}",
               to_wide_text(table, {"block", "image"}, {{"wrong_choices", "wrong"}, {"trials", "trials"}}));
  write_results(table, provenance, options.common);
  tell(options.common, fmt::format("{} simulated sessions are in {}",
                                   options.participants - static_cast<int>(unread.size()), options.out));
}

}  // namespace

void add_session_simulate(CLI::App& session, const Invocation& invocation) {
  CLI::App& app = *session.add_subcommand("simulate", "Run simulated participants through the whole study");
  auto options = std::make_shared<SimulateOptions>();
  app.add_option("study", options->study, "Study file, or its folder")->required()->check(not_empty());
  app.add_option("-o,--out", options->out,
                 "Folder of the simulated sessions; interrupted ones there are resumed")
      ->required()
      ->check(not_empty());
  app.add_option("--participants", options->participants, "How many")
      ->check(whole_number(1, 10000))
      ->capture_default_str();
  app.add_option("--observer", options->observer, "What they are like")
      ->check(one_of(observer_names()))
      ->capture_default_str();
  app.add_option("--rate", options->rate,
                 "Share of trials with a lapse (default 0.1), a bias to the left (0.8), impatience or an "
                 "unplugged pad (0.5)")
      ->check(number_between(0, 1));
  app.add_option("--wrong", options->wrong,
                 "IMAGE=P or BLOCK/IMAGE=P: probability of being wrong; can be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--wrong-file", options->wrong_file, "CSV with the columns block, image, wrong")
      ->check(not_empty());
  app.add_flag("--durable", options->durable, "Wait for the disk at every event, as in real sessions");
  app.add_flag("--echo", options->echo, "Print every event once it is stored");
  add_common_options(app, options->common);
  app.footer(
      "Example: plenolab session simulate study --participants 34 --wrong monitor/near=0.2 -o simulated");
  app.callback([options, &invocation] { simulate(invocation, *options); });
}

}  // namespace plenolab
