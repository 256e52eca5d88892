// Table 5.1 (chapter 5) and the table of appendix E: choices of the reprojected image, recomputed from the
// printed counts.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/psychophysics/binomial.h"
#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"

namespace plenolab {

ReproductionResult reproduce_study_table(Laboratory& laboratory);
ReproductionResult reproduce_initial_study_table(Laboratory& laboratory);

namespace {

std::string verdict_words(const VerdictCount& count) {
  return count.disagreeing == 0 ? "all verdicts agree with the printed ones"
                                : plural(count.disagreeing, "verdict") + " contradict the printed ones";
}

/// Smallest and largest end of the intervals of the rows that pass.
Interval ends_of_passed(const Study& study) {
  Interval ends{0, 1, 0};
  for (const StudyRow& row : study.rows)
    if (row.passed)
      ends.low = std::min(ends.low, row.rate.low), ends.high = std::max(ends.high, row.rate.high);
  return ends;
}

std::string recomputed(const Study& study, int printed_critical) {
  const VerdictCount count = count_verdicts(study);
  const StudyRow& row = study.rows.front();
  const Interval ends = ends_of_passed(study);
  return fmt::format(
      "From the printed counts: the critical number is {} (printed: {}), with P(X ≥ {}) = {:.5f} at a rate "
      "of {:g}; {} of {} rows pass, and {}. Over the rows that pass, the exact 95 % intervals reach from "
      "{:.2f} to {:.2f}; {} of them stay below p = {:g} after Holm's correction over {} tests, and "
      "equivalence with guessing is shown for {} (each test by itself).",
      row.critical, printed_critical, row.critical,
      upper_tail(row.critical, row.count.chose_test.trials, study.options.p_null), study.options.p_null,
      count.passed, count.rows, verdict_words(count), ends.low, ends.high, count.passed_after_holm,
      study.options.alpha, count.rows, count.equivalent);
}

std::string difference(const Study& study, int printed_critical) {
  const VerdictCount count = count_verdicts(study);
  const bool same = count.disagreeing == 0 && study.rows.front().critical == printed_critical;
  std::string text = same ? "The numbers are the printed ones; what they mean is not."
                          : "The recomputed numbers are not the printed ones.";
  text += fmt::format(" Holm's correction takes back: {}.", taken_back_by_holm(study));
  if (count.equivalent < count.passed)
    text += fmt::format(
        " For {} of {} passes the counts do not show that participants only guessed: a pass says that more "
        "than {:g} of the choices are wrong, and half guessers among observers who see every difference "
        "already reach 0.25.",
        count.passed - count.equivalent, count.passed, study.options.p_null);
  return text;
}

}  // namespace

ReproductionResult reproduce_study_table(Laboratory&) {
  ReproductionResult result;
  const Study study = analyse_counts(published_main_study(), published_options());
  result.paper_shows =
      "Table 5.1: of 34 participants 12, 21, 16, 15 and 6 took the reprojected image for the reference on "
      "the light-field display, 19, 18, 11, 16 and 6 on a monitor; with a critical number of 11, images 1 to "
      "4 passed and image 5 failed on both, and participants are said not to notice a difference where they "
      "passed.";
  result.ours_shows = recomputed(study, kPublishedCritical34);
  result.differs = difference(study, kPublishedCritical34) +
                   " The light-field display always came first, so display and order cannot be told apart.";
  add_study(result, study, "Choices of the reprojected image (IC), 34 participants");
  const VerdictCount count = count_verdicts(study);
  result.key_figures.push_back({"Study of the thesis: images that pass", std::to_string(count.passed), "",
                                fmt::format("of {}; {} after Holm's correction, {} shown to be equivalent",
                                            count.rows, count.passed_after_holm, count.equivalent)});
  return result;
}

ReproductionResult reproduce_initial_study_table(Laboratory&) {
  ReproductionResult result;
  const Study study = analyse_counts(published_initial_study(), published_options());
  result.paper_shows =
      "Appendix E: an initial experiment with 40 participants, who could not return to the reference; holes "
      "were black and nothing was supersampled. With a critical number of 13, image 4 on the monitor and "
      "image 5 on both displays failed.";
  result.ours_shows = recomputed(study, kPublishedCritical40);
  result.differs = difference(study, kPublishedCritical40) +
                   " Since the reference could not be seen again, a wrong choice may be one of memory.";
  add_study(result, study, "Choices of the reprojected image (IC), 40 participants, initial experiment");
  result.add_plot("choices",
                  {study_plot(study, true),
                   "Choices of the reprojected image in the initial experiment, with exact 95 % intervals",
                   "Bars for five images on two displays with error bars, and lines at the critical number "
                   "and at half of the participants"});
  return result;
}

}  // namespace plenolab
