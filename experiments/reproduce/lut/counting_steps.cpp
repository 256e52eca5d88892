#include "experiments/reproduce/lut/counting_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/base/parallel.h"
#include "core/lut/mixed_image.h"

namespace plenolab {

namespace {

constexpr std::array<PrintedTime, 9> kPrinted{{{"CPU", 1, 0.2187, 0.2187},
                                               {"CPU", 2, 0.035, 0.045},
                                               {"CPU", 4, 0.008, 0.012},
                                               {"CPU", 8, 0.0038, 0.0067},
                                               {"GPU", 1, 0.005, 0.0062},
                                               {"GPU", 2, 0.004, 0.006},
                                               {"GPU", 4, 0.003, 0.006},
                                               {"GPU", 8, 0.003, 0.005},
                                               {"mixed image", 1, 0.2087, 0.2264}}};

struct Size {
  int width, height;
};

Size timed_size(const WalkBench& bench) {
  if (bench.options().effort == Effort::kTiny) return {kPrintedWidth / 4, kPrintedHeight / 4};
  return {kPrintedWidth, kPrintedHeight};
}

/// Every n-th pixel of every n-th row, as a camera of lower resolution without anti-aliasing sees it.
Plane<float> point_sampled(const Plane<float>& depth, int divisor) {
  Plane<float> small((depth.width() + divisor - 1) / divisor, (depth.height() + divisor - 1) / divisor);
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x) small.at(x, y) = depth.at(x * divisor, y * divisor);
  return small;
}

VolumeWeights weights_of(WalkBench& bench, const WalkFrame& frame) {
  const std::vector<Volume>& volumes = bench.stage().volumes();
  const CountOptions options{1, bench.options().threads};
  return pixel_weights(count_pixels(frame.depth_m, frame.pose.camera, volumes, options), volumes);
}

void make_mixed(WalkBench& bench, const WalkFrame& frame, int threads) {
  const std::vector<Volume>& volumes = bench.stage().volumes();
  const Plane<int> volume = map_pixels(frame.depth_m, frame.pose.camera, volumes, threads);
  const Plane<int> owner = volume_of_objects(volume, frame.object, static_cast<int>(volumes.size()));
  grade_mixed(frame.picture, owner, std::span(bench.prepared()).first(volumes.size()),
              bench.prepared().back(), threads);
}

}  // namespace

const PrintedTime* printed_time(const std::string& method, int divisor) {
  for (const PrintedTime& time : kPrinted)
    if (method == time.method && divisor == time.divisor) return &time;
  return nullptr;
}

WalkFrame timed_frame(WalkBench& bench, bool lit) {
  const auto path = walk_path();
  const WalkPose& pose = *(std::ranges::find(path, "through the hall", &WalkPose::leg) + 3);
  if (!lit) return surfaces_of_timed_size(bench, pose);
  const auto [width, height] = timed_size(bench);
  return bench.stage().frame(pose, width, height, bench.options().threads);
}

WalkFrame surfaces_of_timed_size(WalkBench& bench, const WalkPose& pose) {
  const auto [width, height] = timed_size(bench);
  return bench.stage().surfaces(pose, width, height, bench.options().threads);
}

std::string on_threads(const std::string& what, const WalkBench& bench) {
  const int threads = resolve_threads(bench.options().threads);
  return fmt::format("{}, {} thread{}", what, threads, threads == 1 ? ", all there are" : "s");
}

std::vector<FrameStep> counting_steps(WalkBench& bench, const WalkFrame& frame) {
  std::vector<FrameStep> steps;
  const std::vector<Volume>& volumes = bench.stage().volumes();
  const auto vectorised = [&frame, &volumes](int divisor, int threads) {
    return [&frame, &volumes, divisor, threads] {
      count_pixels(frame.depth_m, frame.pose.camera, volumes, {divisor, threads});
    };
  };
  for (const int divisor : kDivisors) {
    const auto small = std::make_shared<Plane<float>>(point_sampled(frame.depth_m, divisor));
    const std::string what = "pixels by volume";
    steps.push_back({kOneByOne, what, divisor, "CPU",
                     [&frame, &volumes, small] { volume_of_pixels(*small, frame.pose.camera, volumes, 1); }});
    steps.push_back({kVectorised, what, divisor, "CPU", vectorised(divisor, 1)});
    steps.push_back({on_threads("counting, vectorised", bench), what, divisor, "CPU",
                     vectorised(divisor, bench.options().threads)});
  }
  return steps;
}

std::vector<FrameStep> other_steps(WalkBench& bench, const WalkFrame& frame) {
  const int threads = bench.options().threads;
  const VolumeWeights weights = weights_of(bench, frame);
  const auto blended = (weights.background > 0 ? 1 : 0) +
                       std::ranges::count_if(weights.volumes, [](double w) { return w > 0; });
  const auto ready =
      std::make_shared<PreparedLut>(blend_volumes(weights, bench.tables(), bench.background()));
  const std::string mixed = "volumes, objects and grading, tables ready";
  return {
      {"mixed image, 1 thread", mixed, 1, "mixed image", [&bench, &frame] { make_mixed(bench, frame, 1); }},
      {on_threads("mixed image", bench), mixed, 1, "mixed image",
       [&bench, &frame, threads] { make_mixed(bench, frame, threads); }},
      {"blending, 1 thread", fmt::format("of {} tables, with preparation for grading", blended), 1, "",
       [&bench, weights] { PreparedLut(blend_volumes(weights, bench.tables(), bench.background())); }},
      {on_threads("grading", bench), "tetrahedral, by the blend", 1, "",
       [&frame, ready, threads] { ready->grade(frame.picture, {.threads = threads}); }}};
}

StagedWork timed_work(const FrameStep& step) {
  return [run = step.run] {
    const Stopwatch watch;
    run();
    return std::vector<double>{watch.seconds()};
  };
}

}  // namespace plenolab
