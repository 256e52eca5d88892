#include "experiments/reproduce/luminance/quality_verdicts.h"

#include <algorithm>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/luminance/luminance_tools.h"

namespace plenolab {

namespace {

constexpr double kHalf = 0.5;

std::string over_positions(std::size_t positions) {
  return uncertainty_over(positions, "positions", kPositionsTogether);
}

}  // namespace

Interval share_above(const std::vector<double>& gains_db, double threshold_db, std::uint64_t seed) {
  std::vector<double> hits;
  for (const double gain : gains_db) hits.push_back(gain > threshold_db ? 1 : 0);
  if (hits.empty()) return {0, 0, 1};
  const Interval share = mean_interval(hits, seed, kPositionsTogether).value_or(Interval{mean(hits), 0, 1});
  return {share.estimate, std::max(0.0, share.low), std::min(1.0, share.high)};
}

Verdict decide_most_positions(const Interval& share, std::size_t positions) {
  return decide_claim(share, Comparison::kAbove, kHalf, "share_both_better_than_all", "1",
                      over_positions(positions));
}

Verdict decide_certain_areas(const Interval& share, std::size_t positions) {
  const bool some = share.low > 0;
  Verdict verdict = decide_claim(share, some ? Comparison::kBelow : Comparison::kAbove, some ? kHalf : 0,
                                 "share_brute_force_noticeably_better", "1", over_positions(positions));
  if (share.high <= 0) verdict.outcome = Outcome::kRefuted;
  return verdict;
}

double widest_area_m(const std::vector<double>& gains_db, double threshold_db, double step_m) {
  int widest = 0, run = 0;
  for (const double gain : gains_db) {
    run = gain > threshold_db ? run + 1 : 0;
    widest = std::max(widest, run);
  }
  return widest * step_m;
}

}  // namespace plenolab
