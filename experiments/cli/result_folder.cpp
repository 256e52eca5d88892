#include "experiments/cli/result_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lightfield/new_folder.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kRunFile = "run.json";

/// What run.json says about the folder it lies in.
struct Manifest {
  std::string command, item;
  std::vector<std::string> files;  ///< relative names of all files beside run.json, sorted
};

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory() || entry.is_symlink())
      files.push_back(entry.path().lexically_relative(folder).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<Manifest> read_manifest(const fs::path& folder) {
  const fs::path file = folder / kRunFile;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  try {
    const auto result = nlohmann::json::parse(read_text_file(file)).at("result");
    return Manifest{result.at("command"), result.at("item"), result.at("files")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

/// The first file that is not the run's own; empty if there is none.
std::string foreign_file(const fs::path& folder, const Manifest& manifest) {
  for (const std::string& file : files_below(folder))
    if (file != kRunFile && !std::binary_search(manifest.files.begin(), manifest.files.end(), file))
      return file;
  return "";
}

/// Applies the rule.
ExistingFolder decide(const ResultFolder& folder) {
  std::error_code error;
  if (!fs::is_directory(folder.path, error) || fs::is_empty(folder.path, error))
    return ExistingFolder::kRefuse;
  const auto manifest = read_manifest(folder.path);
  if (!manifest)
    throw InputError(fmt::format(
        "{} exists and is no result of this program: choose another name or remove it", folder.path));
  if (const std::string file = foreign_file(folder.path, *manifest); !file.empty())
    throw InputError(fmt::format(
        "{} holds {}, which plenolab did not write: move it away or choose another name", folder.path, file));
  if (!folder.force && (manifest->command != folder.command || manifest->item != folder.item))
    throw InputError(
        fmt::format("{} holds the result of 'plenolab {} {}': choose another name, or give --force "
                    "to replace it",
                    folder.path, manifest->command, manifest->item));
  return ExistingFolder::kReplace;
}

void write_run_file(const ResultFolder& folder, const Provenance& provenance, const fs::path& temporary) {
  nlohmann::ordered_json run = provenance_to_json(provenance);
  run["result"] = {{"command", folder.command}, {"item", folder.item}, {"files", files_below(temporary)}};
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_text_file(temporary / kRunFile, run.dump(2, ' ', false, replace) + "\n");
}

}  // namespace

void add_force_option(CLI::App& app, bool& force) {
  app.add_flag("--force", force,
               "Replace the output folder also if it holds another result of plenolab (never other files)");
}

void require_keeps_inputs(const Provenance& provenance, const fs::path& out) {
  std::error_code error;
  if (!fs::exists(out, error)) return;
  for (const InputFile& input : provenance.inputs)
    for (fs::path path = item_path(input.path); path.has_relative_path(); path = path.parent_path())
      if (fs::equivalent(path, out, error))
        throw UsageError(
            fmt::format("-o {} would replace the input {}: choose another name", out.string(), input.path));
}

void write_result_folder(const ResultFolder& folder, Provenance& provenance,
                         const std::function<void(const fs::path&)>& write) {
  require_keeps_inputs(provenance, folder.path);
  write_folder_atomically(
      folder.path,
      [&](const fs::path& temporary) {
        write(temporary);
        finish_provenance(provenance);
        write_run_file(folder, provenance, temporary);
        if (folder.for_owner_alone)
          fs::permissions(temporary / kRunFile, fs::perms::owner_read | fs::perms::owner_write);
      },
      decide(folder));
}

std::string item_path(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path.string() : canonical.string();
}

}  // namespace plenolab
