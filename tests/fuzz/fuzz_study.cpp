#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "analysis/psychophysics/study_table.h"
#include "core/base/error.h"

// What is accepted can be analysed: no number is NaN and every trial that counts is counted.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plenolab;
  try {
    const CsvTable table = parse_csv({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (!holds_trials(table)) {
      study_table(analyse_counts(parse_study_counts(table)));
      return 0;
    }
    const auto trials = parse_study_trials(table);
    std::int64_t counted = 0, judged = 0;
    for (const StudyCount& count : count_choices(trials)) counted += count.chose_test.trials;
    for (const StudyTrial& trial : trials) judged += trial.is_catch ? 0 : 1;
    if (counted != judged) std::abort();
    if (counted > 0) study_table(analyse_trials(trials));
  } catch (const InputError&) {
  }
  return 0;
}
