#include "analysis/timing.h"

#include <fmt/format.h>

#include "analysis/statistics.h"
#include "core/base/error.h"

namespace plenolab {

TimingSummary summarise_times(std::vector<double> seconds) {
  PLENOLAB_CHECK(!seconds.empty(), "no run to summarise");
  TimingSummary summary;
  summary.runs = static_cast<int>(seconds.size());
  summary.median_s = median(seconds);
  summary.lower_quartile_s = quantile(seconds, 0.25);
  summary.upper_quartile_s = quantile(seconds, 0.75);
  summary.min_s = quantile(seconds, 0);
  summary.max_s = quantile(seconds, 1);
  return summary;
}

void TimingOptions::validate() const {
  if (runs < 1) throw InputError(fmt::format("the number of timed runs is {} but must be at least 1", runs));
  if (warm_up_runs < 0)
    throw InputError(fmt::format("warm_up_runs is {} but must not be negative", warm_up_runs));
}

TimingSummary time_repeated(const std::function<void()>& work, const TimingOptions& options) {
  options.validate();
  for (int i = 0; i < options.warm_up_runs; ++i) work();
  std::vector<double> seconds;
  for (int i = 0; i < options.runs; ++i) {
    const Stopwatch watch;
    work();
    seconds.push_back(watch.seconds());
  }
  return summarise_times(std::move(seconds));
}

std::vector<std::vector<double>> medians_in_turn(const std::vector<StagedWork>& works,
                                                 const TimingOptions& options) {
  options.validate();
  std::vector<std::vector<std::vector<double>>> seconds(works.size());  // of work, stage and run
  for (int round = 0; round < options.warm_up_runs + options.runs; ++round)
    for (std::size_t w = 0; w < works.size(); ++w) {
      const std::vector<double> stages = works[w]();
      if (round < options.warm_up_runs) continue;
      seconds[w].resize(stages.size());
      for (std::size_t s = 0; s < stages.size(); ++s) seconds[w][s].push_back(stages[s]);
    }
  std::vector<std::vector<double>> medians(works.size());
  for (std::size_t w = 0; w < works.size(); ++w)
    for (const std::vector<double>& runs : seconds[w]) medians[w].push_back(median(runs));
  return medians;
}

void add_timing_rows(ResultTable& table, const TimingSummary& timing,
                     const std::vector<std::pair<std::string, Cell>>& columns) {
  const auto add = [&](const char* quantity, double value, const char* unit) {
    table.add({quantity, value, unit, columns});
  };
  add("seconds_median", timing.median_s, "s");
  add("seconds_lower_quartile", timing.lower_quartile_s, "s");
  add("seconds_upper_quartile", timing.upper_quartile_s, "s");
  add("seconds_min", timing.min_s, "s");
  add("seconds_max", timing.max_s, "s");
  add("runs", timing.runs, "1");
}

}  // namespace plenolab
