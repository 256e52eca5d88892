#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "analysis/provenance.h"
#include "analysis/result_table.h"
#include "experiments/commands.h"

namespace CLI {
class App;
}

namespace plenolab {

/// Options that every computing command has.
struct CommonOptions {
  std::string json;        ///< file for the results as JSON, "-" = stdout, empty = none
  std::string csv;         ///< file for the results as tidy CSV, "-" = stdout, empty = none
  std::uint64_t seed = 1;  ///< of all randomness
  int threads = 0;         ///< 0 = all cores
};

/// Declares --json, --csv, --seed and --threads.
void add_common_options(CLI::App& app, CommonOptions& options);

/// Whether standard output belongs to a program: JSON or CSV goes there, and nothing else may.
bool output_is_for_programs(const CommonOptions& options);

/// Quantity of a row that says something in words, in its column "note".
inline constexpr const char* kNoteQuantity = "note";

/// Prints the results as a table for people, stages left out and notes as sentences, on stdout (unless JSON
/// goes there) and writes the JSON and CSV that were asked for. Finishes `provenance`.
void emit_results(const ResultTable& results, Provenance& provenance, const CommonOptions& options);

/// Writes the JSON and CSV that were asked for, and nothing for people: for commands that print a table of
/// their own.
void write_results(const ResultTable& results, Provenance& provenance, const CommonOptions& options);

/// Starts the provenance of a command with its common options. Throws UsageError if JSON and CSV both go to
/// standard output.
Provenance begin_run(const Invocation& invocation, const CommonOptions& options);

/// One line on stdout for people, e.g. which file was written; silent when results for programs go to stdout.
void tell(const CommonOptions& options, const std::string& line);

/// Writes `file`'s provenance beside it as FILE.run.json, for results that are single files.
void write_run_json_beside(const std::filesystem::path& file, Provenance& provenance);

/// Folder for rendered views: --cache, else $PLENOLAB_CACHE, else $XDG_CACHE_HOME/plenolab, else
/// ~/.cache/plenolab.
std::filesystem::path render_cache_folder(const std::string& option);

}  // namespace plenolab
