#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/plot.h"
#include "analysis/result_table.h"
#include "analysis/timing.h"
#include "experiments/score.h"

namespace plenolab {

/// One setting of a swept method.
struct SweepOutcome {
  Columns setting;
  double error = 0;  ///< what the Pareto front is about, besides time
  std::vector<Measurement> values;
  TimingSummary timing;
  std::optional<double> peak_mib;  ///< measured, see peak_memory_mib
};

/// Times `work` with `runs` runs after one that does not count, and measures its memory.
void time_setting(SweepOutcome& outcome, const std::function<void()>& work, int runs);

/// Rows of the settings of one stimulus: values, seconds_median … as in add_timing_rows, memory_peak_mib, and
/// on_pareto_front (1 where no other setting is both faster and better).
void add_outcome_rows(ResultTable& table, const Columns& stimulus, const std::vector<SweepOutcome>& outcomes);

/// Which rows a plot of error over run time shows, and how.
struct SweepPlotDesign {
  std::string error_quantity, error_title, error_unit;
  std::vector<std::string> series_columns;  ///< one series for each setting of these
  std::string label_column;                 ///< written beside the points
};

/// Error over run time; Pareto-optimal settings ringed. Both axes are logarithmic: settings without error are
/// left out.
Plot plot_sweep(const ResultTable& rows, const SweepPlotDesign& design);

}  // namespace plenolab
