#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/session/trials.h"

namespace plenolab {

/// trials.csv: one row a completed trial (RFC 4180), the interface to `plenolab analyse`:
/// participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,views_reference,
/// views_a,views_b,refused,attempt,paused_s,dropped_frames,session_state
std::string trials_csv(std::span<const TrialRecord> trials);

struct ExportOptions {
  bool leave_out_damaged = false;  ///< go on without sessions that cannot be read
  bool wall_clock = false;         ///< events.csv tells date and time, by which people may be recognised
};

/// A session that gives no rows.
struct LeftOutSession {
  std::string session;  ///< its pseudonym, or the name of its folder
  std::string
      reason;  ///< "declined", "excluded", "no consent", "in use", "damaged", "cut off while it was created"
};

/// What an export came to.
struct ExportCounts {
  int sessions = 0, done = 0, trials = 0, events = 0;
  std::vector<LeftOutSession> left_out;
  std::map<std::string, int> orders;  ///< sessions that reached trials, by order of blocks
};

/// Writes all sessions of one kind below `sessions` into the folder `out`, which exists, readable by its
/// owner alone:
///   trials.csv, events.csv (every event of every session, in full), left_out.csv (session,reason),
///   study.json, and a BIDS data set (1.8): dataset_description.json, README, participants.tsv and .json, for
///   each participant sub-X/beh/sub-X_task-matching_run-N_beh.tsv and …_events.tsv (N: position of the
///   block), with JSON sidecars; .bidsignore names what is not BIDS.
/// Consent files are not read. Sessions of people and pilots are never put together: `mode` chooses. Declined
/// and excluded sessions give no rows, nor do those that ended before consent was given, with what was
/// answered before; sessions in use are left out. Throws InputError if a session is damaged (unless the
/// options say otherwise), a folder was copied or renamed, sessions ran different studies, or nothing is left
/// to export.
ExportCounts export_sessions(const std::filesystem::path& sessions, SessionMode mode,
                             const std::filesystem::path& out, const ExportOptions& options = {});

}  // namespace plenolab
