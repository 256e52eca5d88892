#include "experiments/reproduce/tonemap/edge_profile.h"
#include "experiments/score.h"

#include <algorithm>
#include <cmath>

namespace plenolab {

namespace {

constexpr int kEdge_px = kEdgeWidth_px / 2;
constexpr int kHeight_px = 65;  // σ_s = 10.24 px, followed to three σ_s to either side of the middle row
constexpr int kShown_px = 45;   // to either side of the edge
constexpr double kCompression = 0.4;
constexpr float kNear_px = 12, kFar_px = 2;  // disparities twenty σ_d apart

KeyView<SceneReferred> edge_view() {
  KeyView<SceneReferred> view{SceneImage(kEdgeWidth_px, kHeight_px, Rgb{1, 1, 1}),
                              DisparityMap(kEdgeWidth_px, kHeight_px, kFar_px)};
  const float bright = static_cast<float>(std::pow(10.0, kEdgeStep_log10));
  for (int y = 0; y < kHeight_px; ++y)
    for (int x = 0; x < kEdge_px; ++x) {
      view.colour.at(x, y) = {bright, bright, bright};
      view.disparity.at(x, y) = kNear_px;
    }
  return view;
}

std::vector<double> middle_row(const Plane<float>& plane) {
  if (plane.empty()) return {};
  const float* row = plane.row(kHeight_px / 2);
  return {row, row + kEdgeWidth_px};
}

double at(const std::vector<double>& row, int x) {
  return row[static_cast<std::size_t>(x)];
}

PlotSeries series_of(const char* title, const std::vector<double>& row) {
  PlotSeries series{.title = title, .style = PlotSeries::Style::kLines, .points = {}};
  for (int x = kEdge_px - kShown_px; x < kEdge_px + kShown_px; ++x)
    series.points.push_back({.x = x + 0.5 - kEdge_px, .y = at(row, x)});
  return series;
}

}  // namespace

double EdgeProfile::input_step() const {
  return at(input, kEdge_px - 1) - at(input, kEdge_px);
}
double EdgeProfile::target_step() const {
  return at(target, kEdge_px - 1) - at(target, kEdge_px);
}
double EdgeProfile::target_level() const {
  return at(target, kEdge_px / 2) - at(target, kEdge_px + kEdge_px / 2);
}
double EdgeProfile::foreground_profile() const {
  return at(target, kEdge_px - 1) - at(target, kEdge_px / 2);
}
double EdgeProfile::background_profile() const {
  return at(target, kEdge_px) - at(target, kEdge_px + kEdge_px / 2);
}

EdgeProfile trace_edge(EdgeOperator which, int threads) {
  BilateralToneOptions options{
      .enhanced = which != EdgeOperator::kNaive, .exact = true, .compression = kCompression, .brightness = 0};
  if (which == EdgeOperator::kWithoutForeground) options.foreground_scale = 0;
  const KeyView<SceneReferred> view = edge_view();
  const BilateralLayers layers = bilateral_layers(options, view.colour, &view.disparity, 1, threads);
  EdgeProfile profile;
  profile.input = middle_row(layers.log_luminance);
  profile.base = middle_row(layers.base);
  profile.detail = middle_row(layers.detail());
  profile.target = middle_row(target_log_luminance(fit(options, BaseRange{}, 1), layers));
  if (which != EdgeOperator::kEnhanced) return profile;
  profile.foreground = middle_row(layers.foreground);
  profile.temporary = profile.base;
  for (std::size_t i = 0; i < profile.temporary.size(); ++i) profile.temporary[i] -= profile.foreground[i];
  return profile;
}

void add_edge(ReproductionResult& result, const EdgeProfile& profile, const std::string& name,
              const std::string& caption) {
  Plot plot;
  plot.x = {.title = "Distance from the depth edge; foreground on the left", .unit = "px"};
  plot.y = {.title = "Luminance, layers", .unit = "log10 units"};
  plot.key = KeyPosition::kOutside;
  plot.series = {series_of("input", profile.input), series_of("base", profile.base),
                 series_of("detail", profile.detail)};
  if (!profile.foreground.empty()) {
    plot.series.push_back(series_of("temporary", profile.temporary));
    plot.series.push_back(series_of("foreground", profile.foreground));
  }
  plot.series.push_back(series_of("target", profile.target));
  result.add_plot(name, {plot, caption, caption});
  const Columns columns{{"operator", name}};
  const auto add = [&](const char* quantity, double value) {
    result.rows.add({quantity, value, "log10 units", columns});
  };
  add("edge_step_input", profile.input_step());
  add("edge_step_target", profile.target_step());
  add("level_difference_target", profile.target_level());
  add("profile_foreground", profile.foreground_profile());
  add("profile_background", profile.background_profile());
}

}  // namespace plenolab
