// Grading one 1920 × 1080 frame by a look-up table beside a plain copy of the frame, which is the limit set
// by memory, and beside the literal definition; counting the pixels of ten post-processing volumes; blending.
// Run with --benchmark_repetitions=5 for medians.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/lut/grade.h"
#include "core/lut/volumes.h"

namespace plenolab {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

/// Smooth, as pictures are, with some grain: neighbouring pixels fall into neighbouring cells.
DisplayImage frame() {
  DisplayImage image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto n = static_cast<std::uint64_t>(y * kWidth + x);
      const float grain = 0.05f * unit_float(random_u64(1, 1, n));
      image.at(x, y) = {0.95f * static_cast<float>(x) / kWidth + grain,
                        0.95f * static_cast<float>(y) / kHeight + grain,
                        0.5f + 0.45f * std::sin(static_cast<float>(x + y) * 0.01f)};
    }
  return image;
}

Lut warm(int size) {
  return bake_lut(size, [](Rgb c) { return Rgb{std::sqrt(c.r), c.g * c.g, 0.8f * c.b}; });
}

void BM_CopyOfTheFrame(benchmark::State& state) {
  const DisplayImage image = frame();
  for (auto _ : state) {
    DisplayImage copy = image;
    benchmark::DoNotOptimize(copy.row(0));
  }
}
BENCHMARK(BM_CopyOfTheFrame)->Unit(benchmark::kMillisecond)->UseRealTime();

void grade_frame(benchmark::State& state, LutInterpolation interpolation) {
  const DisplayImage image = frame();
  const PreparedLut lut(warm(static_cast<int>(state.range(0))));
  for (auto _ : state) {
    const GradedImage graded = lut.grade(image, {interpolation, static_cast<int>(state.range(1))});
    benchmark::DoNotOptimize(graded.image.row(0));
  }
}
void BM_Tetrahedral(benchmark::State& state) {
  grade_frame(state, LutInterpolation::kTetrahedral);
}
void BM_Trilinear(benchmark::State& state) {
  grade_frame(state, LutInterpolation::kTrilinear);
}
#define PLENOLAB_SIZES                      \
  ArgNames({"size", "threads"})             \
      ->ArgsProduct({{17, 33, 65}, {1, 2}}) \
      ->Unit(benchmark::kMillisecond)       \
      ->UseRealTime()
BENCHMARK(BM_Tetrahedral)->PLENOLAB_SIZES;
BENCHMARK(BM_Trilinear)->PLENOLAB_SIZES;

void BM_LiteralTetrahedral(benchmark::State& state) {
  const DisplayImage image = frame();
  const Lut lut = warm(33);
  DisplayImage graded(kWidth, kHeight);
  for (auto _ : state) {
    for (std::size_t i = 0; i < image.size(); ++i)
      graded.pixels()[i] = sample_lut(lut, image.pixels()[i], LutInterpolation::kTetrahedral);
    benchmark::DoNotOptimize(graded.row(0));
  }
}
BENCHMARK(BM_LiteralTetrahedral)->Unit(benchmark::kMillisecond)->UseRealTime();

/// What OpenCV offers for 8-bit frames: one table for each channel, which cannot mix channels.
void BM_OpenCvOneDimensional(benchmark::State& state) {
  cv::Mat frame8(kHeight, kWidth, CV_8UC3, cv::Scalar(10, 100, 200)),
      table(1, 256, CV_8UC3, cv::Scalar(1, 2, 3)), out;
  for (auto _ : state) cv::LUT(frame8, table, out);
}
BENCHMARK(BM_OpenCvOneDimensional)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Ten boxes side by side before the camera, and depths that fall into all of them.
std::vector<Volume> ten_volumes() {
  std::vector<Volume> volumes;
  for (int i = 0; i < 10; ++i)
    volumes.push_back({"v", {-20 + 4.0 * i, 2, -10}, {-16 + 4.0 * i, 30, 10}, 1, 1});
  return volumes;
}

void BM_CountPixelsOfTenVolumes(benchmark::State& state) {
  Plane<float> depth(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) depth.at(x, y) = 20 + 8 * std::sin(0.003f * static_cast<float>(x - y));
  const std::vector<Volume> volumes = ten_volumes();
  const DepthCamera camera{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 75};
  const CountOptions options{static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(count_pixels(depth, camera, volumes, options));
}
BENCHMARK(BM_CountPixelsOfTenVolumes)
    ->ArgNames({"stride", "threads"})
    ->ArgsProduct({{1, 2, 4, 8}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_BlendOfElevenTables(benchmark::State& state) {
  const std::vector<Lut> tables(10, warm(32));
  const Lut background = identity_lut(32);
  const VolumeWeights weights{std::vector<double>(10, 0.05), 0.5};
  for (auto _ : state) benchmark::DoNotOptimize(blend_volumes(weights, tables, background));
}
BENCHMARK(BM_BlendOfElevenTables)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_PrepareTable(benchmark::State& state) {
  const Lut lut = warm(32);
  for (auto _ : state) benchmark::DoNotOptimize(PreparedLut(lut));
}
BENCHMARK(BM_PrepareTable)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace plenolab
