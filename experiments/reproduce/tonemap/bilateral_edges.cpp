#include "experiments/reproduce/tonemap/bilateral_edges.h"

#include <algorithm>

#include "core/tonemap/bilateral.h"
#include "experiments/reproduce/tonemap/depth_edge_contrast.h"
#include "experiments/reproduce/tonemap/tone_scene.h"

namespace plenolab {

namespace {

constexpr DepthEdgeOptions kLow{.most_contrast_log10 = kLowContrast_log10};
constexpr DepthEdgeOptions kAny;
constexpr std::size_t kMostViews = 6;

LayerContrast measure_layers(const BilateralLayers& naive, const BilateralLayers& enhanced,
                             const DisparityMap& disparity, const DepthEdgeOptions& options) {
  std::vector<const Plane<float>*> planes{&naive.base, &enhanced.base};
  if (!enhanced.foreground.empty()) planes.push_back(&enhanced.foreground);
  const auto c = contrast_across_depth_edges(naive.log_luminance, disparity, planes, options);
  return {c.input, c.along[0], c.along[1], c.along.size() > 2 ? c.along[2] : 0, c.edges};
}

std::vector<std::size_t> chosen_views(std::size_t views) {
  const std::size_t count = std::min(views, kMostViews);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back((2 * i + 1) * views / (2 * count));
  return chosen;
}

}  // namespace

SceneContrast measure_edge_contrast(Laboratory& laboratory, const std::string& id) {
  const int threads = laboratory.options().threads;
  const ToneScene scene = tone_scene(laboratory, id);
  const BilateralToneOptions naive, enhanced{.enhanced = true};
  SceneContrast result{id, scene.title, 1, {}, {}};
  BaseHistogram bases;
  for (const std::size_t i : chosen_views(scene.views())) {
    const OperatorView view = scene.view(i);
    const double floor = scene.statistics.floor;
    const BilateralLayers plain = bilateral_layers(naive, *view.colour, nullptr, floor, threads);
    const BilateralLayers guided =
        bilateral_layers(enhanced, *view.colour, view.disparity.get(), floor, threads);
    bases = merge(std::move(bases), measure_base(guided));
    result.low.push_back(measure_layers(plain, guided, *view.disparity, kLow));
    result.any.push_back(measure_layers(plain, guided, *view.disparity, kAny));
  }
  result.compression = fit(enhanced, range_of(bases, enhanced.outliers), scene.statistics.floor).compression;
  return result;
}

TargetContrast sum_contrast(const std::vector<LayerContrast>& views, double compression,
                            std::span<const double> drawn) {
  TargetContrast sum;
  const double removed = 1 - compression;
  for (const double index : drawn) {
    const LayerContrast& view = views[static_cast<std::size_t>(index)];
    sum.edges += view.edges;
    sum.input += view.input;
    sum.naive += view.input - removed * view.naive_base;
    sum.without += view.input - removed * view.base;
    sum.with += view.input - removed * (view.base - view.foreground);
  }
  return sum;
}

TargetContrast sum_contrast(const std::vector<LayerContrast>& views, double compression) {
  std::vector<double> all;
  for (std::size_t i = 0; i < views.size(); ++i) all.push_back(static_cast<double>(i));
  return sum_contrast(views, compression, all);
}

}  // namespace plenolab
