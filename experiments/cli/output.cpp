#include "experiments/cli/output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

constexpr const char* kStageLeftOut = "stage_left_out";
constexpr auto kReplaceWrongUtf8 = nlohmann::ordered_json::error_handler_t::replace;

std::string text_of(const ResultRow& row, const std::string& column) {
  for (const auto& [name, cell] : row.columns)
    if (name == column) return std::get<std::string>(cell);
  return "";
}

void print_for_people(const ResultTable& results) {
  ResultTable numbers;
  for (const ResultRow& row : results.rows())
    if (row.quantity != kStageLeftOut && row.quantity != kNoteQuantity) numbers.add(row);
  fmt::print("{}", to_text(numbers));
  for (const ResultRow& row : results.rows())
    if (row.quantity == kStageLeftOut)
      fmt::print("left out: {} ({})\n", text_of(row, "stage"), text_of(row, "reason"));
    else if (row.quantity == kNoteQuantity)
      fmt::print("note: {}\n", text_of(row, "note"));
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
  app.add_option("--json", options.json, "Write results as JSON to this file ('-' = standard output)")
      ->check(not_empty());
  app.add_option("--csv", options.csv, "Write results as tidy CSV to this file ('-' = standard output)")
      ->check(not_empty());
  app.add_option("--seed", options.seed, "Seed of all randomness")
      ->capture_default_str()
      ->check(seed_number());
  app.add_option("--threads", options.threads, "Threads, 0 = all cores")
      ->capture_default_str()
      ->check(whole_number(0, 1024));
}

Provenance begin_run(const Invocation& invocation, const CommonOptions& options) {
  if (options.json == "-" && options.csv == "-")
    throw UsageError("--json - and --csv - cannot both have standard output: give one of them a file");
  Provenance provenance = start_provenance(invocation.arguments);
  provenance.seed = options.seed;
  provenance.parameters["threads"] = options.threads;
  return provenance;
}

bool output_is_for_programs(const CommonOptions& options) {
  return options.json == "-" || options.csv == "-";
}

void write_results(const ResultTable& results, Provenance& provenance, const CommonOptions& options) {
  finish_provenance(provenance);
  if (!options.json.empty()) {
    const std::string json = results_to_json_text(provenance_to_json(provenance), results);
    if (options.json == "-")
      fmt::print("{}", json);
    else
      write_text_file(options.json, json);
  }
  if (options.csv == "-")
    fmt::print("{}", to_csv(results));
  else if (!options.csv.empty())
    write_text_file(options.csv, to_csv(results));
}

void emit_results(const ResultTable& results, Provenance& provenance, const CommonOptions& options) {
  if (!output_is_for_programs(options)) print_for_people(results);
  write_results(results, provenance, options);
}

void tell(const CommonOptions& options, const std::string& line) {
  if (output_is_for_programs(options)) return;
  fmt::print("{}\n", line);
  std::fflush(stdout);  // seen at once also where output is a file or pipe
}

void write_run_json_beside(const std::filesystem::path& file, Provenance& provenance) {
  finish_provenance(provenance);
  write_text_file(file.string() + ".run.json",
                  provenance_to_json(provenance).dump(2, ' ', false, kReplaceWrongUtf8) + "\n");
}

std::filesystem::path render_cache_folder(const std::string& option) {
  if (!option.empty()) return option;
  const auto variable = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value ? value : "";
  };
  if (const std::string cache = variable("PLENOLAB_CACHE"); !cache.empty()) return cache;
  if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty())
    return std::filesystem::path(xdg) / "plenolab";
  if (const std::string home = variable("HOME"); !home.empty())
    return std::filesystem::path(home) / ".cache" / "plenolab";
  throw InputError("no folder for rendered views: give --cache or set HOME");
}

}  // namespace plenolab
