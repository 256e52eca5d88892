#include "experiments/reproduce/claims/appearance_floor.h"

#include <algorithm>
#include <cmath>

namespace plenolab {
namespace {

constexpr float kLeastHeight = 0.08f;
constexpr float kSpotShare = 1.0f / 8;
constexpr double kSpotMargin_px = 5;
constexpr double kStrengthMargin_px = 9;

/// Disparity of the floor where the lamp's reflection is seen.
double floor_disparity_px(const FloorLamp& lamp, const Scene& scene, const ViewGrid& grid,
                          CameraPosition position) {
  // The eye is as high above the floor as the way to the reflection is long above it, as a share.
  const double eye_m =
      static_cast<double>(scene.camera.centre_m.z()) -
      (position.t - (grid.rows - 1) / 2.0) * grid.spacing_y_m * static_cast<double>(scene.camera.up.z());
  const double below_m = -static_cast<double>(lamp.reflection_m.z());
  return project(scene.camera, grid, position, lamp.reflection_m).disparity_px * (eye_m + below_m) / eye_m;
}

bool all_valid(const Mask& valid, const Window& window) {
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x)
      if (valid.at(x, y) == 0) return false;
  return window.width > 0 && window.height > 0;
}

}  // namespace

std::vector<TwinView> floor_views(Laboratory& laboratory, const FloorLook& look, double spacing_m) {
  return render_twins(laboratory, {.scene = floor_probe(look),
                                   .grid = appearance_grid(laboratory, spacing_m),
                                   .exposure = kFloorExposure,
                                   .positions = {{0.5, 0.5}, {0.35, 0.45}}});
}

std::vector<LampCopies> copies_of_lamps(const TwinView& view, const Scene& scene, const ViewGrid& grid) {
  const Plane<float> synthesised = luma_of(view.synthesised), truth = luma_of(view.truth);
  std::vector<LampCopies> all;
  for (const FloorLamp& lamp : floor_lamps()) {
    const ImagePoint at = project(scene.camera, grid, view.position, lamp.reflection_m);
    LampCopies copies;
    copies.displacement_px = floor_disparity_px(lamp, scene, grid, view.position) - at.disparity_px;
    const double reach = copies.displacement_px / 2 + kSpotMargin_px;
    const Window window = window_around(grid, at.x, at.y, reach, reach);
    const float height = peak_height(truth, window);
    if (height < kLeastHeight || !all_valid(view.valid, window)) continue;
    copies.spots = count_spots(synthesised, window, height * kSpotShare);
    copies.truth_spots = count_spots(truth, window, height * kSpotShare);
    const Window wide = window_around(grid, at.x, at.y, copies.displacement_px + kStrengthMargin_px,
                                      copies.displacement_px / 2 + kStrengthMargin_px);
    copies.strength = autocorrelation(synthesised, wide, copies.displacement_px) -
                      autocorrelation(truth, wide, copies.displacement_px);
    all.push_back(copies);
  }
  return all;
}

std::vector<LampCopies> copies_of_lamps(std::span<const TwinView> views, const Scene& scene,
                                        const ViewGrid& grid) {
  std::vector<LampCopies> all;
  for (const TwinView& view : views)
    for (const LampCopies& copies : copies_of_lamps(view, scene, grid)) all.push_back(copies);
  return all;
}

std::optional<Interval> mean_spots(std::span<const LampCopies> lamps, std::uint64_t seed) {
  std::vector<double> values;
  for (const LampCopies& lamp : lamps) values.push_back(lamp.spots);
  return mean_interval(values, seed);
}

std::optional<Interval> mean_strength(std::span<const LampCopies> lamps, std::uint64_t seed) {
  std::vector<double> values;
  for (const LampCopies& lamp : lamps) values.push_back(lamp.strength);
  return mean_interval(values, seed);
}

std::optional<Interval> share_with_copies(std::span<const LampCopies> lamps) {
  if (lamps.size() < 2) return std::nullopt;
  const auto with =
      std::count_if(lamps.begin(), lamps.end(), [](const LampCopies& lamp) { return lamp.has_copies(); });
  return share_interval(static_cast<std::size_t>(with), lamps.size());
}

double mean_truth_spots(std::span<const LampCopies> lamps) {
  double sum = 0;
  for (const LampCopies& lamp : lamps) sum += lamp.truth_spots;
  return lamps.empty() ? 0 : sum / static_cast<double>(lamps.size());
}

}  // namespace plenolab
