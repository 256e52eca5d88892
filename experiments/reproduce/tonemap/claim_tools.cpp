#include "experiments/reproduce/tonemap/claim_tools.h"

#include <fmt/format.h>

namespace plenolab {

namespace {

std::string past_tense(Outcome outcome) {
  switch (outcome) {
    case Outcome::kConfirmed:
      return "our measurement agrees";
    case Outcome::kRefuted:
      return "our measurement says otherwise";
    case Outcome::kUndecided:
      return "our measurement does not decide it";
  }
  return "";
}

}  // namespace

void add_measured(ReproductionResult& result, const std::string& caption, const std::string& quantity,
                  const std::string& unit, const std::vector<MeasuredNumber>& numbers) {
  ReportTable table{caption, {"what", fmt::format("{} [{}]", quantity, unit), "from", "to"}, {}, 3};
  for (const MeasuredNumber& number : numbers) {
    if (!number.interval) {
      table.rows.push_back({number.what, std::string("not measurable"), std::string(), std::string()});
      continue;
    }
    const Interval& i = *number.interval;
    table.rows.push_back({number.what, i.estimate, i.low, i.high});
    const Columns columns{{"what", number.what}};
    result.rows.add({quantity, i.estimate, unit, columns});
    result.rows.add({quantity + "_low", i.low, unit, columns});
    result.rows.add({quantity + "_high", i.high, unit, columns});
  }
  result.add_table(std::move(table));
}

void add_claim(ReproductionResult& result, Claim claim, const Decision& d) {
  LedgerEntry entry{std::move(claim), {}};
  if (d.interval) {
    entry.verdict = decide_claim(*d.interval, d.comparison, d.threshold, d.quantity, d.unit, d.uncertainty);
    entry.verdict.explanation = d.explanation;
  } else {
    entry.verdict = undecidable("The run has too few views or motions for an interval. " + d.explanation);
  }
  entry.verdict.scenes = d.scenes;
  add_ledger_rows(result.rows, {&entry, 1});
  result.ledger.push_back(std::move(entry));
}

std::string outcome_words(const ReproductionResult& result) {
  std::string text;
  for (const LedgerEntry& entry : result.ledger)
    text +=
        fmt::format("{}{}: {}.", text.empty() ? "" : " ", entry.claim.id, past_tense(entry.verdict.outcome));
  return text;
}

}  // namespace plenolab
