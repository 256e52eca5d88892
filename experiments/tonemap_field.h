#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/result_table.h"
#include "core/base/progress.h"
#include "core/lightfield/light_field.h"
#include "core/tonemap/adjustment/key_view_adjustment.h"
#include "experiments/cli/operator_options.h"
#include "experiments/tonemap_fit.h"

namespace plenolab {

/// How a light field is tone mapped.
struct FieldMappingOptions {
  OperatorChoice choice;                ///< a variant for views or light fields, adjusted or not
  KeyViewAdjustmentOptions adjustment;  ///< of adjusted ones
  int threads = 0;
  /// For the adjustment: half for mapped views that are kept, half for views in work.
  std::size_t memory_bound_bytes = std::size_t{1} << 30;
};

/// What one fit came to.
struct FitSummary {
  std::vector<FittedValue> values;
  std::vector<std::string> notes;
};

/// What came of it.
struct FieldMapping {
  std::vector<FitSummary> fits;   ///< one, or one for each view row by row
  MappingCounts counts;           ///< of all views, before adjustment
  std::vector<double> mean_luma;  ///< of each view as written, row by row
  std::optional<KeyViewAdjustmentCounts> adjustment;
  double seconds_map = 0;     ///< statistics, fits, mapping and writing
  double seconds_adjust = 0;  ///< adjustment with what it reads and writes
};

/// Tone maps a light field and writes it, with its disparity, as a display-referred one into a folder that
/// exists and is empty (see ViewWriter). Works view by view, within the memory bounds of `field` and of the
/// options; views that wait for their adjustment stand in a folder below `folder`, which is removed again.
FieldMapping write_mapped_light_field(const std::filesystem::path& folder, const LightField& field,
                                      const FieldMappingOptions& options, const Progress& progress = {});

/// Adjusts a tone mapped light field and writes it likewise; `mean_luma` receives that of each view.
KeyViewAdjustmentCounts write_adjusted_light_field(const std::filesystem::path& folder, const LightField& hdr,
                                                   const DisplayLightField& mapped,
                                                   const KeyViewAdjustmentOptions& options,
                                                   const KeyViewAdjustmentRun& run,
                                                   std::vector<double>& mean_luma);

/// Rows of a mapping: values and notes of each fit (with a column view if there are several), counts over
/// all views, smallest and largest mean luma of a view, counts of the adjustment, seconds of each stage.
ResultTable rows_of(const FieldMapping& mapping, const ViewGrid& grid, const Columns& columns);

/// Rows correspondences_per_pixel, kept_dark, adjusted_clipped_high, adjusted_floored_pixels, hdr_repairs and
/// display_repairs.
void add_adjustment_rows(ResultTable& table, const KeyViewAdjustmentCounts& counts, const Columns& columns);

/// Rows mean_luma_min and mean_luma_max.
void add_luma_rows(ResultTable& table, const std::vector<double>& mean_luma, const Columns& columns);

}  // namespace plenolab
