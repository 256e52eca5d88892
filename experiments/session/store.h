#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "experiments/session/private_files.h"
#include "experiments/session/study.h"

namespace plenolab {

/// Everything that happens in a session, in one SQLite database file for each session:
///
///   SESSIONS/              the data folder of a study
///     real-001/session.db  one folder a session, 0700, files 0600
///     consent/real-001.json  what was signed, apart from all answers (consent.h)
///     withdrawn/real-001   in place of both once the participant has withdrawn: the time, nothing personal
///
/// One file a session, not one for the study: stations can run side by side without sharing a file, a damaged
/// disk block costs one session, a finished one can be copied while the next runs, and a participant who
/// withdraws is removed with one folder (withdraw_session). The session is known by its pseudonym alone.
///
/// The database is append-only: triggers refuse every change and removal, and nothing is stored but events
/// and what the session is (`meta`); trials are derived (trials.h). It is in WAL mode with synchronous=FULL:
/// append() returns when the event is on the disk, so a killed program or a power cut loses nothing that was
/// acknowledged. It is locked as long as it is open: a second program is refused.

/// What a session is; fixed when it is created.
struct SessionIdentity {
  std::string participant;  ///< pseudonym, also the name of the folder: "real-001"
  int number = 1;           ///< sequence number among sessions of this mode, ≥ 1; decides the plan
  SessionMode mode = SessionMode::kPilot;
  std::string study_json;  ///< format_study of the study that is run
  std::string study_hash;
  std::map<std::string, std::string> image_hashes;  ///< of the images that are shown, by file
  std::string created_utc;
  std::string program;  ///< version and revision
};

/// One thing that happened.
struct SessionEvent {
  std::int64_t sequence = 0;  ///< 1, 2, 3 … in the order stored; set by the store
  int run = 1;                ///< 1 when the session is first run, + 1 each time it is resumed
  std::int64_t t_us = 0;      ///< µs on the clock of the run
  std::int64_t t_low_us = 0;  ///< it happened after this (last poll); equal to t_us for flips
  std::string utc;            ///< wall clock when it was stored
  int position = 0;           ///< of the block in the session, 1-based; 0: outside blocks
  int trial = 0;              ///< 1-based in the block; 0: outside trials
  int attempt = 0;            ///< of the trial, 1-based: an interrupted trial is repeated
  std::string block, image;   ///< ids; empty outside
  std::string kind;           ///< "press", "shown" … (README.md lists them)
  std::string what, outcome;
  std::string detail;  ///< JSON or text; may be empty
};

/// There is a session, or the beginning of one, under this pseudonym already.
class SessionExists : public InputError {
 public:
  using InputError::InputError;
};

/// The database of a session, in its folder.
inline constexpr const char* kDatabaseFile = "session.db";

class SessionStore {
 public:
  enum class CutOff { kComplete, kRefuse };
  /// Creates SESSIONS/participant with its database. Throws SessionExists if it holds a session (nothing is
  /// ever overwritten), InputError if the folder cannot be written. A folder whose creation was cut off is
  /// completed, or refused with SessionExists: another station may be about to complete it.
  static SessionStore create(const std::filesystem::path& sessions, const SessionIdentity& identity,
                             Durability durability, CutOff cut_off = CutOff::kComplete);
  /// Opens one to go on. Throws InputError if it is damaged, not a session, not in the folder it was created
  /// in (require_own_folder), or in use by another program.
  static SessionStore open(const std::filesystem::path& folder, Durability durability);

  const SessionIdentity& identity() const { return identity_; }
  const std::filesystem::path& folder() const { return folder_; }
  Durability durability() const { return durability_; }
  /// Stores an event; on return it is on the disk. Sets its sequence number and wall clock. Throws InputError
  /// if the disk is full or fails: everything stored before is still there.
  void append(SessionEvent& event);
  /// All events so far, in order.
  std::vector<SessionEvent> events();
  /// Throws InputError unless `mib` are free on the disk: asked before each trial.
  void require_space(std::uintmax_t mib = 16) const;

 private:
  struct Connection;
  SessionStore(std::filesystem::path folder, Durability durability);

  std::filesystem::path folder_;
  Durability durability_;
  SessionIdentity identity_;
  std::shared_ptr<Connection> connection_;
};

/// Whether a folder holds a session; false also if its creation was cut off before anything happened in it.
/// Throws InputError if a log or a consent shows that something had happened, which is not there.
bool holds_session(const std::filesystem::path& folder);

/// Throws InputError unless the session is the one that its folder is named after: copies and renamed folders
/// would be taken for other participants.
void require_own_folder(const SessionIdentity& identity, const std::filesystem::path& folder);

/// A stored session as it was when it was read.
struct StoredSession {
  SessionIdentity identity;
  std::vector<SessionEvent> events;
};

/// Reads without changing anything in the folder; the log of an interrupted session stays for who resumes it.
/// Throws InputError if the session is damaged, DatabaseInUse (sqlite.h) if it is open in another program.
StoredSession read_session(const std::filesystem::path& folder);

/// Now, as "2026-01-31T12:00:00.123Z".
std::string utc_now();

/// From one time of utc_now() to another, in seconds. Throws InputError if one is none.
double seconds_between(const std::string& from_utc, const std::string& to_utc);

}  // namespace plenolab
