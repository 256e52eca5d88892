#include "experiments/reproduce/tonemap/trimming_consistency.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Compares view `i` of a grid with those of its cells that were mapped before it.
void compare_with_earlier(TrimmingConsistency& result, const Mapping& mapping,
                          const std::vector<MappedKeyView>& views, std::size_t i, const ViewGrid& grid) {
  const int columns = grid.columns, column = static_cast<int>(i) % columns,
            row = static_cast<int>(i) / columns;
  constexpr std::pair<int, int> kSteps[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
  for (const auto& [right, down] : kSteps) {
    const int from_column = column - right, from_row = row - down;
    if (from_column < 0 || from_column >= columns || from_row < 0) continue;
    const MappedKeyView& from = views[static_cast<std::size_t>(from_row * columns + from_column)];
    const ViewMotion motion{.x = static_cast<double>(right), .y = down * grid.vertical_ratio()};
    ++result.cell_pairs;
    if (from.curve.passes.size() != views[i].curve.passes.size())
      result.different.push_back(mapping.compare_passes(from, views[i], motion));
    if (right != 0 && down != 0) continue;
    const NeighbourChange change = mapping.compare(from, views[i], motion);
    if (change.pixels > 0) result.pairs.push_back(change);
  }
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
    compare_with_earlier(result, mapping, views, i, grid);
    if (i > columns) views[i - columns - 1] = {};  // compared with all others of its cells
  }
  return result;
}

TrimmingConsistency count_trimming_passes(const ToneScene& scene, HistogramCeiling ceiling, int threads) {
  const HistogramOptions options{.ceiling = ceiling};
  TrimmingConsistency result{.scene = scene.id, .title = scene.title, .ceiling = ceiling};
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
