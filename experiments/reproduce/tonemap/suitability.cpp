#include "experiments/reproduce/tonemap/suitability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/quantile.h"
#include "core/image/colour.h"
#include "experiments/reproduce/tonemap/mapping_bench.h"

namespace plenolab {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

/// log10 of the luminance of a view as operators see it: defects repaired, luminance 0 floored.
Plane<float> floored_log_luminance(const SceneImage& view, double floor) {
  SceneImage repaired = view;
  repair(repaired);
  Plane<float> logs(view.width(), view.height());
  std::transform(repaired.pixels().begin(), repaired.pixels().end(), logs.pixels().begin(), [&](Rgb c) {
    const float l = luminance(c);
    return std::log10(l > 0 ? l : static_cast<float>(floor));
  });
  return logs;
}

/// Heights along the camera's up axis, which is the scene's but for the pitch of the camera.
Plane<float> heights(const ViewGrid& grid, const GridCamera& camera, const Plane<float>& depth_m, int row) {
  Plane<float> height(depth_m.width(), depth_m.height());
  const double focal_px = grid.width / (2 * std::tan(grid.fov_h_deg * kDegree / 2));
  const double upwards_m = ((grid.rows - 1) / 2.0 - row) * grid.spacing_y_m;
  const double start = camera.centre_m.z() + upwards_m * camera.up.z();
  for (int y = 0; y < height.height(); ++y) {
    const double slope = (grid.height / 2.0 - y - 0.5) / focal_px;
    const double rise = camera.forward.z() + slope * camera.up.z();
    for (int x = 0; x < height.width(); ++x) {
      const double depth = depth_m.at(x, y);
      height.at(x, y) = static_cast<float>(std::isfinite(depth) ? start + depth * rise : start);
    }
  }
  return height;
}

std::vector<double> sorted_values(const Plane<float>& values, const Mask& mask) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (mask.pixels()[i] != 0 && std::isfinite(values.pixels()[i]))
      kept.push_back(static_cast<double>(values.pixels()[i]));
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// A mask of the pixels for which `keep(index)` holds.
template <class Keep>
Mask mask_where(int width, int height, const Keep& keep) {
  Mask mask(width, height);
  for (std::size_t i = 0; i < mask.size(); ++i) mask.pixels()[i] = keep(i) ? 1 : 0;
  return mask;
}

}  // namespace

SectionOperator section_operator(const std::string& label, const std::string& id, const std::string& variant,
                                 const std::vector<std::string>& settings) {
  return {label, choose_operator({id, variant, settings})};
}

std::vector<SectionOperator> section_operators() {
  return {section_operator("Histogram adjustment", "histogram", "naive"),
          section_operator("Bilateral, enhanced", "bilateral", "enhanced"),
          section_operator("Reinhard 2005, naive", "reinhard05", "naive"),
          section_operator("Robust adaptive", "robust", "naive")};
}

SectionScene::SectionScene(Laboratory& laboratory, std::string id)
    : id_(std::move(id)),
      title_(laboratory.scene(id_).title),
      camera_(laboratory.scene(id_).camera),
      field_(laboratory.light_field(id_)),
      threads_(laboratory.options().threads),
      statistics_(laboratory.mapping_bench().statistics(id_)) {}

std::vector<int> SectionScene::middle_row() const {
  std::vector<int> views(static_cast<std::size_t>(grid().columns));
  std::iota(views.begin(), views.end(), grid().rows / 2 * grid().columns);
  return views;
}

SectionView SectionScene::view(int index) const {
  const int column = index % grid().columns, row = index / grid().columns;
  SectionView view;
  view.name = fmt::format("{}, {}", column, row);
  view.data = operator_view(field_, column, row);
  view.log_luminance = floored_log_luminance(*view.data.colour, statistics_.floor);
  const ImageStatistics s = statistics_.of_view(static_cast<std::size_t>(index));
  view.log_p1 = s.log_p1;
  view.log_p99 = s.log_p99;
  view.depth_m = *view.data.disparity;
  for (float& v : view.depth_m.pixels()) v = static_cast<float>(grid().depth_m(static_cast<double>(v)));
  view.height_m = heights(grid(), camera_, view.depth_m, row);
  return view;
}

const FittedOperator& SectionScene::joint_fit(const SectionOperator& chosen) {
  const OperatorChoice& c = chosen.choice;
  const std::string key = fmt::format("{} {} {}", c.info->id, c.variant.id, settings_text(c));
  const auto known = joint_fits_.find(key);
  if (known != joint_fits_.end()) return known->second;
  return joint_fits_
      .emplace(key, c.info->fit(c.variant.id, c.values, scope_of_light_field(field_, statistics_, threads_)))
      .first->second;
}

DisplayImage SectionScene::map(const SectionOperator& chosen, int index) {
  const OperatorChoice& c = chosen.choice;
  const int column = index % grid().columns, row = index / grid().columns;
  const OperatorView data = operator_view(field_, column, row);
  if (c.variant.scope == OperatorScope::kLightField) return joint_fit(chosen).apply(data, threads_).image;
  return c.info->fit(c.variant.id, c.values, scope_of_view(field_, statistics_, column, row, threads_))
      .apply(data, threads_)
      .image;
}

Plane<float> luma_plane(const DisplayImage& image) {
  Plane<float> luma(image.width(), image.height());
  std::transform(image.pixels().begin(), image.pixels().end(), luma.pixels().begin(),
                 [](Rgb c) { return luminance(c); });
  return luma;
}

Mask whole(const Plane<float>& like) {
  return Mask(like.width(), like.height(), 1);
}

Mask deeper_than(const SectionView& view, double depth_m) {
  const auto& depth = view.depth_m.pixels();
  return mask_where(view.depth_m.width(), view.depth_m.height(),
                    [&](std::size_t i) { return static_cast<double>(depth[i]) > depth_m; });
}

Mask at_heights(const SectionView& view, double low_m, double high_m, double depth_m) {
  const auto &depth = view.depth_m.pixels(), &height = view.height_m.pixels();
  return mask_where(view.depth_m.width(), view.depth_m.height(), [&](std::size_t i) {
    const double h = static_cast<double>(height[i]);
    return static_cast<double>(depth[i]) <= depth_m && h >= low_m && h <= high_m;
  });
}

Mask darker_part(const SectionView& view, const Mask& mask, double p) {
  const std::vector<double> logs = sorted_values(view.log_luminance, mask);
  if (logs.empty()) return mask;
  const double limit = quantile_of_sorted(std::span(logs), p);
  return mask_where(mask.width(), mask.height(), [&](std::size_t i) {
    return mask.pixels()[i] != 0 && static_cast<double>(view.log_luminance.pixels()[i]) < limit;
  });
}

Mask without(const Mask& mask, const Mask& removed) {
  return mask_where(mask.width(), mask.height(),
                    [&](std::size_t i) { return mask.pixels()[i] != 0 && removed.pixels()[i] == 0; });
}

Mask both(const Mask& a, const Mask& b) {
  return mask_where(a.width(), a.height(),
                    [&](std::size_t i) { return a.pixels()[i] != 0 || b.pixels()[i] != 0; });
}

ToneSpread spread_in(const Plane<float>& values, const Mask& mask, double p) {
  const std::vector<double> sorted = sorted_values(values, mask);
  if (sorted.empty()) return {};
  const auto at = [&](double q) { return quantile_of_sorted(std::span(sorted), q); };
  return {at(p), at(0.5), at(1 - p)};
}

ToneRegion region_of(const SectionView& view, Mask mask, double tail) {
  const ToneSpread log_luminance = spread_in(view.log_luminance, mask, tail);
  return {std::move(mask), tail, log_luminance};
}

double relative_contrast(double luma, double log_luminance, const SectionView& view) {
  return log_luminance != 0 ? luma * view.log_range() / log_luminance : 0;
}

double contrast_within(const SectionView& view, const ToneRegion& region, const ToneSpread& luma) {
  return relative_contrast(luma.range(), region.log_luminance.range(), view);
}

DisplayImage region_map(const DisplayImage& image, const std::vector<RegionMark>& marks) {
  DisplayImage map = image;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const float luma = luminance(image.pixels()[i]);
    map.pixels()[i] = Rgb{1, 1, 1} * (0.5f * luma);
    for (const RegionMark& mark : marks)
      if (mark.mask.pixels()[i] != 0) map.pixels()[i] = mark.colour * (0.3f + 0.7f * luma);
  }
  return map;
}

}  // namespace plenolab
