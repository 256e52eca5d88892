// Luminance that observers adapt to on the display at its full size (96 projectors of 640 × 360 pixels, 22
// million rays), beside its limit, reading every luminance once, and beside brute force. What is shown does
// not matter for the time.
#include <benchmark/benchmark.h>

#include <numeric>

#include "core/base/random.h"
#include "core/luminance/perceived.h"
#include "core/luminance/projector_display.h"
#include "core/luminance/ray_reinhard.h"

namespace plenolab {
namespace {

const ProjectorDisplay& display() {
  static const ProjectorDisplay full(projector_display_options(DisplayPreset::kFull));
  return full;
}

const RayValues<float>& luminance() {
  static const RayValues<float> values = [] {
    RayValues<float> made(display().size());
    float* v = made.column(0, 0);
    for (std::size_t i = 0; i < display().size().total(); ++i)
      v[i] = 1e-2f + 1e4f * unit_float(mix64(i)) * unit_float(mix64(~i));
    return made;
  }();
  return values;
}

const SceneRays& rays() {
  static const SceneRays colours = [] {
    SceneRays made(display().size());
    Rgb* c = made.column(0, 0);
    const float* v = luminance().column(0, 0);
    for (std::size_t i = 0; i < display().size().total(); ++i) c[i] = Rgb{1.0f, 0.9f, 0.7f} * v[i];
    return made;
  }();
  return colours;
}

void estimate(benchmark::State& state) {
  const LuminanceOptions options{.method = static_cast<LuminanceMethod>(state.range(0)),
                                 .threads = static_cast<int>(state.range(2))};
  const ObserverSamples samples = samples_of(display(), static_cast<int>(state.range(1)));
  luminance();
  for (auto _ : state) benchmark::DoNotOptimize(estimate_luminance(display(), luminance(), samples, options));
  state.SetLabel(name_of(options.method));
}
BENCHMARK(estimate)
    ->ArgsProduct({{0, 2}, {1000}, {1, 2}})
    ->ArgsProduct({{1, 3}, {100, 1000}, {1, 2}})
    ->ArgNames({"method", "samples", "threads"})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// Brute force by the letter: every projector asked for every pixel; one sample of the thousand.
void one_sample_by_the_letter(benchmark::State& state) {
  const LuminanceOptions options{.method = LuminanceMethod::kBruteForce};
  const ObserverSamples samples = samples_of(display(), 1);
  luminance();
  for (auto _ : state)
    benchmark::DoNotOptimize(estimate_luminance_literally(display(), luminance(), samples, options));
}
BENCHMARK(one_sample_by_the_letter)->Iterations(3)->Unit(benchmark::kMillisecond);

// The limit of all that read every ray: a sum.
void sum_of_all_luminances(benchmark::State& state) {
  const float* v = luminance().column(0, 0);
  for (auto _ : state) {
    float sums[64] = {};
    for (std::size_t i = 0; i + 64 <= display().size().total(); i += 64)
      for (std::size_t k = 0; k < 64; ++k) sums[k] += v[i + k];
    benchmark::DoNotOptimize(std::accumulate(std::begin(sums), std::end(sums), 0.0f));
  }
}
BENCHMARK(sum_of_all_luminances)->Unit(benchmark::kMillisecond);

void luminance_of_colours(benchmark::State& state) {
  rays();
  for (auto _ : state) benchmark::DoNotOptimize(luminance_of(rays(), static_cast<int>(state.range(0))));
}
BENCHMARK(luminance_of_colours)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void tone_mapping_of_all_rays(benchmark::State& state) {
  const GlobalLuminance estimated =
      estimate_luminance(display(), luminance(), samples_of(display(), 1000), {});
  rays();
  for (auto _ : state)
    benchmark::DoNotOptimize(map_rays(display(), rays(), estimated, {}, static_cast<int>(state.range(0))));
}
BENCHMARK(tone_mapping_of_all_rays)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void perceived_picture(benchmark::State& state) {
  rays();
  for (auto _ : state)
    benchmark::DoNotOptimize(perceive(display(), rays(), {0.3, 0}, display().resolution(), 1));
}
BENCHMARK(perceived_picture)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plenolab
