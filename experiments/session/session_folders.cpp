#include "experiments/session/session_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/base/error.h"
#include "experiments/session/sqlite.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kWithdrawnFolder = "withdrawn";

/// What a link points to would stay where it is.
void require_no_links(const fs::path& folder, const fs::path& consent) {
  const auto refuse_link = [](const fs::path& path) {
    if (fs::is_symlink(path))
      throw InputError(
          fmt::format("{} is a link, and what it points to would stay: remove that by hand first, "
                      "then the link",
                      path.string()));
  };
  refuse_link(consent.parent_path());
  refuse_link(consent);
  refuse_link(folder);
  if (!fs::is_directory(folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) refuse_link(entry.path());
}

/// Throws DatabaseInUse if the session is running.
void require_idle(const fs::path& folder) {
  if (!fs::is_regular_file(folder / kDatabaseFile)) return;
  try {
    SqliteDatabase database(folder / kDatabaseFile, SqliteDatabase::Access::kReadWrite);
    database.execute("PRAGMA locking_mode=EXCLUSIVE; BEGIN IMMEDIATE; COMMIT");
  } catch (const DatabaseInUse&) {
    throw;
  } catch (const InputError&) {  // who withdraws is removed even if the file is damaged
  }
}

/// Nobody is removed in place of another: a folder that can be read holds the participant it is named after.
void require_of_participant(const fs::path& folder) {
  std::optional<SessionIdentity> identity;
  try {
    identity = read_session(folder).identity;
  } catch (const DatabaseInUse&) {
    throw;
  } catch (const InputError&) {  // damaged, cut off, or its consent alone is left
  }
  if (identity) require_own_folder(*identity, folder);
}

/// Folders of other names that hold this participant's session.
std::vector<fs::path> copies_of(const fs::path& sessions, const std::string& participant) {
  std::vector<fs::path> copies;
  for (const fs::path& folder : session_folders(sessions)) {
    try {
      if (read_session(folder).identity.participant == participant) copies.push_back(folder);
    } catch (const InputError&) {  // nothing is known of it
    }
  }
  return copies;
}

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

fs::path consent_file(const fs::path& sessions, const std::string& participant) {
  return sessions / "consent" / (participant + ".json");
}

bool holds_participant(const fs::path& sessions, const std::string& participant) {
  const bool pseudonym = participant.find('/') == std::string::npos &&
                         (participant.starts_with("real-") || participant.starts_with("pilot-") ||
                          participant.starts_with("simulated-"));
  return pseudonym &&
         (fs::is_directory(sessions / participant) || fs::exists(consent_file(sessions, participant)));
}

Withdrawal withdraw_session(const fs::path& sessions, const std::string& participant) {
  const fs::path folder = sessions / participant, consent = consent_file(sessions, participant);
  if (!holds_participant(sessions, participant))
    throw InputError(fmt::format("{} holds no session '{}'", sessions.string(), participant));
  require_no_links(folder, consent);
  require_idle(folder);
  require_of_participant(folder);
  create_private_folder(sessions / kWithdrawnFolder);
  if (!is_withdrawn(sessions, participant))
    create_private_file(sessions / kWithdrawnFolder / participant, utc_now() + "\n", Durability::kPowerCut);
  Withdrawal removed;
  try {
    if (fs::is_directory(consent.parent_path())) {
      remove_partial_files(consent);
      removed.consent = fs::remove(consent);
      sync_folder(consent.parent_path());
    }
    removed.session = fs::remove_all(folder) > 0;
  } catch (const fs::filesystem_error& error) {
    throw InputError(fmt::format("{} is not removed wholly: {}", participant, error.what()));
  }
  sync_folder(sessions);
  removed.copies = copies_of(sessions, participant);
  return removed;
}

}  // namespace plenolab
