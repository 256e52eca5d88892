#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "analysis/provenance.h"

namespace CLI {
class App;
}

namespace plenolab {

/// A folder that a command leaves its result in.
struct ResultFolder {
  std::string path;
  std::string command;           ///< e.g. "render"
  std::string item;              ///< what it was run on, as it would be typed: "cellar --preset quick"
  bool force = false;            ///< --force
  bool for_owner_alone = false;  ///< nobody else may read run.json, as `write` has to do with other files
};

/// Declares --force.
void add_force_option(CLI::App& app, bool& force);

/// Writes a result folder with its run.json, whole or not at all. One rule for all commands decides about a
/// folder that exists and is not empty:
///   - it is replaced if plenolab wrote it by the same command on the same item (its run.json says so);
///   - with --force also if by another command or on another item;
///   - never if it holds a file that plenolab did not write there.
/// Throws InputError before `write` is called if the rule forbids it, saying why and what to do; UsageError
/// if an input lies there. `write` is called with a temporary folder; `provenance` is finished when it
/// returns.
void write_result_folder(const ResultFolder& folder, Provenance& provenance,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// Throws UsageError if a result at `out` would replace an input of this run (add_input), or a folder that
/// holds one.
void require_keeps_inputs(const Provenance& provenance, const std::filesystem::path& out);

/// How a file or folder given as input is named in an item: without detours, from the root.
std::string item_path(const std::filesystem::path& path);

}  // namespace plenolab
