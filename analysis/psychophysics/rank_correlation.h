#pragma once

#include <span>

#include "analysis/statistics.h"

namespace plenolab {

/// Whether one number orders things as another does, for few things.

struct RankCorrelation {
  Interval rho;  ///< Spearman's, ties with mean ranks; interval by Fisher's z (Bonett & Wright 2000)
  double p_two_sided = 1;  ///< exact: share of all orders whose |ρ| is as large
  double smallest_p = 1;   ///< the smallest two-sided p that any order of these numbers could have
};

/// For 4 to 9 pairs (all orders are tried). Throws InputError for other numbers of pairs, values that are not
/// finite, or one side without any difference.
RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y,
                                 double confidence = 0.95);

}  // namespace plenolab
