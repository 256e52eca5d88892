#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/session/store.h"

namespace plenolab {

/// How far a session has come.
enum class SessionState { kInterrupted, kDone, kDeclined, kExcluded };

/// "interrupted", "done", "declined", "excluded".
const char* name_of(SessionState state);

/// A completed trial, derived from the events of its last attempt.
struct TrialRecord {
  std::string participant;
  SessionMode mode = SessionMode::kPilot;
  std::string block;
  int position = 0;  ///< of the block in the session, 1-based
  DisplayKind display = DisplayKind::kMonitor;
  std::string order;  ///< name of the block order
  int trial = 0;      ///< 1-based in the block
  std::string image;
  bool catch_trial = false;
  bool test_first = false;  ///< the left trigger showed the test image
  bool chose_test = false;  ///< took the test image for the reference: wrong
  double response_s = 0;    ///< from the first black flip of the trial to the choice, without pauses
  int views_reference = 0, views_a = 0, views_b = 0;  ///< times each was shown; a: left trigger, b: right
  int refused = 0;                                    ///< choices refused
  int attempt = 1;                                    ///< 1 unless the trial was interrupted and repeated
  int run = 1;
  std::int64_t began_us = 0;   ///< on the clock of the run
  std::int64_t paused_us = 0;  ///< pad unplugged, or asked whether to stop
  std::int64_t dropped_frames = 0, longest_frame_us = 0;
  SessionState session_state = SessionState::kInterrupted;  ///< of the whole session
};

/// An answer to a question of a form.
struct SessionAnswer {
  std::string question, answer;
};

/// What the events of a session say.
struct SessionSummary {
  SessionState state = SessionState::kInterrupted;
  bool consented = false;
  int runs = 0;  ///< number of times the program was run on it
  std::vector<SessionAnswer> answers;
  std::vector<TrialRecord> trials;  ///< completed ones, in the order of the plan
  int trials_planned = 0;

  bool completed(int position, int trial) const;
};

/// Derives everything from the events. `study` is the one the session was created with. Choices count as they
/// were stored; the plan and what was on the display only confirm them. Throws InputError where they do not,
/// or a trial is not the planned one: the session is damaged.
SessionSummary summarise(const SessionIdentity& identity, const StudyDefinition& study,
                         std::span<const SessionEvent> events);

/// The study as stored in a session.
StudyDefinition study_of(const SessionIdentity& identity);

}  // namespace plenolab
