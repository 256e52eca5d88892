// Figure 5.2 (figure 6 of the paper): choices over images with the critical number.
#include <fmt/format.h>

#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"

namespace plenolab {

ReproductionResult reproduce_study_figure(Laboratory& laboratory);

namespace {

/// Rows whose interval holds the rate.
int rows_that_hold(const Study& study, double rate) {
  int rows = 0;
  for (const StudyRow& row : study.rows) rows += row.rate.low <= rate && rate <= row.rate.high ? 1 : 0;
  return rows;
}

/// Rows whose interval holds both guessing and a rate at which every fifth choice would betray the image.
int rows_that_hold_both(const Study& study, double low, double high) {
  int rows = 0;
  for (const StudyRow& row : study.rows) rows += row.rate.low <= low && high <= row.rate.high ? 1 : 0;
  return rows;
}

}  // namespace

ReproductionResult reproduce_study_figure(Laboratory&) {
  ReproductionResult result;
  const Study study = analyse_counts(published_main_study(), published_options());
  const int guessing = rows_that_hold(study, 0.5), both = rows_that_hold_both(study, 0.3, 0.5);
  result.paper_shows =
      "Figure 5.2 (figure 6 of the paper) draws the counts as bars with a line at 11: where 11 or more "
      "choose IC, participants 'can do no better than a random guess' and 'do not see a difference'.";
  result.ours_shows = fmt::format(
      "The same bars with exact 95 % intervals and a second line at {:g}, where guessing lies: {} of {} "
      "intervals hold guessing, and {} hold both guessing and a rate of 0.3, at which two participants in "
      "five see the difference.",
      0.5 * static_cast<double>(study.rows.front().count.chose_test.trials), guessing, study.rows.size(),
      both);
  result.differs = fmt::format(
      "The line at {} is not where guessing begins: it is where a rate of {:g} is refuted. An interval that "
      "holds 0.5 does not exclude rates at which many see the difference{}.",
      study.rows.front().critical, study.options.p_null,
      both > 0 ? fmt::format(", as {} of them show", both) : "; here none holds 0.3 as well");
  result.add_plot("choices",
                  {study_plot(study, true),
                   "Choices of the reprojected image by 34 participants, with exact 95 % intervals",
                   "Bars for five images on two displays with error bars, and lines at the critical number "
                   "11 and at 17, half of the participants"});
  result.rows.append(study_table(study));
  return result;
}

}  // namespace plenolab
