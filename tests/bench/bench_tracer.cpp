// Rays per second of the path tracer, and what share of Embree's bare rate it keeps. One thread each, so that
// figures can be compared; multiply by the cores.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/random.h"
#include "stimuli/render.h"
#include "stimuli/scenes/table.h"
#include "stimuli/tracer/ray_scene.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

// A closed room with a lamp and six spheres of 2 × 48² × 2 triangles.
Scene box_interior() {
  Scene scene = empty_scene();
  scene.materials = {diffuse(0.6f), lamp({2000, 2000, 2000}, false)};
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    scene.meshes.push_back(parallelogram(corner, u, v, 0));
  };
  wall({-2, -1, -1}, {4, 0, 0}, {0, 6, 0});
  wall({-2, -1, 2}, {4, 0, 0}, {0, 6, 0});
  wall({-2, 5, -1}, {4, 0, 0}, {0, 0, 3});
  wall({-2, -1, -1}, {4, 0, 0}, {0, 0, 3});
  wall({-2, -1, -1}, {0, 6, 0}, {0, 0, 3});
  wall({2, -1, -1}, {0, 6, 0}, {0, 0, 3});
  for (int i = 0; i < 6; ++i)
    scene.meshes.push_back(sphere({-1.5f + 0.6f * static_cast<float>(i), 3, -0.7f}, 0.28f, 48, 0, true));
  scene.meshes.push_back(parallelogram({-0.5f, 2, 1.95f}, {0, 1, 0}, {1, 0, 0}, 1));
  return scene;
}

void report(benchmark::State& state, std::uint64_t rays) {
  state.counters["Mrays/s"] =
      benchmark::Counter(static_cast<double>(rays) * 1e-6, benchmark::Counter::kIsRate);
}

// The limit: closest hits of camera rays (coherent) or of rays between random points of the room (incoherent)
// without any shading.
void bare_embree(benchmark::State& state) {
  const Scene scene = box_interior();
  const tracer::RayScene rays(scene);
  const bool coherent = state.range(0) == 0;
  std::vector<tracer::Ray> batch;
  for (std::uint64_t i = 0; i < (1u << 16); ++i) {
    RandomStream random(1, 1, i);
    const float x = random.next_float() - 0.5f, y = random.next_float() - 0.5f,
                z = random.next_float() - 0.5f;
    const auto column = static_cast<float>(i % 256) / 256 - 0.5f,
               row = static_cast<float>(i / 256) / 256 - 0.5f;
    const Vec3 origin = coherent ? Vec3(0, 0, 0) : Vec3(3.8f * x, 2 + 5.8f * y, 0.5f + 2.8f * z);
    const Vec3 direction =
        coherent ? Vec3(1.1f * column, 1, -0.7f * row)
                 : Vec3(random.next_float() - 0.5f, random.next_float() - 0.5f, random.next_float() - 0.5f);
    batch.push_back({origin, direction.normalized()});
  }
  float sum = 0;
  std::uint64_t count = 0;
  for (auto _ : state) {
    for (const auto& ray : batch) sum += rays.distance(ray);
    count += batch.size();
  }
  benchmark::DoNotOptimize(sum);
  report(state, count);
}
BENCHMARK(bare_embree)->Arg(0)->Arg(1)->ArgName("incoherent")->Unit(benchmark::kMillisecond);

void render_rays(benchmark::State& state, const Scene& scene, const ViewGrid& grid) {
  const PreparedScene prepared(scene);
  prepared.state();
  RenderSettings settings;
  settings.paths_per_pixel = 16;
  settings.threads = 1;
  std::uint64_t count = 0;
  for (auto _ : state) count += render_view(prepared, grid, {0, 0}, settings).stats.rays();
  report(state, count);
}

const ViewGrid kBenchGrid{1, 1, 0.1, 0.1, 96, 54, 60};

// Camera rays only: disparity of a scene without light.
void primary_rays(benchmark::State& state) {
  Scene scene = box_interior();
  scene.meshes.pop_back();
  render_rays(state, scene, kBenchGrid);
}
BENCHMARK(primary_rays)->Unit(benchmark::kMillisecond);

void diffuse_bounces(benchmark::State& state) {
  Scene scene = box_interior();
  scene.max_bounces = static_cast<int>(state.range(0));
  render_rays(state, scene, kBenchGrid);
}
BENCHMARK(diffuse_bounces)->Arg(1)->Arg(2)->Arg(6)->ArgName("bounces")->Unit(benchmark::kMillisecond);

// The scenes of the table as they are.
void whole_scene(benchmark::State& state) {
  const SceneEntry& entry = scenes()[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(entry.id);
  ViewGrid grid = grid_of(entry.build(), Preset::kQuick);
  grid.height = std::max(1, 96 * grid.height / grid.width);
  grid.width = 96;
  render_rays(state, entry.build(), grid);
}
BENCHMARK(whole_scene)->DenseRange(0, static_cast<int>(scenes().size()) - 1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plenolab
