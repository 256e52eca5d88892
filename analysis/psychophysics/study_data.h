#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/psychophysics/csv.h"
#include "analysis/psychophysics/proportion.h"

namespace plenolab {

/// What comes in from sessions: single trials, or counts of them.

/// One completed trial of a delayed matching-to-sample session: a row of trials.csv.
struct StudyTrial {
  std::string participant;  ///< pseudonym
  std::string mode;         ///< "real", "pilot" or "simulated"
  std::string block;
  int position = 1;     ///< of the block in the session, 1-based
  std::string display;  ///< e.g. "light-field", "monitor"
  std::string order;    ///< name of the block order
  int trial = 1;        ///< within the block, 1-based
  std::string image;
  bool is_catch = false;    ///< the test image is plainly different
  bool test_first = false;  ///< the left trigger shows the test image, not the copy of the reference
  bool chose_test = false;  ///< took the test image for the reference: this is counted
  double response_s = 0;
  int views_reference = 0, views_a = 0, views_b = 0;
  int refused = 0;  ///< refused choices

  /// Whether the image under the left trigger was chosen.
  bool chose_left() const { return test_first == chose_test; }
};

/// How often the test image was taken for the reference, for one image on one display.
struct StudyCount {
  std::string display, image;
  Proportion chose_test;
  std::int64_t participants = 0;  ///< different ones among the trials; 0 = not known
  std::string printed_verdict;    ///< of a published table, e.g. "PASSED"; may be empty
};

/// Which participants count.
enum class TrialMode { kReal, kPilot, kSimulated, kAll };

/// Whether the header is that of trials.csv (it has the column chose_test) rather than of counts.
bool holds_trials(const CsvTable& table);

/// Rows of trials.csv: participant, mode, block, position, display, order, trial, image, catch, test_first,
/// chose_test, response_s, views_reference, views_a, views_b, refused; further columns are ignored. Throws
/// InputError with the line for a field out of range or a trial that a participant has twice.
std::vector<StudyTrial> parse_study_trials(const CsvTable& table);

/// Rows display, image, n, k and, optionally, verdict ("PASSED" or "FAILED" as printed). Throws InputError
/// with the line for k > n, or an image that a display has twice.
std::vector<StudyCount> parse_study_counts(const CsvTable& table);

/// Those of one mode. Throws InputError, with the modes there are, if none is left.
std::vector<StudyTrial> trials_of_mode(const std::vector<StudyTrial>& trials, TrialMode mode);

/// Counts by display and image, catch trials left out, sorted by these names with numbers by value
/// ("image 2" before "image 10"): the order in which somebody saw them is drawn anew for each participant.
std::vector<StudyCount> count_choices(const std::vector<StudyTrial>& trials);

}  // namespace plenolab
