#include "experiments/reproduce/study/study_item.h"

#include <fmt/format.h>

#include "experiments/reproduce/study/published.h"

namespace plenolab {

namespace {

bool disagrees(const StudyRow& row) {
  return !row.count.printed_verdict.empty() && (row.count.printed_verdict == "PASSED") != row.passed;
}

ReportTable count_table(const Study& study, const std::string& caption) {
  ReportTable table{caption,
                    {"display", "image", "chose IC", "share", "from", "to", "to pass", "verdict", "printed"},
                    {},
                    3};
  for (const StudyRow& row : study.rows)
    table.rows.push_back({row.count.display, row.count.image,
                          static_cast<long long>(row.count.chose_test.hits), row.rate.estimate, row.rate.low,
                          row.rate.high, static_cast<long long>(row.critical), verdict_word(row),
                          row.count.printed_verdict});
  return table;
}

ReportTable test_table(const Study& study) {
  ReportTable table{fmt::format("Tests of a rate of {:g} at most: p by itself, adjusted for {} tests by Holm "
                                "and Benjamini-Hochberg, posterior probability that the rate is larger "
                                "(uniform prior); test of equivalence with guessing (TOST)",
                                study.options.p_null, study.rows.size()),
                    {"display", "image", "p", "Holm", "BH", "posterior", "TOST p"},
                    {},
                    3};
  for (const StudyRow& row : study.rows)
    table.rows.push_back({row.count.display, row.count.image, row.p_value, row.p_holm, row.p_bh,
                          row.posterior_above_null, row.equivalence_p});
  return table;
}

std::string power_words(const Study& study) {
  const StudyRow& row = study.rows.front();
  std::string text;
  for (std::size_t i = 0; i < row.power.size(); ++i)
    text += fmt::format("{}{:.3f} if its true rate is {:g}", i > 0 ? ", " : "", row.power[i],
                        study.options.alternatives[i]);
  return text;
}

std::string region_words(const StudyRow& row) {
  if (row.equivalence.empty())
    return fmt::format("no count of {} could show it", row.count.chose_test.trials);
  if (row.equivalence.low == row.equivalence.high)
    return fmt::format("shown by a count of {} alone", row.equivalence.low);
  return fmt::format("shown by counts from {} to {}", row.equivalence.low, row.equivalence.high);
}

}  // namespace

StudyOptions published_options() {
  StudyOptions options;
  options.p_null = kPublishedNullRate;
  options.alpha = kPublishedAlpha;
  return options;
}

void add_study(ReproductionResult& result, const Study& study, const std::string& caption) {
  result.rows.append(study_table(study));
  result.add_table(count_table(study, caption + "; share with exact 95 % interval, count to reach"));
  result.add_table(test_table(study));
  add_meaning_of_passing(result, study);
}

void add_meaning_of_passing(ReproductionResult& result, const Study& study) {
  const EquivalenceOptions& equivalence = study.options.equivalence;
  const StudyRow& row = study.rows.front();
  result.blocks.emplace_back(Paragraph{fmt::format(
      "Passing means that a rate of {:g} is refuted, and no more: an image passes with probability {}. If "
      "all true rates were {:g}, at least one of the {} rows would pass with probability {:.3f}. Equivalence "
      "with guessing (rate within {:g} ± {:g}): {}.",
      study.options.p_null, power_words(study), study.options.p_null, study.rows.size(), study.any_false_pass,
      equivalence.centre, equivalence.margin, region_words(row))});
}

VerdictCount count_verdicts(const Study& study) {
  VerdictCount count;
  for (const StudyRow& row : study.rows) {
    ++count.rows;
    count.disagreeing += disagrees(row) ? 1 : 0;
    if (!row.passed) continue;
    ++count.passed;
    count.passed_after_holm += row.p_holm < study.options.alpha ? 1 : 0;
    count.equivalent += row.equivalent() ? 1 : 0;
  }
  return count;
}

std::string taken_back_by_holm(const Study& study) {
  std::string text;
  for (const StudyRow& row : study.rows)
    if (row.passed && row.p_holm >= study.options.alpha)
      text += fmt::format("{}{} on {} (p = {:.4f}, Holm {:.3f})", text.empty() ? "" : ", ", row.count.image,
                          row.count.display, row.p_value, row.p_holm);
  return text.empty() ? "none" : text;
}

std::string plural(int count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace plenolab
