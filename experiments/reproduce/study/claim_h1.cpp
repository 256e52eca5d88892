// H-1, sections 4.1.2 and 5: images 1 to 4 pass and image 5 fails on both displays; what that may mean.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/multiplicity.h"
#include "analysis/psychophysics/planning.h"
#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"
#include "experiments/reproduce/tonemap/claim_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_h1(Laboratory& laboratory);

namespace {

const std::vector<std::string> kImages{"images 1 to 5 of the thesis"};
const char* const kExact = "exact: follows from the printed counts and the stated test";

Interval exact(double value) {
  return {value, value, value};
}

void add_verdicts(ReproductionResult& result, const Study& study) {
  const VerdictCount count = count_verdicts(study);
  add_claim(result,
            {"H-1a", "Hansen & Klein 2016, table 5.1",
             "Images 1 to 4 pass and image 5 fails, on the light-field display and on the monitor."},
            {exact(count.disagreeing), Comparison::kBelow, 0.5, "verdicts_that_differ", "1", kExact, kImages,
             fmt::format("Verdicts recomputed from the counts that differ from the printed ones, of {}.",
                         count.rows)});
}

void add_errors(ReproductionResult& result, const Study& study) {
  const StudyRow& row = study.rows.front();
  const double one = upper_tail(row.critical, row.count.chose_test.trials, study.options.p_null);
  add_claim(
      result,
      {"H-1b", "Hansen & Klein 2016, section 4.1.2",
       "The probability of rejecting the null hypothesis wrongly is below 5 %."},
      {exact(one), Comparison::kBelow, study.options.alpha, "false_pass_probability", "1", kExact, kImages,
       fmt::format("Of one test, at a rate of {:g} and {} participants.", study.options.p_null,
                   row.count.chose_test.trials)});
  add_claim(
      result,
      {"H-1c", "Hansen & Klein 2016, section 4.1.2, read for the ten tests of table 5.1 together",
       "The probability of rejecting a null hypothesis wrongly in the study is below 5 %."},
      {exact(study.any_false_pass), Comparison::kBelow, study.options.alpha, "any_false_pass_probability",
       "1", "exact if the tests are independent", kImages,
       fmt::format(
           "Of at least one of {} tests if all rates are {:g}. The same participants judged all images: "
           "whatever the dependence of the tests, it lies between {:.3f} and {:.3f}. After Holm's "
           "correction, which allows for any dependence, these passes are taken back: {}.",
           study.rows.size(), study.options.p_null, one,
           std::min(1.0, one * static_cast<double>(study.rows.size())), taken_back_by_holm(study))});
}

void add_correspondence(ReproductionResult& result) {
  const std::int64_t critical = critical_number(kPublishedTrials, kPublishedNullRate, kPublishedAlpha);
  // The rate that 25 of 100 just refute: the lower end of the one-sided exact interval.
  const double refuted = clopper_pearson({kPublishedWrong, kPublishedTrials}, 1 - 2 * kPublishedAlpha).low;
  result.rows.add({"critical_number", static_cast<double>(critical), "1", {{"trials", 100LL}}});
  result.rows.add({"rate_refuted_by_25_of_100", refuted, "1", {}});
  add_claim(
      result,
      {"H-1d", "Hansen & Klein 2016, section 4.1.2",
       "Refuting a rate of 19 % corresponds to 25 wrong choices in 100 trials."},
      {exact(static_cast<double>(critical)),
       Comparison::kBelow,
       kPublishedWrong + 0.5,
       "critical_number",
       "1",
       kExact,
       {"100 trials"},
       fmt::format("Wrong choices that 100 trials need: {}. 25 of 100 have p = {:.4f} and refute rates up "
                   "to {:.4f} only; with 34 and 40 trials it takes {} and {}.",
                   critical, upper_tail(kPublishedWrong, kPublishedTrials, kPublishedNullRate), refuted,
                   critical_number(34, kPublishedNullRate, kPublishedAlpha),
                   critical_number(40, kPublishedNullRate, kPublishedAlpha))});
}

/// The interval of a row such that those of all `rows` hold together with 95 % at least (Bonferroni).
Interval simultaneous(const StudyRow& row, int rows) {
  return clopper_pearson(row.count.chose_test, 1 - 0.05 / rows);
}

void add_indistinguishable(ReproductionResult& result, const Study& study) {
  const StudyRow* lowest = nullptr;
  for (const StudyRow& row : study.rows)
    if (row.passed && (lowest == nullptr || row.rate.estimate < lowest->rate.estimate)) lowest = &row;
  const VerdictCount count = count_verdicts(study);
  const EquivalenceOptions& options = study.options.equivalence;
  if (lowest == nullptr) return;
  add_claim(
      result,
      {"H-1e", "Hansen & Klein 2016, table 5.1 and section 6.1",
       "Participants were not able to notice a difference in the images that passed."},
      {simultaneous(*lowest, count.passed), Comparison::kAbove, options.low(), "lowest_rate_of_passed", "1",
       fmt::format("95 % for {} images together (Clopper & Pearson, Bonferroni)", count.passed), kImages,
       fmt::format(
           "{} on {} has the lowest rate of those that passed; without any visible difference it would be "
           "0.5, and {:g} is taken for near enough. Equivalence is shown for {} of {} passes: {}. {} "
           "participants would do, with a power of 0.8.",
           lowest->count.image, lowest->count.display, options.low(), count.equivalent, count.passed,
           equivalence_text(*lowest, options), plan_equivalence(options).stable)});
}

void add_noticed(ReproductionResult& result, const Study& study) {
  const StudyRow* highest = nullptr;
  for (const StudyRow& row : study.rows)
    if (row.count.image == "Image 5" && (highest == nullptr || row.rate.estimate > highest->rate.estimate))
      highest = &row;
  if (highest == nullptr) return;
  add_claim(
      result,
      {"H-1f", "Hansen & Klein 2016, chapter 5",
       "Participants are able to notice the difference in image 5."},
      {simultaneous(*highest, 2),
       Comparison::kBelow,
       0.5,
       "rate_of_image_5",
       "1",
       "95 % for both displays together (Clopper & Pearson, Bonferroni)",
       {"image 5 of the thesis"},
       fmt::format("Larger rate of the two displays ({}): below 0.5 participants do better than guessing.",
                   highest->count.display)});
}

}  // namespace

ReproductionResult reproduce_claim_h1(Laboratory&) {
  ReproductionResult result;
  const Study study = analyse_counts(published_main_study(), published_options());
  result.paper_shows =
      "A test is passed if the rate of wrong choices is shown to exceed 19 % (p < 0.05), which is said to "
      "correspond to 25 wrong of 100; with 34 participants 11 are needed, images 1 to 4 pass and image 5 "
      "fails on both displays, so participants are said not to notice a difference in images 1 to 4.";
  const VerdictCount count = count_verdicts(study);
  result.ours_shows = fmt::format(
      "Of {} recomputed verdicts {} differ from the printed ones. One test errs with probability {:.4f}, the "
      "ten together with {:.3f} if they are independent. 100 trials need {} wrong choices, not 25. Of {} "
      "passes {} outlive Holm's correction, and {} show equivalence with guessing.",
      count.rows, count.disagreeing,
      upper_tail(study.rows.front().critical, study.rows.front().count.chose_test.trials,
                 study.options.p_null),
      study.any_false_pass, critical_number(kPublishedTrials, kPublishedNullRate, kPublishedAlpha),
      count.passed, count.passed_after_holm, count.equivalent);
  add_verdicts(result, study);
  add_errors(result, study);
  add_correspondence(result);
  add_indistinguishable(result, study);
  add_noticed(result, study);
  result.rows.append(study_table(study));
  add_meaning_of_passing(result, study);
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
