#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/tonemap/histogram_adjustment.h"

namespace plenolab {

/// A pass of trimming and the curve that would result if it were the last.
struct LoggedPass {
  TrimmingPass pass;
  double largest_slope = 0;  ///< of log L_d over log L; 1 where the mapping would be linear
};

/// How the histogram of a view was trimmed.
struct TrimmingLog {
  std::vector<LoggedPass> passes;
  double slope_before = 0;              ///< of plain equalisation
  std::optional<LogHistogram> trimmed;  ///< shares of the initial total; absent if the mapping is linear
  std::string linear_because;           ///< empty unless it is

  /// Share of the initial total that the last pass left; 1 without passes.
  double left_share() const;
};

/// Fits histogram adjustment and, for the slopes, stops it again after each number of passes. `options`
/// without a fixed number of passes.
TrimmingLog log_trimming(HistogramOptions options, const LogHistogram& histogram, double floor);

/// The histogram with counts as shares of their sum, which must be positive.
LogHistogram shares_of(LogHistogram histogram);

/// Sums of neighbouring bins: `bins` of equal width over the same range, each fine bin counting where its
/// centre lies. 1 ≤ bins.
std::vector<double> resample(std::span<const double> counts, int bins);

}  // namespace plenolab
