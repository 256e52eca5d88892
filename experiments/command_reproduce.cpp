#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/parallel.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/reproduce/exhibits/exhibits.h"
#include "experiments/reproduce/run.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct ReproduceOptions {
  CommonOptions common;
  std::vector<std::string> ids;
  std::string out;
  std::string preset = "quick";
  std::string cache;
  bool list = false, force = false;
};

Effort effort_of(const std::string& preset) {
  if (preset == "tiny") return Effort::kTiny;
  return preset == "paper" ? Effort::kPaper : Effort::kQuick;
}

void print_items() {
  std::string chapter;
  fmt::print("What can be run, by chapter of the report:\n");
  for (const Reproduction& item : reproductions()) {
    if (title_of(item.chapter) != chapter) fmt::print("{}\n", chapter = title_of(item.chapter));
    fmt::print("  {:<28} {}\n", item.id, item.title);
  }
}

void print_statuses() {
  fmt::print("\nWhat became of each figure and table of the papers:\n");
  for (const ExhibitStatus status : {ExhibitStatus::kRecomputed, ExhibitStatus::kRerun,
                                     ExhibitStatus::kDiagram, ExhibitStatus::kNotReproducible})
    fmt::print("  {:<22} {}\n", name_of(status), meaning_of(status));
}

void print_exhibits() {
  print_statuses();
  for (const Paper& paper : papers()) {
    fmt::print("\n{}, {}\n", paper.name, paper.title);
    std::size_t widest = 0;
    for (const Exhibit& e : paper.exhibits) widest = std::max(widest, std::string_view(e.shows).size());
    for (const Exhibit& e : paper.exhibits) {
      fmt::print("  {:<11} {:<{}}  {:<22} {}{}{}\n", e.name, e.shows, widest, name_of(e.status), e.item,
                 *e.item && *e.note ? ": " : "", e.note);
    }
  }
}

/// What can be reproduced, and what became of each figure and table of the papers, as tables for people and
/// as rows for programs.
void list(const Invocation& invocation, const CommonOptions& options) {
  Provenance provenance = begin_run(invocation, options);
  ResultTable table;
  for (const Reproduction& item : reproductions())
    table.add({"position",
               static_cast<double>(table.rows().size() + 1),
               "1",
               {{"item", std::string(item.id)},
                {"chapter", std::string(title_of(item.chapter))},
                {"title", std::string(item.title)}}});
  for (const Paper& paper : papers())
    for (const Exhibit& e : paper.exhibits)
      table.add({"reproduced",
                 *e.item ? 1.0 : 0.0,
                 "1",
                 {{"paper", std::string(paper.name)},
                  {"exhibit", std::string(e.name)},
                  {"status", std::string(name_of(e.status))},
                  {"item", std::string(e.item)},
                  {"shows", std::string(e.shows)},
                  {"note", std::string(e.note)}}});
  if (!output_is_for_programs(options)) {
    print_items();
    print_exhibits();
  }
  write_results(table, provenance, options);
}

bool is_everything(const std::vector<const Reproduction*>& items) {
  return items.size() == reproductions().size();
}

/// --out, or a folder below results/ that keeps a full run, one item alone and runs of other presets apart.
std::string output_folder(const std::vector<const Reproduction*>& items, const ReproduceOptions& options) {
  if (!options.out.empty()) return options.out;
  std::string name = "reproduce";
  if (!is_everything(items)) name = items.size() == 1 ? items.front()->id : "reproduce-selection";
  return "results/" + name + (options.preset == "quick" ? "" : "-" + options.preset);
}

/// The items as they would be typed.
std::string item_of(const std::vector<const Reproduction*>& items, const std::string& preset) {
  std::string text;
  if (is_everything(items))
    text = "all ";
  else
    for (const Reproduction* item : items) text += std::string(item->id) + " ";
  return text + "--preset " + preset;
}

ResultTable all_rows(const std::vector<FinishedReproduction>& finished) {
  ResultTable table;
  for (const FinishedReproduction& f : finished) {
    for (ResultRow row : f.result.rows.rows()) {
      row.columns.insert(row.columns.begin(), {"item", std::string(f.item->id)});
      table.add(std::move(row));
    }
    table.add({"seconds", f.seconds, "s", {{"item", std::string(f.item->id)}}});
  }
  return table;
}

std::vector<FinishedReproduction> run_items(const std::vector<const Reproduction*>& items,
                                            Laboratory& laboratory, ProgressBar& bar,
                                            const CommonOptions& common) {
  return run_reproductions(items, laboratory, [&](const Reproduction& item, std::size_t index) {
    bar.clear();
    tell(common, fmt::format("[{:2}/{}] {}", index + 1, items.size(), item.title));
    bar.update(static_cast<double>(index) / static_cast<double>(items.size()));
  });
}

void write_everything(const std::vector<FinishedReproduction>& finished, const Laboratory& laboratory,
                      const Provenance& provenance, const fs::path& folder) {
  // Side by side: plots wait for gnuplot.
  parallel_for(static_cast<int>(finished.size()), 1, laboratory.options().threads, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      if (finished[i].failure.empty()) file_reproduction(finished[i], folder);
  });
  write_text_file(folder / "rows.csv", to_csv(all_rows(finished)));
  write_report(assemble_report(finished, laboratory, provenance), folder / "report.html");
}

void run_reproduce(const Invocation& invocation, const ReproduceOptions& options) {
  if (options.list) {
    list(invocation, options.common);
    return;
  }
  const auto items = select_reproductions(options.ids);
  Provenance provenance = begin_run(invocation, options.common);
  provenance.parameters["preset"] = options.preset;
  ProgressBar bar("reproducing");
  Laboratory laboratory({.effort = effort_of(options.preset),
                         .cache = render_cache_folder(options.cache),
                         .seed = options.common.seed,
                         .threads = options.common.threads,
                         .on_view = [&bar](const RenderingTally& tally) {
                           bar.remark(fmt::format("{} views rendered", tally.rendered));
                         }});
  std::vector<FinishedReproduction> finished;
  const std::string out = output_folder(items, options), item = item_of(items, options.preset);
  write_result_folder({out, "reproduce", item, options.force}, provenance, [&](const fs::path& folder) {
    finished = run_items(items, laboratory, bar, options.common);
    bar.clear();
    finish_provenance(provenance);
    write_everything(finished, laboratory, provenance, folder);
  });
  write_results(all_rows(finished), provenance, options.common);
  tell(options.common, fmt::format("done in {}\n{}", format_duration(provenance.duration_s),
                                   fs::absolute(fs::path(out) / "report.html").string()));
  for (const FinishedReproduction& f : finished)
    if (!f.failure.empty()) throw InputError(fmt::format("{} could not be run: {}", f.item->id, f.failure));
}

}  // namespace

void add_reproduce_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ReproduceOptions>();
  app.add_option("ids", options->ids, "What to reproduce, or all (default: all), see --list");
  app.add_flag(
      "--list", options->list,
      "List what can be reproduced, and what became of every figure and table of the papers: recomputed, "
      "re-run, a diagram (with what is measured in its place) or not reproducible");
  app.add_option(
         "-o,--out", options->out,
         "Folder for the report and its figures (default: results/reproduce, for one item results/ID)")
      ->check(not_empty());
  app.add_option("--preset", options->preset,
                 "quick: minutes; paper: the thesis' grids, hours; tiny: a check that everything works")
      ->check(one_of({"tiny", "quick", "paper"}))
      ->capture_default_str();
  app.add_option("--cache", options->cache, "Folder of rendered views (default ~/.cache/plenolab)");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab reproduce\n"
      "          plenolab reproduce altmeier-fig-31 -o results/figure-31");
  app.callback([options, &invocation] { run_reproduce(invocation, *options); });
}

}  // namespace plenolab
