#include "experiments/batch/study_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/batch/item_result.h"
#include "experiments/cli/result_folder.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMark = "batch.json";

void require_batch_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("{} is not a folder: choose another name", folder.string()));
  if (!fs::is_directory(folder, error) || fs::is_empty(folder, error)) return;
  if (!fs::is_directory(folder / kItemsFolder, error) && !fs::exists(folder / kMark, error))
    throw InputError(
        fmt::format("{} exists and holds no batch: choose another name or remove it", folder.string()));
}

/// The path of the study that the folder is of, if that is not this one; else empty.
std::string other_study(const fs::path& folder, const std::string& path, const std::string& hash) {
  std::error_code error;
  if (!fs::exists(folder / kMark, error)) return "";
  try {
    const Json mark = Json::parse(read_text_file(folder / kMark));
    const std::string known = mark.at("study");
    return known == path || mark.at("hash") == hash ? "" : known;
  } catch (const Json::exception&) {
    return "";  // damaged: nobody's
  }
}

}  // namespace

void claim_study_folder(const fs::path& folder, const fs::path& study, bool force) {
  require_batch_folder(folder);
  const std::string path = item_path(study), hash = hash_file(study);
  if (const std::string other = other_study(folder, path, hash); !other.empty() && !force)
    throw InputError(
        fmt::format("{} holds the batch of another study, {}: choose another folder, or give "
                    "--force to replace its tables and report",
                    folder.string(), other));
  // First: another run that starts now must find a batch, not a file half written.
  std::error_code error;
  fs::create_directories(folder / kItemsFolder, error);  // the mark cannot be written if this fails
  const Json mark{{"format", "plenolab-batch-folder"}, {"version", 1}, {"study", path}, {"hash", hash}};
  write_text_file(folder / kMark, mark.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace plenolab
