#include "experiments/reproduce/tonemap/bilateral_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/base/quantile.h"
#include "experiments/score.h"

namespace plenolab {

namespace {

/// A lamp or a black pixel would leave the pictures of the base grey.
constexpr double kBaseOutliers = 0.01;

}  // namespace

BilateralToneParameters fit_bilateral(const ToneScene& scene, const BilateralToneOptions& options,
                                      int threads) {
  BaseHistogram bases;
  for (std::size_t i = 0; i < scene.views(); ++i) {
    const OperatorView view = scene.view(i);
    bases = merge(std::move(bases), measure_base(bilateral_layers(options, *view.colour, view.disparity.get(),
                                                                  scene.statistics.floor, threads)));
  }
  return fit(options, range_of(bases, options.outliers), scene.statistics.floor);
}

ToneScene cellar_scene(Laboratory& laboratory) {
  return tone_scene(laboratory, "cellar");
}

BilateralView map_middle_of_cellar(Laboratory& laboratory, const ToneScene& cellar, bool enhanced) {
  const int threads = laboratory.options().threads;
  const std::size_t middle = middle_view(cellar.field.grid());
  const OperatorView view = cellar.view(middle);
  BilateralView result;
  result.title = fmt::format("{}, key view {}", cellar.title, view_name(cellar.field.grid(), middle));
  result.parameters = fit_bilateral(cellar, {.enhanced = enhanced}, threads);
  result.layers = bilateral_layers(result.parameters.options, *view.colour, view.disparity.get(),
                                   result.parameters.floor, threads);
  result.mapped = apply(result.parameters, *view.colour, view.disparity.get(), threads).image;
  result.shown = picture_layers(result.layers, kBaseOutliers);
  return result;
}

double range_without_outliers(const Plane<float>& layer) {
  std::vector<float> values(layer.pixels().begin(), layer.pixels().end());
  std::sort(values.begin(), values.end());
  const std::span<const float> sorted(values);
  return quantile_of_sorted(sorted, 0.99) - quantile_of_sorted(sorted, 0.01);
}

void add_view_rows(ReproductionResult& result, const BilateralView& view, const std::string& name) {
  const Columns columns{{"scene", std::string("cellar")}, {"operator", name}};
  const auto add = [&](const char* quantity, double value, const char* unit) {
    result.rows.add({quantity, value, unit, columns});
  };
  add("compression", view.parameters.compression, "1");
  add("brightness", view.parameters.brightness, "log10 units");
  add("range_luminance", range_without_outliers(view.layers.log_luminance), "log10 units");
  add("range_base", range_without_outliers(view.layers.base), "log10 units");
  add("range_target", range_without_outliers(target_log_luminance(view.parameters, view.layers)),
      "log10 units");
  add("detail_scale", view.shown.detail_scale, "log10 units");
  add("detail_cut", static_cast<double>(view.shown.detail_cut), "px");
}

}  // namespace plenolab
