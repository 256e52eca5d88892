#include <cmath>
#include <map>

#include "core/image/colour.h"
#include "core/tonemap/adjustment/key_view_adjustment.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/sweep_errors.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

namespace {

using Views = std::vector<DisplayImage>;

DisplayLightField map_field(const LightField& field, const OperatorChoice& choice, int threads) {
  std::vector<KeyView<DisplayReferred>> views;
  const auto sink = [&](int column, int row, const ToneMapped& mapped, const FittedOperator&) {
    views.push_back({mapped.image, field.view(column, row)->disparity});
  };
  map_light_field(*choice.info, choice.variant.id, choice.values, field, measure_light_field(field, threads),
                  sink, threads);
  return DisplayLightField::from_views(field.grid(), field.unit(), field.name(), std::move(views));
}

struct Adjusted {
  Views views;
  KeyViewAdjustmentCounts counts;
};

Adjusted adjust(const LightField& field, const DisplayLightField& mapped, const AdjustmentSetting& setting,
                int threads) {
  KeyViewAdjustmentOptions options;
  options.sigma_views = setting.sigma_views;
  options.support_views = setting.support_views;
  Adjusted result;
  result.counts = adjust_key_views(field, mapped, options,
                                   [&](int, int, const DisplayImage& view) { result.views.push_back(view); },
                                   {.threads = threads});
  return result;
}

double whole_grid(const ViewGrid& grid) {
  return std::ceil(std::hypot(grid.columns - 1, grid.rows - 1));
}

/// Mean absolute difference in luma between the pixels of a view and the nearest pixels that show the same
/// surface (disparities within half a pixel) in the views to its right and below.
class NeighbourDifference {
 public:
  NeighbourDifference(const LightField& field, const Views& views) : field_(field), views_(views) {
    const ViewGrid& grid = field.grid();
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        if (column + 1 < grid.columns) compare(column, row, 1, 0);
        if (row + 1 < grid.rows) compare(column, row, 0, 1);
      }
  }

  double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }

 private:
  const DisplayImage& image(int column, int row) const {
    return views_[static_cast<std::size_t>(row * field_.grid().columns + column)];
  }

  void compare(int column, int row, int right, int down) {
    constexpr float kSameSurface_px = 0.5f;
    const ViewGrid& grid = field_.grid();
    const DisplayImage &a = image(column, row), &b = image(column + right, row + down);
    const auto from = field_.view(column, row), to = field_.view(column + right, row + down);
    const float step_x = static_cast<float>(-right);
    const float step_y = static_cast<float>(-down * grid.vertical_ratio());
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x) {
        const float disparity = from->disparity.at(x, y);
        const long qx = std::lround(static_cast<float>(x) + step_x * disparity);
        const long qy = std::lround(static_cast<float>(y) + step_y * disparity);
        if (qx < 0 || qy < 0 || qx >= a.width() || qy >= a.height()) continue;
        const int bx = static_cast<int>(qx), by = static_cast<int>(qy);
        if (std::abs(to->disparity.at(bx, by) - disparity) > kSameSurface_px) continue;
        sum_ += std::abs(luminance(a.at(x, y)) - luminance(b.at(bx, by)));
        ++count_;
      }
  }

  const LightField& field_;
  const Views& views_;
  double sum_ = 0;
  std::size_t count_ = 0;
};

Views views_of(const DisplayLightField& field) {
  Views views;
  for (int row = 0; row < field.grid().rows; ++row)
    for (int column = 0; column < field.grid().columns; ++column)
      views.push_back(field.view(column, row)->colour);
  return views;
}

}  // namespace

std::vector<AdjustmentSetting> all_adjustment_settings(const ViewGrid& grid) {
  std::vector<AdjustmentSetting> settings;
  const double whole = whole_grid(grid);
  for (const double sigma : {1.0, 2.0, 4.0}) {
    for (const double support : {0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0})
      if (support < whole) settings.push_back({sigma, support});
    settings.push_back({sigma, whole});
  }
  return settings;
}

ResultTable sweep_adjustment(const LightField& field, const std::string& name, const OperatorChoice& choice,
                             const std::vector<AdjustmentSetting>& settings, const SweepRun& run) {
  const DisplayLightField mapped = map_field(field, choice, run.threads);
  const double before = NeighbourDifference(field, views_of(mapped)).mean();
  std::map<double, Views> references;  // by sigma
  // Each width of the filter has a result of its own that supports approximate, so fronts are theirs alone.
  std::map<double, std::vector<SweepOutcome>> outcomes;
  std::size_t done = 0;
  for (const AdjustmentSetting& setting : settings) {
    Views& reference = references[setting.sigma_views];
    if (reference.empty())
      reference = adjust(field, mapped, {setting.sigma_views, whole_grid(field.grid())}, run.threads).views;
    const Adjusted adjusted = adjust(field, mapped, setting, run.threads);
    DifferenceSum difference;
    for (std::size_t i = 0; i < reference.size(); ++i) difference.add(adjusted.views[i], reference[i]);
    SweepOutcome& outcome = outcomes[setting.sigma_views].emplace_back();
    outcome.setting = {{"sigma_views", setting.sigma_views}, {"support_views", setting.support_views}};
    outcome.error = difference.rms();
    outcome.values = {
        {"rms_error", difference.rms(), "1"},
        {"max_error", difference.largest(), "1"},
        {"neighbour_difference", NeighbourDifference(field, adjusted.views).mean(), "luma"},
        {"neighbour_difference_before", before, "luma"},
        {"correspondences_per_pixel",
         static_cast<double>(adjusted.counts.correspondences) / static_cast<double>(adjusted.counts.pixels),
         "1"}};
    time_setting(
        outcome, [&] { adjust(field, mapped, setting, run.threads); }, run.runs);
    ++done;
    if (run.progress) run.progress(static_cast<double>(done) / static_cast<double>(settings.size()));
  }
  ResultTable table;
  for (const auto& [sigma, of_sigma] : outcomes) add_outcome_rows(table, {{"light_field", name}}, of_sigma);
  return table;
}

SweepPlotDesign adjustment_sweep_plot() {
  return {"rms_error", "RMS error of channel values", "1", {"sigma_views"}, "support_views"};
}

}  // namespace plenolab
