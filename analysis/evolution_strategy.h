#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace plenolab {

/// (1 + λ) evolution strategy: in each iteration λ children are drawn around the best point so far, and the
/// best of all λ + 1 is kept (Zhao 2019, section 3.3, after Gao et al. 2017). For functions without
/// derivatives that cost seconds to evaluate.

/// A number to be optimised.
struct SearchParameter {
  std::string name;
  double start = 0, minimum = 0, maximum = 1;  ///< minimum < maximum, start within
};

struct EvolutionOptions {
  int children = 10;                ///< λ ≥ 1
  double deviation = 0.5;           ///< σ of the first iteration, > 0
  bool relative_deviation = false;  ///< σ in units of each parameter's range instead of the parameter's own
  double shrink = 0.8;              ///< σ is multiplied by it after each iteration, in (0, 1]
  double least_change = 1e-6;       ///< an iteration whose best score fell by less counts as without progress
  int patience = 6;                 ///< ends after this many of these in a row, ≥ 1
  int most_iterations = 200;        ///< ≥ 0
  std::uint64_t seed = 1;

  /// Throws InputError naming the value out of range.
  void validate() const;
};

struct EvolutionStep {
  int iteration = 0;               ///< 0: the start
  double deviation = 0;            ///< σ that the children were drawn with
  double score = 0;                ///< best so far
  std::vector<double> parameters;  ///< of the best so far
  int evaluations = 0;             ///< so far
};

struct Evolution {
  std::vector<double> best;
  double score = 0;
  std::vector<EvolutionStep> trace;  ///< the start, then one step an iteration; scores never rise
  bool converged = false;            ///< stopped for want of progress, not at most_iterations
};

/// Minimises `score`, which gets one value for each parameter, within its range. Children are the best point
/// plus normal deviates of σ, cut to the range; all children of an iteration are handed over together so that
/// the caller may evaluate them in parallel. Deterministic for a seed. A score that is not finite counts as
/// worse than any other; throws InputError if that of the start is not finite, or for parameters out of
/// order.
using ScoreAll = std::function<std::vector<double>(std::span<const std::vector<double>> candidates)>;
Evolution minimise_by_evolution(std::span<const SearchParameter> parameters, const ScoreAll& score,
                                const EvolutionOptions& options = {},
                                const std::function<void(const EvolutionStep&)>& progress = {});

}  // namespace plenolab
