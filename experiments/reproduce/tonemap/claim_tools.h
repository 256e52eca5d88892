#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduce/claims/appearance_measures.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/measures.h"

namespace plenolab {

/// How the items on claims about tone mapping state what they measured.

/// A number with its interval; nothing where the run does not give it.
struct MeasuredNumber {
  std::string what;  ///< e.g. "Cellar, naive"
  std::optional<Interval> interval;
};

/// Adds a table of numbers, with rows `quantity`, `quantity`_low and `quantity`_high (column what).
void add_measured(ReproductionResult& result, const std::string& caption, const std::string& quantity,
                  const std::string& unit, const std::vector<MeasuredNumber>& numbers);

/// What decides a claim.
struct Decision {
  std::optional<Interval> interval;
  Comparison comparison = Comparison::kBelow;
  double threshold = 0;
  std::string quantity, unit, uncertainty;
  std::vector<std::string> scenes;
  std::string explanation;
};

/// Adds the entry to the ledger with its rows; undecided where there is no interval.
void add_claim(ReproductionResult& result, Claim claim, const Decision& decision);

/// "A-T1a: our measurement agrees. A-T1b: …", of all entries of the result's ledger.
std::string outcome_words(const ReproductionResult& result);

}  // namespace plenolab
