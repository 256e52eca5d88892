#include "stimuli/render.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "stimuli/tracer/path_tracer.h"

namespace plenolab {

struct PreparedScene::State {
  explicit State(const Scene& scene) : world(scene), needed(tracer::features_of(scene, left_out)) {}
  tracer::World world;
  std::vector<PrunedStage> left_out;
  tracer::Features needed;
};

struct PreparedScene::Shared {
  Scene scene;
  std::once_flag preparation;
  std::optional<State> state;
};

namespace {

constexpr std::uint64_t kCameraNoise = 0x706c656e6f6c6162ull;  // purpose of the random numbers of a view

/// A camera of the grid in world coordinates.
struct Camera {
  Vec3 position, right, down, forward;
  double focal_px, width, height;
};

Camera camera_at(const Scene& scene, const ViewGrid& grid, CameraPosition at) {
  const GridCamera& c = scene.camera;
  const Vec3 right = c.forward.cross(c.up);
  const auto x = static_cast<float>((at.s - (grid.columns - 1) / 2.0) * grid.spacing_x_m);
  const auto y = static_cast<float>((at.t - (grid.rows - 1) / 2.0) * grid.spacing_y_m);
  return {c.centre_m + x * right - y * c.up,
          right,
          -c.up,
          c.forward,
          grid.width / (2.0 * std::tan(grid.fov_h_deg * std::numbers::pi / 360.0)),
          static_cast<double>(grid.width),
          static_cast<double>(grid.height)};
}

/// Ray through a point of the delivered image.
tracer::Ray camera_ray(const Camera& camera, double x, double y) {
  const auto a = static_cast<float>((x - camera.width / 2) / camera.focal_px);
  const auto b = static_cast<float>((y - camera.height / 2) / camera.focal_px);
  return {camera.position, (camera.forward + a * camera.right + b * camera.down).normalized()};
}

/// Everything the samples of a view share.
struct ViewJob {
  const PreparedScene::State& state;
  tracer::Features features;
  Camera camera;
  double disparity_times_depth;  ///< disparity = this · 1/z
  std::uint64_t view_seed;
  std::uint32_t paths;
};

ViewJob make_job(const PreparedScene& scene, const ViewGrid& grid, CameraPosition at,
                 const RenderSettings& settings) {
  grid.validate();
  settings.validate();
  if (settings.row_begin >= grid.height || settings.row_end > grid.height)
    throw InputError(fmt::format("rows {} to {} do not lie within the {} rows of the image",
                                 settings.row_begin, settings.row_end, grid.height));
  if (!std::isfinite(at.s) || !std::isfinite(at.t))
    throw InputError(fmt::format("the camera position ({}, {}) is not finite", at.s, at.t));
  const std::uint64_t position =
      mix64(std::bit_cast<std::uint64_t>(at.s + 0.0)) ^ std::bit_cast<std::uint64_t>(at.t + 0.0);
  return {scene.state(),
          settings.prune ? scene.state().needed : tracer::Features::all(),
          camera_at(scene.scene(), grid, at),
          grid.disparity_px(1.0),
          random_u64(settings.seed, kCameraNoise, position),
          static_cast<std::uint32_t>(settings.paths_per_pixel)};
}

/// The 4 × 4 samples of one delivered pixel, row by row.
struct BlockSums {
  std::array<Rgb, kBlockSamples> radiance{};
  std::array<float, kBlockSamples> disparity_px{};
};

void check_radiance(Rgb c, int x, int y) {
  const auto good = [](float v) { return v >= 0 && std::isfinite(v); };
  PLENOLAB_CHECK(good(c.r) && good(c.g) && good(c.b),
                 fmt::format("radiance ({}, {}, {}) in pixel ({}, {})", c.r, c.g, c.b, x, y));
}

// The paths of a pixel are one low-discrepancy set over the whole block. Any aligned run of 16 points of
// it has exactly one in each of the 4 × 4 samples, so every sample gets the same number.
BlockSums trace_block(const ViewJob& job, int x, int y, tracer::RayCounts& counts) {
  BlockSums sums;
  std::array<double, kBlockSamples> inverse_depth{};
  const auto pixel =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
  const std::uint64_t pixel_seed = mix64(job.view_seed ^ mix64(pixel));
  for (std::uint32_t i = 0; i < job.paths; ++i) {
    const tracer::PathSampler sampler(pixel_seed, i);
    const auto [u, v] = sampler.get_2d(0);
    const auto sample =
        static_cast<std::size_t>(v * kBlockSide) * kBlockSide + static_cast<std::size_t>(u * kBlockSide);
    const tracer::Ray ray = camera_ray(job.camera, x + static_cast<double>(u), y + static_cast<double>(v));
    const tracer::PathResult path = trace_path(job.state.world, job.features, ray, sampler, counts);
    check_radiance(path.radiance, x, y);
    sums.radiance[sample] += path.radiance;
    inverse_depth[sample] +=
        1.0 / (static_cast<double>(path.distance_m) * ray.direction.dot(job.camera.forward));
  }
  const double share = static_cast<double>(kBlockSamples) / job.paths;
  for (std::size_t i = 0; i < kBlockSamples; ++i) {
    sums.radiance[i] = sums.radiance[i] * static_cast<float>(share);
    sums.disparity_px[i] = static_cast<float>(inverse_depth[i] * share * job.disparity_times_depth);
  }
  return sums;
}

// Traces every pixel of the rows asked for, hands the 16 samples of each to `store`, and reports progress row
// by row.
template <class Store>
RenderStats trace_view(const ViewJob& job, const ViewGrid& grid, const PreparedScene& scene,
                       const RenderSettings& settings, const Progress& progress, Store store) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<tracer::RayCounts> row_counts(static_cast<std::size_t>(grid.height));
  const int first = settings.row_begin;
  const int rows = (settings.row_end == 0 ? grid.height : settings.row_end) - first;
  std::mutex mutex;
  int rows_done = 0;
  parallel_for(rows, 1, settings.threads, [&](int begin, int end) {
    for (int y = first + begin; y < first + end; ++y) {
      for (int x = 0; x < grid.width; ++x)
        store(x, y, trace_block(job, x, y, row_counts[static_cast<std::size_t>(y)]));
      if (!progress) continue;
      const std::lock_guard lock(mutex);
      progress(static_cast<double>(++rows_done) / rows);
    }
  });
  RenderStats stats;
  stats.camera_rays = static_cast<std::uint64_t>(grid.width) * static_cast<std::uint64_t>(rows) * job.paths;
  for (const auto& c : row_counts) stats.bounce_rays += c.bounce, stats.shadow_rays += c.shadow;
  stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (settings.prune) stats.pruned = scene.state().left_out;
  return stats;
}

}  // namespace

const GridPreset& preset_of(const Scene& scene, Preset preset) {
  return preset == Preset::kQuick ? scene.quick : scene.paper;
}

ViewGrid grid_of(const Scene& scene, Preset preset) {
  const GridPreset& p = preset_of(scene, preset);
  return {p.columns,
          p.rows,
          p.spacing_x_m,
          p.spacing_y_m,
          p.width,
          p.height,
          static_cast<double>(scene.camera.fov_h_deg)};
}

void RenderSettings::validate() const {
  if (paths_per_pixel < kBlockSamples || paths_per_pixel % kBlockSamples != 0)
    throw InputError(
        fmt::format("the paths per pixel must be a positive multiple of 16, not {}", paths_per_pixel));
  if (threads < 0)
    throw InputError(fmt::format("the number of threads must be 0 (all) or more, not {}", threads));
  if (row_begin < 0 || row_end < 0 || (row_end != 0 && row_end <= row_begin))
    throw InputError(fmt::format("rows {} to {} are no range of rows", row_begin, row_end));
  blocks.validate();
}

double RenderStats::mrays_per_second() const {
  return seconds > 0 ? static_cast<double>(rays()) / seconds * 1e-6 : 0.0;
}

PreparedScene::PreparedScene(const Scene& scene) : shared_(std::make_shared<Shared>()) {
  validate(scene);
  shared_->scene = scene;
}

const Scene& PreparedScene::scene() const {
  return shared_->scene;
}

const PreparedScene::State& PreparedScene::state() const {
  std::call_once(shared_->preparation, [this] { shared_->state.emplace(shared_->scene); });
  return *shared_->state;
}

RenderedView render_view(const PreparedScene& scene, const ViewGrid& grid, CameraPosition position,
                         const RenderSettings& settings, const Progress& progress) {
  const ViewJob job = make_job(scene, grid, position, settings);
  RenderedView result;
  result.view = {SceneImage(grid.width, grid.height), DisparityMap(grid.width, grid.height)};
  result.stats = trace_view(job, grid, scene, settings, progress, [&](int x, int y, const BlockSums& sums) {
    const BlockPixel pixel = preprocess_block(sums.radiance, sums.disparity_px, settings.blocks);
    result.view.colour.at(x, y) = pixel.radiance;
    result.view.disparity.at(x, y) = pixel.disparity_px;
  });
  return result;
}

SampledView render_samples(const PreparedScene& scene, const ViewGrid& grid, CameraPosition position,
                           const RenderSettings& settings, const Progress& progress) {
  const ViewJob job = make_job(scene, grid, position, settings);
  SampledView result;
  result.radiance = SceneImage(grid.width * kBlockSide, grid.height * kBlockSide);
  result.disparity_px = DisparityMap(grid.width * kBlockSide, grid.height * kBlockSide);
  result.stats = trace_view(job, grid, scene, settings, progress, [&](int x, int y, const BlockSums& sums) {
    for (int i = 0; i < kBlockSamples; ++i) {
      const int sx = x * kBlockSide + i % kBlockSide, sy = y * kBlockSide + i / kBlockSide;
      result.radiance.at(sx, sy) = sums.radiance[static_cast<std::size_t>(i)];
      result.disparity_px.at(sx, sy) = sums.disparity_px[static_cast<std::size_t>(i)];
    }
  });
  return result;
}

}  // namespace plenolab
