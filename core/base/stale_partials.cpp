#include "core/base/stale_partials.h"

#include <regex>
#include <vector>

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// What temporary_name in file.cpp makes: .STEM.PROCESS-NUMBER.partial.EXTENSION
bool is_temporary_name(const std::string& name) {
  static const std::regex pattern(R"(\..+\.[0-9]+-[0-9]+\.partial(\.[^.]*)?)");
  return std::regex_match(name, pattern);
}

bool is_stale(const fs::directory_entry& entry, std::chrono::seconds age) {
  std::error_code error;
  if (!is_temporary_name(entry.path().filename().string()) || entry.is_symlink(error)) return false;
  if (!entry.is_regular_file(error)) return false;
  const fs::file_time_type written = entry.last_write_time(error);
  return !error && fs::file_time_type::clock::now() - written > age;
}

}  // namespace

int remove_stale_partials(const fs::path& folder, std::chrono::seconds age) {
  std::error_code error;
  std::vector<fs::path> stale;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_stale(*entry, age)) stale.push_back(entry->path());
  int removed = 0;
  for (const fs::path& file : stale) removed += fs::remove(file, error) ? 1 : 0;
  return removed;
}

}  // namespace plenolab
