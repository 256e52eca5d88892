#include "analysis/claims.h"

#include <cmath>

#include "core/base/error.h"

namespace plenolab {
namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

}  // namespace

Outcome decide(const Interval& interval, Comparison comparison, double threshold) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high) || !std::isfinite(threshold)) {
    return Outcome::kUndecided;
  }
  const bool below = interval.high<threshold, above = interval.low> threshold;
  if (!below && !above) return Outcome::kUndecided;
  return below == (comparison == Comparison::kBelow) ? Outcome::kConfirmed : Outcome::kRefuted;
}

Verdict decide_claim(const Interval& interval, Comparison comparison, double threshold, std::string quantity,
                     std::string unit, std::string uncertainty) {
  PLENOLAB_CHECK(interval.low <= interval.high, "an interval must not be reversed");
  Verdict verdict;
  verdict.outcome = decide(interval, comparison, threshold);
  verdict.number = interval.estimate;
  verdict.quantity = std::move(quantity);
  verdict.unit = std::move(unit);
  verdict.comparison = comparison;
  verdict.threshold = threshold;
  verdict.interval = interval;
  verdict.uncertainty = std::move(uncertainty);
  return verdict;
}

Verdict undecidable(std::string explanation) {
  Verdict verdict;
  verdict.explanation = std::move(explanation);
  return verdict;
}

void add_ledger_rows(ResultTable& table, std::span<const LedgerEntry> ledger) {
  for (const auto& [claim, verdict] : ledger) {
    ResultRow row;
    row.columns = {{"claim", claim.id}, {"outcome", outcome_name(verdict.outcome)}};
    if (verdict.quantity.empty()) {
      row.quantity = "claim_outcome";
      row.unit = std::string("1");
    } else {
      row.quantity = verdict.quantity;
      row.value = verdict.number;
      row.unit = verdict.unit;
      row.columns.push_back({"comparison", comparison_sign(verdict.comparison)});
      row.columns.push_back({"threshold", verdict.threshold});
    }
    if (verdict.interval) {
      row.columns.push_back({"interval_low", verdict.interval->low});
      row.columns.push_back({"interval_high", verdict.interval->high});
    }
    if (!verdict.scenes.empty()) row.columns.push_back({"scenes", joined(verdict.scenes)});
    table.add(std::move(row));
  }
}

std::string outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kConfirmed:
      return "confirmed";
    case Outcome::kRefuted:
      return "refuted";
    case Outcome::kUndecided:
      break;
  }
  return "undecided";
}

std::string comparison_sign(Comparison comparison) {
  return comparison == Comparison::kBelow ? "<" : ">";
}

}  // namespace plenolab
