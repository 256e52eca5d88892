#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/result_table.h"

namespace plenolab {

/// Wall-clock time since construction.
class Stopwatch {
 public:
  Stopwatch() : start_(std::chrono::steady_clock::now()) {}
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_;
};

/// Summary of repeated runs.
struct TimingSummary {
  int runs = 0;
  double median_s = 0, lower_quartile_s = 0, upper_quartile_s = 0, min_s = 0, max_s = 0;
};

/// Summary of given run times (at least one).
TimingSummary summarise_times(std::vector<double> seconds);

/// How often work is repeated.
struct TimingOptions {
  int runs = 5;          ///< timed runs, ≥ 1
  int warm_up_runs = 1;  ///< runs before them that do not count, ≥ 0

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// Runs `work` warm_up_runs + runs times and summarises the timed ones.
TimingSummary time_repeated(const std::function<void()>& work, const TimingOptions& options = {});

/// Work that measures its stages itself and returns their seconds, as many each time.
using StagedWork = std::function<std::vector<double>()>;

/// Medians by work and stage. Every round runs each piece of work once, one after the other: what slows the
/// machine for a while slows all of them, and their ratios hardly change. `options.warm_up_runs` rounds go
/// before those that count.
std::vector<std::vector<double>> medians_in_turn(const std::vector<StagedWork>& works,
                                                 const TimingOptions& options = {});

/// Rows seconds_median, seconds_lower_quartile, seconds_upper_quartile, seconds_min, seconds_max (unit s) and
/// runs, all with the same identifying columns.
void add_timing_rows(ResultTable& table, const TimingSummary& timing,
                     const std::vector<std::pair<std::string, Cell>>& columns);

}  // namespace plenolab
