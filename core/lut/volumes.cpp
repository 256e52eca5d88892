#include "core/lut/volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;

Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point3& a, const Point3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double content(const Volume& volume) {
  double product = 1;
  for (std::size_t k = 0; k < 3; ++k) product *= volume.max[k] - volume.min[k];
  return product;
}

double squared_diagonal(const Volume& volume) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += std::pow(volume.max[k] - volume.min[k], 2);
  return sum;
}

double linear_weight(const Volume& volume, const Point3& camera_m) {
  const double distance = volume.distance_m(camera_m);
  if (distance == 0) return volume.weight;
  return distance < volume.blend_radius_m ? volume.weight * (1 - distance / volume.blend_radius_m) : 0;
}

void require_finite(const Point3& camera_m) {
  for (const double coordinate : camera_m)
    if (!std::isfinite(coordinate)) throw InputError("the camera's position is not finite");
}

VolumeWeights with_background(std::vector<double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (sum > 1)
    for (double& weight : weights) weight /= sum;
  return {std::move(weights), std::max(0.0, 1 - sum)};
}

}  // namespace

void Volume::validate() const {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::isfinite(min[k]) && std::isfinite(max[k]) && min[k] <= max[k]))
      throw InputError(fmt::format("volume '{}' reaches from {:g} to {:g} m along axis {}, which is no range",
                                   name, min[k], max[k], k + 1));
  if (!(blend_radius_m >= 0 && std::isfinite(blend_radius_m)))
    throw InputError(
        fmt::format("volume '{}': the blend radius is {} m but must be ≥ 0", name, blend_radius_m));
  if (!(weight >= 0 && weight <= 1))
    throw InputError(fmt::format("volume '{}': the weight is {} but must lie in [0, 1]", name, weight));
}

bool Volume::contains(const Point3& point) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(point[k] >= min[k] && point[k] <= max[k])) return false;
  return true;
}

double Volume::distance_m(const Point3& point) const {
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k) squares += std::pow(point[k] - std::clamp(point[k], min[k], max[k]), 2);
  return std::sqrt(squares);
}

std::vector<int> innermost_first(std::span<const Volume> volumes) {
  std::vector<int> order(volumes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto size_of = [&](int i) {
    const Volume& volume = volumes[static_cast<std::size_t>(i)];
    return std::pair(content(volume), squared_diagonal(volume));
  };
  std::ranges::stable_sort(order, [&](int a, int b) { return size_of(a) < size_of(b); });
  return order;
}

int innermost(std::span<const Volume> volumes, const Point3& point) {
  for (const int i : innermost_first(volumes))
    if (volumes[static_cast<std::size_t>(i)].contains(point)) return i;
  return -1;
}

VolumeWeights linear_weights(std::span<const Volume> volumes, const Point3& camera_m) {
  for (const Volume& volume : volumes) volume.validate();
  require_finite(camera_m);
  std::vector<double> weights(volumes.size(), 0.0);
  const int inside = innermost(volumes, camera_m);
  if (inside >= 0) {
    weights[static_cast<std::size_t>(inside)] = volumes[static_cast<std::size_t>(inside)].weight;
  } else {
    for (std::size_t i = 0; i < volumes.size(); ++i) weights[i] = linear_weight(volumes[i], camera_m);
  }
  return with_background(std::move(weights));
}

void DepthCamera::validate() const {
  if (!(fov_h_deg > 0 && fov_h_deg < 180))
    throw InputError(
        fmt::format("the camera's opening angle is {}° but must lie between 0 and 180°", fov_h_deg));
  const auto is_unit = [](const Point3& v) { return std::abs(dot(v, v) - 1) < 1e-5; };
  if (!is_unit(forward) || !is_unit(up) || !(std::abs(dot(forward, up)) < 1e-5))
    throw InputError("the camera's forward and up must be unit vectors at right angles");
  require_finite(position_m);
}

Point3 DepthCamera::world_of(int x, int y, int width, int height, double depth_m) const {
  const double pixel = 2 * std::tan(fov_h_deg * std::numbers::pi / 360) / width;
  const double to_right = (x + 0.5 - 0.5 * width) * pixel, upwards = (0.5 * height - y - 0.5) * pixel;
  const Point3 right = cross(forward, up);
  Point3 world;
  for (std::size_t k = 0; k < 3; ++k)
    world[k] = position_m[k] + depth_m * (forward[k] + to_right * right[k] + upwards * up[k]);
  return world;
}

std::int64_t VolumeCounts::pixels() const {
  return std::accumulate(volumes.begin(), volumes.end(), background);
}

Plane<int> volume_of_pixels(const Plane<float>& depth_m, const DepthCamera& camera,
                            std::span<const Volume> volumes, int threads) {
  camera.validate();
  for (const Volume& volume : volumes) volume.validate();
  const std::vector<int> order = innermost_first(volumes);
  Plane<int> owner(depth_m.width(), depth_m.height(), -1);
  parallel_for(depth_m.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < depth_m.width(); ++x) {
        const double depth = depth_m.at(x, y);
        if (!(depth > 0 && std::isfinite(depth))) continue;
        const Point3 world = camera.world_of(x, y, depth_m.width(), depth_m.height(), depth);
        const auto found = std::ranges::find_if(
            order, [&](int i) { return volumes[static_cast<std::size_t>(i)].contains(world); });
        if (found != order.end()) owner.at(x, y) = *found;
      }
  });
  return owner;
}

VolumeWeights pixel_weights(const VolumeCounts& counts, std::span<const Volume> volumes) {
  PLENOLAB_CHECK(counts.volumes.size() == volumes.size(), "one count for each volume");
  std::vector<double> weights(volumes.size(), 0.0);
  const std::int64_t pixels = counts.pixels();
  for (std::size_t i = 0; i < volumes.size() && pixels > 0; ++i)
    weights[i] = volumes[i].weight * static_cast<double>(counts.volumes[i]) / static_cast<double>(pixels);
  return with_background(std::move(weights));
}

Lut blend_volumes(const VolumeWeights& weights, std::span<const Lut> tables, const Lut& background) {
  PLENOLAB_CHECK(weights.volumes.size() == tables.size(), "one table for each volume");
  std::vector<WeightedLut> shares{{&background, weights.background}};
  for (std::size_t i = 0; i < tables.size(); ++i) shares.push_back({&tables[i], weights.volumes[i]});
  return blend_luts(shares);
}

}  // namespace plenolab
