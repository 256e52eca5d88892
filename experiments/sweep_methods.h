#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cli/operator_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/wide_table.h"

/// What `plenolab sweep` can sweep: each method with its inputs, and the table in which people see its rows.
namespace plenolab {

struct SweepOptions {
  CommonOptions common;
  std::string method, source;
  std::string out, cache;
  OperatorOptions chosen;
  double cd_m2_per_unit = 0;  ///< 0: as the file says
  int runs = 3;
  bool force = false;
};

struct SweepMethod {
  const char* name;
  /// What the method came to, with its plots below `folder`.
  ResultTable (*run)(const SweepOptions& options, const std::filesystem::path& folder);
  std::vector<std::string> keys;
  std::vector<WideColumn> columns;
};
const std::vector<SweepMethod>& sweep_methods();

/// Whether the source is a file or folder; throws InputError if it is a path where nothing is.
bool source_exists(const SweepOptions& options);

/// Whether tables are swept on the built-in walk.
bool is_walk(const SweepOptions& options);

/// The operator behind key-view adjustment, and the one whose pictures DRIM compares. Throw UsageError as
/// choose_operator does, and for operators that do not map views one by one.
OperatorChoice adjusted_operator(const SweepOptions& options);
OperatorChoice mapping_operator(const SweepOptions& options);

/// Luminance of a pixel value of 1: scenes are in cd/m², of a file it must be known. Throws UsageError.
double luminance_scale_of(const SweepOptions& options);

/// Tables grade pictures: radiance is shown by a plain exposure with this factor; nothing for other methods,
/// the walk, and files that hold pictures.
std::optional<float> exposure_for_tables(const SweepOptions& options);

// One each for the table of methods.
ResultTable run_synthesis_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_bilateral_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_histogram_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_adjustment_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_reprojection_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_drim_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_optimise_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_luminance_sweep(const SweepOptions& options, const std::filesystem::path& folder);
ResultTable run_lut_sweep(const SweepOptions& options, const std::filesystem::path& folder);

}  // namespace plenolab
