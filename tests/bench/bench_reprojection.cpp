// Reprojection of a light field for the near-eye display against its limits and against rendering every
// camera of the same scene with the same renderer, sampling and down-sampling.
#include <benchmark/benchmark.h>

#include <cstring>

#include "core/display/retina.h"
#include "experiments/near_eye.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

const NearEyeScene& many_objects() {
  static const NearEyeScene scene = prepare_near_eye(DirectScene(build_scene("near-eye-1")));
  return scene;
}

const std::vector<RenderedCamera>& cameras() {
  static const std::vector<RenderedCamera> rendered = render_cameras(many_objects(), 4, 0);
  return rendered;
}

const ReprojectionResult& reprojected() {
  static const ReprojectionResult result = reproject(camera_array(many_objects().grid), cameras());
  return result;
}

void reprojection(benchmark::State& state) {
  const CameraArray array = camera_array(many_objects().grid);
  const ReprojectionOptions options{.method = static_cast<ReprojectionMethod>(state.range(0)),
                                    .threads = static_cast<int>(state.range(1))};
  std::int64_t pixels = 0;
  DisplayImage buffer;  // frames of a sequence share their memory
  for (auto _ : state) {
    ReprojectionResult result = reproject(array, cameras(), options, std::move(buffer));
    pixels += result.pixels;
    benchmark::DoNotOptimize(result.light_field.pixels().data());
    buffer = std::move(result.light_field);
  }
  state.counters["light_fields/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["Mpx/s"] =
      benchmark::Counter(1e-6 * static_cast<double>(pixels), benchmark::Counter::kIsRate);
}
BENCHMARK(reprojection)
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->ArgNames({"one_step", "threads"})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// The limit: writing the light field once, from memory.
void copy_of_the_light_field(benchmark::State& state) {
  const DisplayImage& from = reprojected().light_field;
  DisplayImage to(from.width(), from.height());
  for (auto _ : state) {
    std::memcpy(to.pixels().data(), from.pixels().data(), from.size() * sizeof(Rgb));
    benchmark::ClobberMemory();
  }
}
BENCHMARK(copy_of_the_light_field)->Unit(benchmark::kMillisecond);

// As the thesis' shader searches: every pixel of every line.
void literal_search(benchmark::State& state) {
  const CameraArray array = camera_array(many_objects().grid);
  const ReprojectionOptions options{.method = static_cast<ReprojectionMethod>(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(reproject_literally(array, cameras(), options).holes);
}
BENCHMARK(literal_search)->Arg(0)->Arg(1)->ArgName("one_step")->UseRealTime()->Unit(benchmark::kMillisecond);

void corner_cameras(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(render_cameras(many_objects(), 4, 0).data());
}
BENCHMARK(corner_cameras)->UseRealTime()->Unit(benchmark::kMillisecond);

void every_camera(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(render_directly(many_objects(), 0).light_field.pixels().data());
}
BENCHMARK(every_camera)->UseRealTime()->Unit(benchmark::kMillisecond);

void down_sampling(benchmark::State& state) {
  const SubimageLayout layout = camera_array(many_objects().grid).layout;
  for (auto _ : state)
    benchmark::DoNotOptimize(halve_subimages(reprojected().light_field, layout).pixels().data());
}
BENCHMARK(down_sampling)->UseRealTime()->Unit(benchmark::kMillisecond);

void panel(benchmark::State& state) {
  const SubimageLayout layout = camera_array(many_objects().grid).layout;
  for (auto _ : state)
    benchmark::DoNotOptimize(panel_image(reprojected().light_field, layout, {}).pixels().data());
}
BENCHMARK(panel)->UseRealTime()->Unit(benchmark::kMillisecond);

void retina(benchmark::State& state) {
  const SubimageLayout layout = camera_array(many_objects().grid).layout;
  const NearEyeDisplay display = consistent_with_thin_lenses({});
  const DisplayImage image = panel_image(reprojected().light_field, layout, display);
  for (auto _ : state) benchmark::DoNotOptimize(retinal_image(image, display, {}).pixels().data());
}
BENCHMARK(retina)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plenolab
