#pragma once

#include <filesystem>
#include <span>

#include "experiments/session/trials.h"

namespace plenolab {

/// A session as it is exported.
struct ExportedSession {
  StoredSession stored;
  StudyDefinition study;
  SessionSummary summary;
};

/// Writes the Brain Imaging Data Structure (bids.neuroimaging.io, 1.8.0, behavioural data without imaging) of
/// sessions of one study: dataset_description.json, README, participants.tsv/.json, task-matching_beh.json
/// and _events.json, and for each participant and block sub-X/beh/sub-X_task-matching_run-N_beh.tsv and
/// _events.tsv. Labels hold letters and digits alone: real-001 becomes sub-real001. Times are seconds from
/// the first event of the block in each run of the program. There must be one session.
void write_bids(std::span<const ExportedSession> sessions, const std::filesystem::path& out);

}  // namespace plenolab
