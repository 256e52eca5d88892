#include "core/base/partial_output.h"

#include <chrono>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "core/base/error.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Which outputs of this process are partial. There is one for the process because a signal is for the
/// process; it is never destroyed because a signal may arrive while static objects are.
struct Registry {
  std::mutex mutex;
  std::set<fs::path> paths;
};

Registry& registry() {
  static auto& registry = *new Registry;
  return registry;
}

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

PartialOutput::PartialOutput(const std::function<fs::path()>& create) {
  const std::lock_guard lock(registry().mutex);
  path_ = create();
  registry().paths.insert(path_);
}

PartialOutput::~PartialOutput() {
  remove_quietly(path_);
  const std::lock_guard lock(registry().mutex);
  registry().paths.erase(path_);
}

void PartialOutput::put_in_place(const std::function<void()>& rename) const {
  const std::lock_guard lock(registry().mutex);
  rename();
}

void write_under_temporary_name(const fs::path& temporary, const fs::path& final_path,
                                const std::function<void(const fs::path&)>& write) {
  try {
    write(temporary);
  } catch (const InputError& error) {
    throw InputError(replaced(error.what(), temporary.string(), final_path.string()));
  }
}

void remove_partial_outputs() {
  // Other threads still write into what is removed here, so it may take a few rounds. The lock is kept for
  // good: nothing new begins and nothing half removed is put in place.
  constexpr int kRounds = 50;
  registry().mutex.lock();
  for (const fs::path& path : registry().paths) {
    std::error_code error;
    for (int round = 0; round < kRounds && fs::exists(fs::symlink_status(path, error)); ++round) {
      remove_quietly(path);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
}

}  // namespace plenolab
