// Tone mapping operators on one 1920 × 1080 view: fitting and applying apart, beside a plain copy of the
// view, which is the limit set by memory, and beside OpenCV's operator of Reinhard and Devlin. Run with
// --benchmark_repetitions=5 for medians.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <opencv2/photo.hpp>
#include <string>

#include "core/base/random.h"
#include "core/tonemap/operator.h"

namespace plenolab {
namespace {

/// Colours over four decades, and a foreground before a background.
OperatorView bench_view() {
  auto colour = std::make_shared<SceneImage>(1920, 1080);
  auto disparity = std::make_shared<DisparityMap>(1920, 1080, 3.0f);
  std::uint64_t n = 0;
  for (Rgb& c : colour->pixels())
    for (float* channel : {&c.r, &c.g, &c.b})
      *channel = static_cast<float>(std::pow(10.0, 3 - 4 * unit_double(random_u64(1, 1, n++))));
  for (int y = 300; y < 700; ++y)
    for (int x = 500; x < 1200; ++x) disparity->at(x, y) = 20;
  return {colour, disparity};
}

FitScope scope_of(const OperatorView& view) {
  const ViewStatistics statistics = measure_view(*view.colour);
  FitScope scope;
  scope.load = [view](int) { return view; };
  scope.floor = log_floor(statistics);
  scope.statistics = evaluate(statistics, scope.floor);
  return scope;
}

void BM_CopyOfTheView(benchmark::State& state) {
  const OperatorView view = bench_view();
  for (auto _ : state) {
    SceneImage copy = *view.colour;
    benchmark::DoNotOptimize(copy.row(0));
  }
}
BENCHMARK(BM_CopyOfTheView)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Float pixels in, float pixels out, at OpenCV's own defaults.
void BM_OpenCvReinhard(benchmark::State& state) {
  const OperatorView view = bench_view();
  cv::Mat bgr(view.colour->height(), view.colour->width(), CV_32FC3), mapped;
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x) {
      const Rgb& c = view.colour->at(x, y);
      bgr.at<cv::Vec3f>(y, x) = {c.b, c.g, c.r};
    }
  const cv::Ptr<cv::TonemapReinhard> reinhard = cv::createTonemapReinhard();
  for (auto _ : state) reinhard->process(bgr, mapped);
}
BENCHMARK(BM_OpenCvReinhard)->Unit(benchmark::kMillisecond)->UseRealTime();

/// What BM_OpenCvReinhard does in one call: the statistics of the view, then the operator.
void BM_Reinhard05WithStatistics(benchmark::State& state) {
  const OperatorView view = bench_view();
  const OperatorInfo& info = find_operator("reinhard05");
  for (auto _ : state) {
    const ToneMapped mapped = info.fit("naive", {}, scope_of(view)).apply(view, 0);
    benchmark::DoNotOptimize(mapped.image.row(0));
  }
}
BENCHMARK(BM_Reinhard05WithStatistics)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_MeasureView(benchmark::State& state) {
  const OperatorView view = bench_view();
  for (auto _ : state) benchmark::DoNotOptimize(measure_view(*view.colour));
}
BENCHMARK(BM_MeasureView)->Unit(benchmark::kMillisecond)->UseRealTime();

void fit_operator(benchmark::State& state, const OperatorInfo& info, const std::string& variant) {
  const FitScope scope = scope_of(bench_view());
  for (auto _ : state) benchmark::DoNotOptimize(info.fit(variant, {}, scope));
}

void apply_operator(benchmark::State& state, const OperatorInfo& info, const std::string& variant) {
  const OperatorView view = bench_view();
  const FittedOperator fitted = info.fit(variant, {}, scope_of(view));
  for (auto _ : state) {
    const ToneMapped mapped = fitted.apply(view, 0);
    benchmark::DoNotOptimize(mapped.image.row(0));
  }
}

/// One benchmark of fitting and one of applying for every entry of the table.
int register_operators() {
  int count = 0;
  const auto add = [&count](const std::string& name, const auto& body) {
    benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond)->UseRealTime();
    ++count;
  };
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const OperatorVariant& variant : info.variants) {
      if (variant.scope == OperatorScope::kFrame || variant.id == "joint") continue;  // joint maps like naive
      const std::string name = info.id + "/" + variant.id, id = variant.id;
      add("fit/" + name, [&info, id](benchmark::State& state) { fit_operator(state, info, id); });
      add("apply/" + name, [&info, id](benchmark::State& state) { apply_operator(state, info, id); });
    }
  return count;
}

[[maybe_unused]] const int kRegistered = register_operators();

}  // namespace
}  // namespace plenolab
