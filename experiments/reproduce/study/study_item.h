#pragma once

#include <string>

#include "analysis/psychophysics/study_table.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// What the items on studies share.

/// Options of the published test.
StudyOptions published_options();

/// Adds the study's rows, two tables for readers and the sentences that say what passing may mean.
void add_study(ReproductionResult& result, const Study& study, const std::string& caption);
/// Those sentences: power, false passes, equivalence.
void add_meaning_of_passing(ReproductionResult& result, const Study& study);

/// How the recomputed verdicts stand to the printed ones, and what of them outlives closer reading.
struct VerdictCount {
  int rows = 0, passed = 0, disagreeing = 0;
  int passed_after_holm = 0;  ///< passed rows whose Holm p is below alpha
  int equivalent = 0;         ///< passed rows for which equivalence is shown
};
VerdictCount count_verdicts(const Study& study);

/// "Image 1 on light-field (p = 0.0188, Holm 0.0752) and …": passed rows that Holm's correction takes back.
std::string taken_back_by_holm(const Study& study);

/// "1 row" or "3 rows".
std::string plural(int count, const std::string& noun);

}  // namespace plenolab
