#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/session/trials.h"

namespace plenolab {

/// trials.csv: one row a completed trial (RFC 4180), the interface to `plenolab analyse`:
/// participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,views_reference,
/// views_a,views_b,refused,attempt,paused_s,dropped_frames,session_state
std::string trials_csv(std::span<const TrialRecord> trials);

/// What an export came to.
struct ExportCounts {
  int sessions = 0, done = 0, trials = 0, events = 0;
  std::vector<std::string> left_out;  ///< sessions left out and why
};

/// Writes all sessions of one kind below `sessions` into the folder `out`, which exists:
///   trials.csv, events.csv (every event of every session, in full), study.json,
///   and a BIDS data set (1.8): dataset_description.json, README, participants.tsv and .json, for each
///   participant sub-X/beh/sub-X_task-matching_run-N_beh.tsv and …_events.tsv (N: position of the block),
///   with JSON sidecars.
/// Consent files are not read. Sessions of people and pilots are never put together: `mode` chooses. Declined
/// and excluded sessions give no rows. Sessions in use are left out and named. Throws InputError if there is
/// nothing of that mode, or sessions ran different studies.
ExportCounts export_sessions(const std::filesystem::path& sessions, SessionMode mode,
                             const std::filesystem::path& out);

}  // namespace plenolab
