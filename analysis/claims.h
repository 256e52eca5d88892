#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/result_table.h"
#include "analysis/statistics.h"

namespace plenolab {

/// A result that a paper states.
struct Claim {
  std::string id;         ///< stable, e.g. "altmeier-3"
  std::string where;      ///< paper, section and page
  std::string statement;  ///< in our words
};

enum class Outcome { kConfirmed, kRefuted, kUndecided };

/// Which side of the threshold the claim says the number lies on.
enum class Comparison { kBelow, kAbove };

/// What our measurement says about a claim.
struct Verdict {
  Outcome outcome = Outcome::kUndecided;
  double number = 0;  ///< finite
  std::string quantity, unit;
  Comparison comparison = Comparison::kBelow;
  double threshold = 0;
  std::optional<Interval> interval;  ///< of `number`; absent if the measurement has no known uncertainty
  std::string uncertainty;           ///< what the interval covers, e.g. "95 % bootstrap over 9 views"
  std::vector<std::string> scenes;   ///< stimuli it was measured on
  std::string explanation;           ///< what was measured and what the outcome means, honestly
};

/// The rule: confirmed only if the whole interval lies strictly on the claimed side of the threshold, refuted
/// if it lies strictly on the other side, undecided if it touches or spans it, or holds a non-finite end.
Outcome decide(const Interval& interval, Comparison comparison, double threshold);

/// A verdict by that rule, its number the interval's estimate. Scenes and explanation are left to the caller.
Verdict decide_claim(const Interval& interval, Comparison comparison, double threshold, std::string quantity,
                     std::string unit, std::string uncertainty);

/// A claim that cannot be decided here, and why.
Verdict undecidable(std::string explanation);

struct LedgerEntry {
  Claim claim;
  Verdict verdict;
};

/// One row per decided number: quantity as in the verdict, columns claim, outcome, comparison, threshold,
/// interval_low, interval_high, scenes. Entries without a quantity (undecidable) give claim_outcome, 0.
void add_ledger_rows(ResultTable& table, std::span<const LedgerEntry> ledger);

std::string outcome_name(Outcome outcome);           ///< "confirmed", "refuted", "undecided"
std::string comparison_sign(Comparison comparison);  ///< "<" or ">"

}  // namespace plenolab
