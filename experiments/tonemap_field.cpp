#include "experiments/tonemap_field.h"
#include "metrics/consistency.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/timing.h"
#include "core/lightfield/view_writer.h"
#include "core/tonemap/light_field_mapping.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Mapped views that wait for their adjustment.
constexpr const char* kWaiting = "mapped";
/// Share of the work that measuring is, roughly; progress need not be exact.
constexpr double kMeasured = 0.15;

Progress part(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [progress, from, to](double share) { progress(from + (to - from) * share); };
}

void write_mapped(const fs::path& folder, const LightField& field, const FieldMappingOptions& options,
                  FieldMapping& mapping, const Progress& progress) {
  const OperatorChoice& choice = options.choice;
  const LightFieldStatistics statistics =
      measure_light_field(field, options.threads, part(progress, 0, kMeasured));
  DisplayViewWriter writer(folder, field.grid(), field.unit(), field.name(),
                           {.colour_type = ExrPixelType::kFloat});
  const auto sink = [&](int column, int row, const ToneMapped& mapped, const FittedOperator& fitted) {
    writer.write(column, row, mapped.image, field.view(column, row)->disparity);
    mapping.mean_luma.push_back(mean_luma(mapped.image));
    if (mapping.fits.empty() || choice.variant.scope == OperatorScope::kView)
      mapping.fits.push_back({fitted.values, fitted.notes});
  };
  mapping.counts = map_light_field(*choice.info, choice.variant.id, choice.values, field, statistics, sink,
                                   options.threads, part(progress, kMeasured, 1));
  writer.finish();
}

void adjust_mapped(const fs::path& folder, const LightField& field, const FieldMappingOptions& options,
                   FieldMapping& mapping, const Progress& progress) {
  const std::size_t half = options.memory_bound_bytes / 2;
  const DisplayLightField mapped = open_display_light_field(folder / kWaiting, {.memory_bound_bytes = half});
  mapping.mean_luma.clear();
  mapping.adjustment = write_adjusted_light_field(
      folder, field, mapped, options.adjustment,
      {.threads = options.threads, .memory_bound_bytes = half, .progress = progress}, mapping.mean_luma);
}

Columns with_view(Columns columns, const ViewGrid& grid, std::size_t index) {
  const int i = static_cast<int>(index);
  columns.emplace_back("view", fmt::format("{},{}", i % grid.columns, i / grid.columns));
  return columns;
}

}  // namespace

FieldMapping write_mapped_light_field(const fs::path& folder, const LightField& field,
                                      const FieldMappingOptions& options, const Progress& progress) {
  options.adjustment.validate();
  FieldMapping mapping;
  const Stopwatch map_watch;
  const bool adjusted = options.choice.adjusted;
  const fs::path first = adjusted ? folder / kWaiting : folder;
  fs::create_directories(first);
  write_mapped(first, field, options, mapping, part(progress, 0, adjusted ? 0.5 : 1));
  mapping.seconds_map = map_watch.seconds();
  if (!adjusted) return mapping;
  const Stopwatch adjust_watch;
  adjust_mapped(folder, field, options, mapping, part(progress, 0.5, 1));
  mapping.seconds_adjust = adjust_watch.seconds();
  fs::remove_all(first);
  return mapping;
}

KeyViewAdjustmentCounts write_adjusted_light_field(const fs::path& folder, const LightField& hdr,
                                                   const DisplayLightField& mapped,
                                                   const KeyViewAdjustmentOptions& options,
                                                   const KeyViewAdjustmentRun& run,
                                                   std::vector<double>& mean_lumas) {
  DisplayViewWriter writer(folder, hdr.grid(), hdr.unit(), mapped.name(),
                           {.colour_type = ExrPixelType::kFloat});
  const auto sink = [&](int column, int row, const DisplayImage& view) {
    writer.write(column, row, view, hdr.view(column, row)->disparity);
    mean_lumas.push_back(mean_luma(view));
  };
  const KeyViewAdjustmentCounts counts = adjust_key_views(hdr, mapped, options, sink, run);
  writer.finish();
  return counts;
}

void add_adjustment_rows(ResultTable& table, const KeyViewAdjustmentCounts& counts, const Columns& columns) {
  const auto add = [&](const char* quantity, std::int64_t count, const char* unit) {
    table.add({quantity, static_cast<double>(count), unit, columns});
  };
  table.add({"correspondences_per_pixel",
             static_cast<double>(counts.correspondences) / static_cast<double>(counts.pixels), "1", columns});
  add("kept_dark", counts.kept_dark, "px");
  add("adjusted_clipped_high", counts.clipped_high, "values");
  add("adjusted_floored_pixels", counts.floored_pixels, "px");
  add("hdr_repairs", counts.hdr_repairs.total(), "values");
  add("display_repairs", counts.display_repairs, "values");
}

void add_luma_rows(ResultTable& table, const std::vector<double>& mean_luma, const Columns& columns) {
  const auto [darkest, brightest] = std::minmax_element(mean_luma.begin(), mean_luma.end());
  table.add({"mean_luma_min", *darkest, "luma", columns});
  table.add({"mean_luma_max", *brightest, "luma", columns});
}

ResultTable rows_of(const FieldMapping& mapping, const ViewGrid& grid, const Columns& columns) {
  ResultTable table;
  for (std::size_t i = 0; i < mapping.fits.size(); ++i)
    add_fit_rows(table, mapping.fits[i].values, mapping.fits[i].notes,
                 mapping.fits.size() == 1 ? columns : with_view(columns, grid, i));
  add_count_rows(table, mapping.counts, columns);
  add_luma_rows(table, mapping.mean_luma, columns);
  table.add({"seconds_map", mapping.seconds_map, "s", columns});
  if (mapping.adjustment) {
    add_adjustment_rows(table, *mapping.adjustment, columns);
    table.add({"seconds_adjust", mapping.seconds_adjust, "s", columns});
  }
  return table;
}

}  // namespace plenolab
