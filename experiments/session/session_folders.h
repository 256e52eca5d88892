#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/session/store.h"

namespace plenolab {

/// The sessions of a study side by side: their pseudonyms, and who has withdrawn.

/// Folders of all sessions below a data folder but withdrawn ones, sorted by name. Throws InputError if there
/// is no such folder.
std::vector<std::filesystem::path> session_folders(const std::filesystem::path& sessions);

/// "real-001", "pilot-012", "simulated-034".
std::string pseudonym(SessionMode mode, int number);

/// The lowest number after all that were used in this mode, by sessions, consents or withdrawn participants:
/// a pseudonym is never given twice.
int next_number(const std::filesystem::path& sessions, SessionMode mode);

/// Whether withdraw_session was called for this pseudonym.
bool is_withdrawn(const std::filesystem::path& sessions, const std::string& participant);

/// Where a participant's consent is stored.
std::filesystem::path consent_file(const std::filesystem::path& sessions, const std::string& participant);

/// Whether there is a session or a consent under this pseudonym.
bool holds_participant(const std::filesystem::path& sessions, const std::string& participant);

/// What withdraw_session has removed.
struct Withdrawal {
  bool session = false, consent = false;      ///< whether there was one
  std::vector<std::filesystem::path> copies;  ///< folders of other names with the same session: they stay
};

/// Removes a session and its consent and leaves SESSIONS/withdrawn/PSEUDONYM, with nothing in it but the
/// time, so that the pseudonym is not given to anybody else. If it is cut off, the session counts as
/// withdrawn already, and calling it again removes the rest. Throws InputError if there is no such session,
/// the folder holds another participant's, or there is a link, whose target would stay; DatabaseInUse if the
/// session is running.
Withdrawal withdraw_session(const std::filesystem::path& sessions, const std::string& participant);

}  // namespace plenolab
