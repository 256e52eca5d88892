// Perceptual metrics of a pair of 1920 × 1080, and how they grow with the number of pixels. The counter
// `copies` is the time relative to that of copying both images once in the same run.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <map>

#include "core/base/random.h"
#include "core/image/colour.h"
#include "metrics/brisque.h"
#include "metrics/drim.h"
#include "metrics/feature_distortion.h"
#include "metrics/ssim.h"
#include "metrics/tmqi.h"

namespace plenolab {
namespace {

/// Four decades of light with texture and noise.
SceneImage bench_scene(int width, int height) {
  SceneImage scene(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double light = std::pow(10, 1 + std::sin(0.011 * x) + std::cos(0.017 * y));
      const double texture = 1 + 0.3 * std::sin(0.7 * x + 0.2 * y) +
                             0.1 * unit_double(random_u64(1, 2, static_cast<std::uint64_t>(y * width + x)));
      scene.at(x, y) = Rgb{1, 0.8f, 0.6f} * static_cast<float>(light * texture);
    }
  }
  return scene;
}

struct Pair {
  SceneImage scene;
  DisplayImage mapped;
};

const Pair& bench_pair(int height) {
  static std::map<int, Pair> pairs;
  Pair& pair = pairs[height];
  if (pair.scene.empty()) {
    pair.scene = bench_scene(height * 16 / 9, height);
    pair.mapped = expose(pair.scene, exposure_from(pair.scene));
  }
  return pair;
}

template <class Compare>
void run(benchmark::State& state, Compare compare) {
  const Pair& pair = bench_pair(static_cast<int>(state.range(0)));
  double seconds = 0, copying = 0;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  for ([[maybe_unused]] auto _ : state) {
    const auto start = now();
    benchmark::DoNotOptimize(compare(pair));
    const auto compared = now();
    SceneImage scene = pair.scene;
    DisplayImage mapped = pair.mapped;
    benchmark::DoNotOptimize(scene.pixels().data());
    benchmark::DoNotOptimize(mapped.pixels().data());
    seconds += std::chrono::duration<double>(compared - start).count();
    copying += std::chrono::duration<double>(now() - compared).count();
    state.SetIterationTime(std::chrono::duration<double>(compared - start).count());
  }
  state.counters["copies"] = seconds / copying;
}

void bm_drim(benchmark::State& state) {
  run(state, [](const Pair& pair) { return drim(pair.mapped, pair.scene, {}); });
}
void bm_tmqi(benchmark::State& state) {
  run(state, [](const Pair& pair) { return tmqi(pair.mapped, pair.scene, {}); });
}
void bm_feature(benchmark::State& state) {
  run(state, [](const Pair& pair) { return feature_photographic(pair.mapped, pair.scene, {}); });
}
void bm_brisque(benchmark::State& state) {
  run(state, [](const Pair& pair) { return brisque_plenolab(pair.mapped, {}); });
}
void bm_ssim(benchmark::State& state) {
  run(state, [](const Pair& pair) { return ssim_gamma(pair.mapped, pair.mapped, {}); });
}

BENCHMARK(bm_drim)->Arg(270)->Arg(1080)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(bm_tmqi)->Arg(270)->Arg(1080)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(bm_feature)->Arg(270)->Arg(1080)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(bm_brisque)->Arg(270)->Arg(1080)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(bm_ssim)->Arg(270)->Arg(1080)->Unit(benchmark::kMillisecond)->UseManualTime();

}  // namespace
}  // namespace plenolab
