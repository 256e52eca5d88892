// Bilateral filters side by side with OpenCV's, and the key-view adjustment per view. Counters say how far
// the result is from the exact filter; run with --benchmark_repetitions=5 for medians. The exact filter of a
// whole 1920 × 1080 image takes minutes, so errors are taken on a strip.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/tonemap/adjustment/key_view_adjustment.h"
#include "core/tonemap/filters/bilateral_filter.h"
#include "core/tonemap/filters/bilateral_grid.h"

namespace plenolab {
namespace {

struct View {
  Plane<float> value;
  DisparityMap disparity;
};

/// Slanted ground with waves and noise, discs over six decades before it.
View bench_view(int width, int height) {
  View view{Plane<float>(width, height), DisparityMap(width, height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double value = 3.0 * x / width + 0.3 * std::sin(0.05 * x) * std::cos(0.03 * y);
      double disparity = 2 + 10.0 * y / height;
      for (std::uint64_t n = 0; n < 40; ++n) {
        const double cx = width * unit_double(random_u64(1, 2, n)),
                     cy = height * unit_double(random_u64(1, 3, n));
        if (std::hypot(x - cx, y - cy) > width * (0.01 + 0.05 * unit_double(random_u64(1, 4, n)))) continue;
        disparity = 12 + 20 * unit_double(random_u64(1, 5, n));
        value = -1 + 6 * unit_double(random_u64(1, 6, n));
      }
      value += 0.3 * unit_double(random_u64(3, 1, static_cast<std::uint64_t>(y * width + x)));
      view.value.at(x, y) = static_cast<float>(value);
      view.disparity.at(x, y) = static_cast<float>(disparity);
    }
  return view;
}

enum class Depth { kNone, kTwoSided, kOneSided };

std::optional<DepthGuide> guide(const View& view, Depth depth) {
  if (depth == Depth::kNone) return std::nullopt;
  return DepthGuide{
      &view.disparity, 0.5,
      depth == Depth::kTwoSided ? DepthSide::kTwoSided : DepthSide::kBackgroundTakesNothingFromForeground};
}

BilateralOptions options_of(const View& view) {
  return {.sigma_s_px = default_sigma_s_px(view.value.width(), view.value.height()), .sigma_value = 0.4};
}

void count_error(benchmark::State& state, const Plane<float>& fast, const Plane<float>& exact) {
  double mean = 0, max = 0;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    const double e = std::abs(static_cast<double>(fast.pixels()[i]) - static_cast<double>(exact.pixels()[i]));
    mean += e / static_cast<double>(fast.size());
    max = std::max(max, e);
  }
  state.counters["error_mean_log10"] = mean;
  state.counters["error_max_log10"] = max;
}

/// Error of the grid with σ_s of the full size on a strip of it.
void BM_Grid(benchmark::State& state, Depth depth) {
  const int width = static_cast<int>(state.range(0)), height = width * 9 / 16;
  const View view = bench_view(width, height), strip = bench_view(width / 2, height / 8);
  const BilateralOptions options = options_of(view);
  const auto depth_guide = guide(view, depth), strip_guide = guide(strip, depth);
  for (auto _ : state)
    benchmark::DoNotOptimize(filter_by_grid({view.value, view.value, options, depth_guide, 0}, {}));
  const auto fast = filter_by_grid({strip.value, strip.value, options, strip_guide, 0}, {});
  count_error(state, fast.value(), bilateral_exact(strip.value, options, strip_guide));
}

void BM_Exact(benchmark::State& state, Depth depth) {
  const int width = static_cast<int>(state.range(0)), height = width * 9 / 16;
  const View view = bench_view(width, height);
  for (auto _ : state)
    benchmark::DoNotOptimize(bilateral_exact(view.value, options_of(view), guide(view, depth)));
}

/// OpenCV with its own window (1.5 σ) or with that of bilateral_exact (3 σ).
void BM_OpenCv(benchmark::State& state, double window_sigmas) {
  const int width = static_cast<int>(state.range(0)), height = width * 9 / 16;
  View view = bench_view(width, height);
  const BilateralOptions options = options_of(view);
  const cv::Mat image(height, width, CV_32F, view.value.row(0));
  cv::Mat result;
  const int diameter = 2 * static_cast<int>(window_sigmas * options.sigma_s_px) + 1;
  for (auto _ : state) cv::bilateralFilter(image, result, diameter, options.sigma_value, options.sigma_s_px);
}

/// One row of key views of 480 × 270 pixels, each looking into all others; items are adjusted views.
void BM_KeyViewAdjustment(benchmark::State& state) {
  ViewGrid grid{.columns = 5, .rows = 1, .width = 480, .height = 270};
  const View view = bench_view(grid.width, grid.height);
  KeyView<SceneReferred> scene{SceneImage(grid.width, grid.height), view.disparity};
  KeyView<DisplayReferred> mapped{DisplayImage(grid.width, grid.height), view.disparity};
  for (std::size_t i = 0; i < view.value.size(); ++i) {
    const float l = std::pow(10.0f, view.value.pixels()[i]), q = std::pow(l / (l + 1), 1 / 2.2f);
    scene.colour.pixels()[i] = {l, l, l};
    mapped.colour.pixels()[i] = {q, q, q};
  }
  const auto hdr = LightField::from_views(grid, RadianceUnit::kRelative, "hdr", std::vector(5, scene));
  const auto display =
      DisplayLightField::from_views(grid, RadianceUnit::kRelative, "mapped", std::vector(5, mapped));
  for (auto _ : state) adjust_key_views(hdr, display, {}, [](int, int, const DisplayImage&) {});
  state.SetItemsProcessed(state.iterations() * 5);
}

BENCHMARK_CAPTURE(BM_Grid, plain, Depth::kNone)
    ->Arg(480)
    ->Arg(1920)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Grid, two_sided, Depth::kTwoSided)
    ->Arg(480)
    ->Arg(1920)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Grid, one_sided, Depth::kOneSided)
    ->Arg(480)
    ->Arg(1920)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Exact, plain, Depth::kNone)->Arg(480)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Exact, two_sided, Depth::kTwoSided)
    ->Arg(480)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_OpenCv, own_window, 1.5)
    ->Arg(480)
    ->Arg(1920)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_OpenCv, same_window, 3.0)
    ->Arg(480)
    ->Arg(1920)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_KeyViewAdjustment)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plenolab
