#include "experiments/reproduce/tonemap/trimming.h"

#include <algorithm>
#include <numeric>

#include "core/base/error.h"

namespace plenolab {

namespace {

double largest_slope(const HistogramParameters& p) {
  if (p.cumulative.size() < 2) return 1;
  double steepest = 0;
  for (std::size_t i = 1; i < p.cumulative.size(); ++i)
    steepest = std::max(steepest, p.cumulative[i] - p.cumulative[i - 1]);
  const double bin_width = (p.log_max - p.log_min) / static_cast<double>(p.cumulative.size() - 1);
  return steepest * (p.log_display_max - p.log_display_min) / bin_width;
}

double left_of(const TrimmingPass& pass, double initial) {
  return (pass.total - pass.trimmed) / initial;
}

}  // namespace

double TrimmingLog::left_share() const {
  return passes.empty() ? 1 : left_of(passes.back().pass, passes.front().pass.total);
}

TrimmingLog log_trimming(HistogramOptions options, const LogHistogram& histogram, double floor) {
  PLENOLAB_CHECK(!options.fixed_passes, "the number of passes follows from the histogram");
  const HistogramParameters final = fit(options, histogram, floor);
  TrimmingLog log;
  log.linear_because = final.linear_because;
  for (std::size_t i = 0; i <= final.passes.size(); ++i) {
    options.fixed_passes = static_cast<int>(i);
    const double slope = largest_slope(fit(options, histogram, floor));
    if (i == 0)
      log.slope_before = slope;
    else
      log.passes.push_back({final.passes[i - 1], slope});
  }
  if (final.linear) return log;
  LogHistogram trimmed{histogram.log_min, histogram.log_max, {}};
  for (std::size_t i = 1; i < final.cumulative.size(); ++i)
    trimmed.counts.push_back(log.left_share() * (final.cumulative[i] - final.cumulative[i - 1]));
  log.trimmed = std::move(trimmed);
  return log;
}

LogHistogram shares_of(LogHistogram histogram) {
  const double total = std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0.0);
  PLENOLAB_CHECK(total > 0, "a histogram of at least one pixel");
  for (double& count : histogram.counts) count /= total;
  return histogram;
}

std::vector<double> resample(std::span<const double> counts, int bins) {
  PLENOLAB_CHECK(bins >= 1, "at least one bin");
  std::vector<double> coarse(static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double centre = (static_cast<double>(i) + 0.5) / static_cast<double>(counts.size());
    coarse[static_cast<std::size_t>(centre * bins)] += counts[i];
  }
  return coarse;
}

}  // namespace plenolab
