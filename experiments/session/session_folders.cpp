#include "experiments/session/session_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/error.h"
#include "experiments/session/sqlite.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kWithdrawnFolder = "withdrawn";

}  // namespace

std::vector<fs::path> session_folders(const fs::path& sessions) {
  if (!fs::is_directory(sessions))
    throw InputError(fmt::format("{} is no folder of sessions: it does not exist", sessions.string()));
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(sessions))
    if (fs::is_regular_file(entry.path() / kDatabaseFile) &&
        !is_withdrawn(sessions, entry.path().filename().string()))
      folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::string pseudonym(SessionMode mode, int number) {
  return fmt::format("{}-{:03}", name_of(mode), number);
}

int next_number(const fs::path& sessions, SessionMode mode) {
  const std::string prefix = std::string(name_of(mode)) + "-";
  int last = 0;
  // A consent without a session and a withdrawn session used their number too.
  for (const fs::path& used : {sessions, sessions / "consent", sessions / kWithdrawnFolder}) {
    if (!fs::is_directory(used)) continue;
    for (const auto& entry : fs::directory_iterator(used)) {
      const std::string name = entry.path().filename().string();
      int number = 0;
      if (name.starts_with(prefix) &&
          std::from_chars(name.data() + prefix.size(), name.data() + name.size(), number).ec == std::errc{})
        last = std::max(last, number);
    }
  }
  return last + 1;
}

bool is_withdrawn(const fs::path& sessions, const std::string& participant) {
  return fs::exists(sessions / kWithdrawnFolder / participant);
}

bool holds_participant(const fs::path& sessions, const std::string& participant) {
  const bool pseudonym = participant.find('/') == std::string::npos &&
                         (participant.starts_with("real-") || participant.starts_with("pilot-") ||
                          participant.starts_with("simulated-"));
  return pseudonym && (fs::is_directory(sessions / participant) ||
                       fs::exists(sessions / "consent" / (participant + ".json")));
}

void withdraw_session(const fs::path& sessions, const std::string& participant) {
  const fs::path folder = sessions / participant, consent = sessions / "consent";
  if (!holds_participant(sessions, participant))
    throw InputError(fmt::format("{} holds no session '{}'", sessions.string(), participant));
  if (fs::is_regular_file(folder / kDatabaseFile)) {
    try {
      SqliteDatabase database(folder / kDatabaseFile, SqliteDatabase::Access::kReadWrite);
      database.execute("PRAGMA locking_mode=EXCLUSIVE; BEGIN IMMEDIATE; COMMIT");
    } catch (const DatabaseInUse&) {
      throw;
    } catch (const InputError&) {  // who withdraws is removed even if the file is damaged
    }
  }
  create_private_folder(sessions / kWithdrawnFolder);
  if (!is_withdrawn(sessions, participant))
    create_private_file(sessions / kWithdrawnFolder / participant, utc_now() + "\n", Durability::kPowerCut);
  for (const char* suffix : {".json", ".json.partial"}) fs::remove(consent / (participant + suffix));
  if (fs::is_directory(consent)) sync_folder(consent);
  fs::remove_all(folder);
  sync_folder(sessions);
}

}  // namespace plenolab
