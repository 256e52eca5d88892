#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/result_table.h"

namespace plenolab {

/// The machine a result was computed on.
struct MachineInfo {
  std::string cpu;        ///< model name
  int cores = 0;          ///< logical cores this process may use
  double memory_gib = 0;  ///< physical memory
  std::string os;         ///< pretty name of the distribution and the kernel's release
};

/// How the program was built.
struct BuildInfo {
  std::string version;   ///< of plenolab
  std::string revision;  ///< `git describe --always --tags` at build time, "unknown" outside git
  bool dirty = false;    ///< built from sources that differ from the revision
  std::string compiler, build_type, flags;
};

/// An input and the hash of its bytes.
struct InputFile {
  std::string path;
  std::string hash;  ///< core/base/content_hash.h
};

/// Named values, in the order in which they were first set.
class ParameterList {
 public:
  /// The value of a name; a new one holds an empty text.
  Cell& operator[](const std::string& name);
  const std::vector<std::pair<std::string, Cell>>& items() const { return items_; }

 private:
  std::vector<std::pair<std::string, Cell>> items_;
};

/// Where a result comes from: what stands in `run.json` beside it and under "run" in JSON output.
struct Provenance {
  std::vector<std::string> command_line;
  std::optional<std::uint64_t> seed;
  ParameterList parameters;
  std::vector<InputFile> inputs;
  std::map<std::string, std::string> libraries;  ///< name → version; callers may add the ones they use
  BuildInfo build;
  MachineInfo machine;
  std::string started_utc;  ///< ISO 8601, e.g. "2024-05-01T12:00:00Z"
  double duration_s = 0;
  double peak_memory_mib = 0;  ///< largest resident set of the process so far
  std::chrono::steady_clock::time_point start;
};

/// Begins a record: fills in time, build, machine and library versions.
Provenance start_provenance(std::vector<std::string> command_line);
/// The same from main's arguments.
Provenance start_provenance(int argc, const char* const* argv);

/// Adds an input: a file's hash, or for a folder the hash over the names and bytes of the regular files
/// directly in it, in order of name. Throws InputError if it cannot be read.
void add_input(Provenance& provenance, const std::filesystem::path& path);

/// Sets duration and peak memory to those up to now.
void finish_provenance(Provenance& provenance);

nlohmann::ordered_json provenance_to_json(const Provenance& provenance);

/// Writes `folder`/run.json.
void write_run_json(const Provenance& provenance, const std::filesystem::path& folder);

MachineInfo machine_info();
BuildInfo build_info();

}  // namespace plenolab
