#include "experiments/reproduce/tonemap/trimming_consistency.h"

#include <algorithm>
#include <cmath>

#include "metrics/consistency.h"

namespace plenolab {

namespace {

/// A key view, the curve it is mapped with, and the result.
struct MappedKeyView {
  OperatorView view;
  LogHistogram histogram;
  HistogramParameters curve;
  DisplayImage image;

  ConsistencyView shown(const DisplayImage& mapped) const { return {mapped, *view.colour, *view.disparity}; }
};

/// The views of a scene with the settings that they are mapped with.
class Mapping {
 public:
  Mapping(const ToneScene& scene, const HistogramOptions& options, int threads)
      : scene_(scene), options_(options), threads_(threads) {}

  MappedKeyView map(std::size_t index) const {
    MappedKeyView mapped{
        scene_.view(index), histogram_of_view(scene_, index, options_.bins, threads_), {}, {}};
    mapped.curve = fit(options_, mapped.histogram, scene_.statistics.floor);
    mapped.image = image_of(mapped, mapped.curve);
    return mapped;
  }

  NeighbourChange compare(const MappedKeyView& from, const MappedKeyView& to,
                          const ViewMotion& motion) const {
    const LineChange change = change_to(from, to, to.image, motion);
    return {change.pixels, change.rms, change_to(from, to, image_of(to, from.curve), motion).rms};
  }

  DifferentPasses compare_passes(const MappedKeyView& from, const MappedKeyView& to,
                                 const ViewMotion& motion) const {
    HistogramOptions options = options_;
    options.fixed_passes = static_cast<int>(from.curve.passes.size());
    const HistogramParameters same = fit(options, to.histogram, scene_.statistics.floor);
    return {change_to(from, to, to.image, motion).rms, change_to(from, to, image_of(to, same), motion).rms};
  }

 private:
  DisplayImage image_of(const MappedKeyView& view, const HistogramParameters& curve) const {
    return apply(curve, *view.view.colour, threads_).image;
  }
  LineChange change_to(const MappedKeyView& from, const MappedKeyView& to, const DisplayImage& image,
                       const ViewMotion& motion) const {
    return change_along_lines(from.shown(from.image), to.shown(image), motion, {.threads = threads_});
  }

  const ToneScene& scene_;
  HistogramOptions options_;
  int threads_;
};

double root_difference(double rms, double floor_rms) {
  return std::sqrt(std::max(0.0, rms * rms - floor_rms * floor_rms));
}

void add_passes(TrimmingConsistency& result, const HistogramParameters& curve) {
  result.passes.push_back(curve.passes.size());
  result.linear_views += curve.linear ? 1 : 0;
}

void compare_neighbours(TrimmingConsistency& result, const Mapping& mapping, const MappedKeyView& from,
                        const MappedKeyView& to, const ViewMotion& motion) {
  ++result.neighbours;
  const NeighbourChange change = mapping.compare(from, to, motion);
  if (change.pixels > 0) result.pairs.push_back(change);
  if (from.curve.passes.size() != to.curve.passes.size())
    result.different.push_back(mapping.compare_passes(from, to, motion));
}

}  // namespace

double NeighbourChange::added() const {
  return root_difference(rms, floor_rms);
}

double DifferentPasses::added() const {
  return root_difference(rms, same_rms);
}

double TrimmingConsistency::mean_added() const {
  double sum = 0;
  for (const NeighbourChange& pair : pairs) sum += pair.added();
  return pairs.empty() ? 0 : sum / static_cast<double>(pairs.size());
}

double TrimmingConsistency::largest_added() const {
  double largest = 0;
  for (const NeighbourChange& pair : pairs) largest = std::max(largest, pair.added());
  return largest;
}

TrimmingConsistency measure_trimming_consistency(const ToneScene& scene, HistogramCeiling ceiling,
                                                 std::optional<int> fixed_passes, int threads) {
  const ViewGrid& grid = scene.field.grid();
  const auto columns = static_cast<std::size_t>(grid.columns);
  const Mapping mapping(scene, {.ceiling = ceiling, .fixed_passes = fixed_passes}, threads);
  TrimmingConsistency result{
      .scene = scene.id, .title = scene.title, .ceiling = ceiling, .fixed_passes = fixed_passes};
  std::vector<MappedKeyView> views;
  for (std::size_t i = 0; i < scene.views(); ++i) {
    views.push_back(mapping.map(i));
    add_passes(result, views.back().curve);
    if (i % columns > 0) compare_neighbours(result, mapping, views[i - 1], views[i], {.x = 1});
    if (i < columns) continue;
    compare_neighbours(result, mapping, views[i - columns], views[i], {.y = grid.vertical_ratio()});
    views[i - columns] = {};  // compared with both of its neighbours
  }
  return result;
}

TrimmingConsistency count_trimming_passes(const ToneScene& scene, const HistogramOptions& options,
                                          int threads) {
  TrimmingConsistency result{.scene = scene.id,
                             .title = scene.title,
                             .ceiling = options.ceiling,
                             .fixed_passes = options.fixed_passes};
  for (std::size_t i = 0; i < scene.views(); ++i)
    add_passes(result,
               fit(options, histogram_of_view(scene, i, options.bins, threads), scene.statistics.floor));
  return result;
}

double visible_luma_change() {
  constexpr double kLuma = 0.5, kGamma = 2.2;
  const HistogramOptions display;
  const double range = display.display_max_cd_m2 - display.display_min_cd_m2;
  const double above_black = range * std::pow(kLuma, kGamma);
  const double step = just_noticeable_difference_cd_m2(display.display_min_cd_m2 + above_black);
  return kLuma / kGamma * step / above_black;
}

}  // namespace plenolab
