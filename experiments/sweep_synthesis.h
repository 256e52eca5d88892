#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/plot.h"
#include "analysis/result_table.h"
#include "core/base/progress.h"
#include "core/lightfield/light_field.h"
#include "core/synthesis/options.h"

namespace plenolab {

/// A light field together with the true view of any position that the sweep asks for.
struct SweepStimulus {
  std::string name;
  LightField key_views;
  std::vector<CameraPosition> positions;            ///< where views are synthesised
  std::function<SceneImage(CameraPosition)> truth;  ///< of those positions, same size
};

/// One way to synthesise.
struct SynthesisSetting {
  SearchKind search = SearchKind::kFast;
  double step_px = 1;
  int key_views = 4;
};

/// Every combination of both searches, steps of ¼, ½, 1, 2 and 4 px, and 1, 2 and 4 key views.
std::vector<SynthesisSetting> all_synthesis_settings();

/// What `sweep synthesis` varies.
struct SynthesisSweepOptions {
  std::vector<SynthesisSetting> settings = all_synthesis_settings();
  int runs = 3;     ///< timed runs of every setting and position, ≥ 1
  int threads = 0;  ///< 0 = all cores

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// Error against run time and memory of view synthesis: every combination of search, step and number of key
/// views on each stimulus (image sizes are separate stimuli). Rows, with columns scene, width, search,
/// step_px, key_views: psnr_gamma_db (pooled over the positions), rms_error (of gamma-encoded values, the
/// same error on a linear scale), seconds_median … as in add_timing_rows, memory_held_mib
/// (computed: key views, prepared views and result held after one synthesis), memory_peak_mib (measured: peak
/// resident memory of preparing the key views, which are loaded, and synthesising the first position; where
/// the system can tell, see peak_memory_mib), samples_per_search, and on_pareto_front (1 where no other
/// setting of the same stimulus is both faster and better).
ResultTable sweep_synthesis(const std::vector<SweepStimulus>& stimuli, const SynthesisSweepOptions& options,
                            const Progress& progress = {});

/// Error over run time of the rows of one stimulus: one series for each search and number of key views,
/// Pareto-optimal settings ringed, labelled with their step.
Plot plot_synthesis_sweep(const ResultTable& rows, const std::string& scene, int width);

}  // namespace plenolab
