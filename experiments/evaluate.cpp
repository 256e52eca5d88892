#include "experiments/evaluate.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/statistics.h"
#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/image/repair.h"
#include "core/lightfield/subsample.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/score.h"

namespace plenolab {

namespace {

struct ViewIndex {
  int column = 0, row = 0;
};

struct Positions {
  std::vector<ViewIndex> scored;  ///< between key views
  int key_views = 0;
  int outside = 0;  ///< behind the last key column or row
};

int stride_along(int count, int stride) {
  return count == 1 ? 1 : stride;
}

Positions split_views(const ViewGrid& grid, int stride) {
  const int step_x = stride_along(grid.columns, stride), step_y = stride_along(grid.rows, stride);
  const int last_x = (grid.columns - 1) / step_x * step_x, last_y = (grid.rows - 1) / step_y * step_y;
  Positions positions;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      if (column > last_x || row > last_y)
        ++positions.outside;
      else if (column % step_x == 0 && row % step_y == 0)
        ++positions.key_views;
      else
        positions.scored.push_back({column, row});
    }
  return positions;
}

PixelRepairs repair_captured(SceneImage& image) {
  return repair(image);
}
PixelRepairs repair_captured(DisplayImage&) {
  return {};
}

float exposure_for(const LightField& field, double requested) {
  return common_exposure(field, requested);
}
float exposure_for(const DisplayLightField&, double) {
  return 1;
}

/// What is gathered over the scored views.
struct Totals {
  std::vector<std::pair<std::string, std::vector<double>>> psnrs_db;  ///< by quantity
  std::vector<double> ssim, seconds;
  double restored_pixels = 0, unseen_pixels = 0, pixels = 0, repaired_values = 0;

  void add(const std::vector<Measurement>& measurements) {
    for (const Measurement& m : measurements) {
      if (m.quantity == "ssim_gamma") ssim.push_back(m.value);
      if (!m.quantity.starts_with("psnr_") || m.unit != "dB") continue;
      const auto same = [&](const auto& entry) { return entry.first == m.quantity; };
      auto found = std::find_if(psnrs_db.begin(), psnrs_db.end(), same);
      if (found == psnrs_db.end()) found = psnrs_db.insert(psnrs_db.end(), {m.quantity, {}});
      found->second.push_back(m.value);
    }
  }

  void add_rows(ResultTable& table, const Columns& columns, const Positions& positions) const {
    for (const auto& [quantity, values] : psnrs_db) {
      // The peak of linear PSNR is each view's own, so its errors have no common scale to pool on.
      const bool common_peak = quantity != "psnr_linear_db";
      table.add({quantity, common_peak ? pooled_psnr_db(values) : median(values), "dB", columns});
    }
    table.add({"ssim_gamma", mean(ssim), "1", columns});
    table.add({"ssim_gamma_worst", *std::min_element(ssim.begin(), ssim.end()), "1", columns});
    table.add({"restored_share", restored_pixels / pixels, "1", columns});
    table.add({"unseen_share", unseen_pixels / pixels, "1", columns});
    table.add({"repaired_values", repaired_values, "values", columns});
    table.add({"seconds_median", median(seconds), "s", columns});
    table.add({"views_scored", static_cast<double>(positions.scored.size()), "views", columns});
    table.add({"key_views", static_cast<double>(positions.key_views), "views", columns});
    table.add({"views_outside_key_views", static_cast<double>(positions.outside), "views", columns});
  }
};

Columns view_columns(int stride, const std::string& view) {
  return {{"key_stride", static_cast<long long>(stride)}, {"view", view}};
}

/// The captured colour, repaired, so that metrics accept it.
template <class Referral>
RgbImage<Referral> truth_of(const BasicLightField<Referral>& captured, ViewIndex index, Totals& totals) {
  RgbImage<Referral> colour = captured.view(index.column, index.row)->colour;
  totals.repaired_values += static_cast<double>(repair_captured(colour).total());
  return colour;
}

/// Where a captured view lies on the grid of the key views.
CameraPosition position_of(ViewIndex index, const ViewGrid& grid, int stride) {
  return {static_cast<double>(index.column) / stride_along(grid.columns, stride),
          static_cast<double>(index.row) / stride_along(grid.rows, stride)};
}

template <class Referral>
void score_view(const NovelView<Referral>& novel, const RgbImage<Referral>& truth,
                const ComparisonConditions& conditions, const Columns& columns, ResultTable& table,
                Totals& totals) {
  const std::vector<Measurement> measurements = measure(
      novel.image, truth, select_metrics(std::vector<std::string>{"psnr", "ssim", "difference"}), conditions);
  const double seconds = novel.timings.total_s - novel.timings.prepare_s;
  add_measurement_rows(table, measurements, columns);
  table.add({"restored_pixels", static_cast<double>(novel.restored_pixels), "px", columns});
  table.add({"unseen_pixels", static_cast<double>(novel.unseen_pixels), "px", columns});
  table.add({"seconds", seconds, "s", columns});
  totals.add(measurements);
  totals.restored_pixels += static_cast<double>(novel.restored_pixels);
  totals.unseen_pixels += static_cast<double>(novel.unseen_pixels);
  totals.pixels += static_cast<double>(novel.image.size());
  totals.seconds.push_back(seconds);
}

}  // namespace

void EvaluateOptions::validate() const {
  if (key_stride < 2)
    throw InputError(
        fmt::format("the key stride must be 2 or more, not {}: with 1 no view is left to score", key_stride));
  if (!(exposure >= 0)) throw InputError(fmt::format("the exposure must be positive, not {}", exposure));
  synthesis.validate();
}

template <class Referral>
ResultTable evaluate(const BasicLightField<Referral>& captured, const EvaluateOptions& options,
                     const Progress& progress,
                     const std::function<void(const EvaluatedView<Referral>&)>& receive) {
  options.validate();
  const ViewGrid grid = captured.grid();
  const Positions positions = split_views(grid, options.key_stride);
  if (positions.scored.empty())
    throw InputError(fmt::format("{}: with key stride {} no view of the {}×{} grid lies between key views",
                                 captured.name(), options.key_stride, grid.columns, grid.rows));
  const BasicSynthesizer<Referral> synthesizer(subsample(captured, options.key_stride));
  ComparisonConditions conditions;
  conditions.exposure = exposure_for(captured, options.exposure);
  conditions.cd_m2_per_unit = options.cd_m2_per_unit;
  conditions.threads = options.synthesis.threads;
  ResultTable table;
  Totals totals;
  double done = 0;
  for (const ViewIndex index : positions.scored) {
    const RgbImage<Referral> truth = truth_of(captured, index, totals);
    const auto novel =
        synthesizer.synthesize(position_of(index, grid, options.key_stride), options.synthesis);
    score_view(novel, truth, conditions,
               view_columns(options.key_stride, fmt::format("{},{}", index.column, index.row)), table,
               totals);
    if (receive) receive({index.column, index.row, truth, novel, conditions.exposure});
    if (progress) progress(++done / static_cast<double>(positions.scored.size()));
  }
  totals.add_rows(table, view_columns(options.key_stride, "all"), positions);
  return table;
}

template ResultTable evaluate(const LightField&, const EvaluateOptions&, const Progress&,
                              const std::function<void(const EvaluatedView<SceneReferred>&)>&);
template ResultTable evaluate(const DisplayLightField&, const EvaluateOptions&, const Progress&,
                              const std::function<void(const EvaluatedView<DisplayReferred>&)>&);

}  // namespace plenolab
