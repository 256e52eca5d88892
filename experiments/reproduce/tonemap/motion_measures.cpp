#include "experiments/reproduce/tonemap/motion_measures.h"

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/tonemap/measures.h"

namespace plenolab {

namespace {

constexpr double kBegun = 0.1;
constexpr std::ptrdiff_t kFewestFrames = 3;

template <class Number>
std::vector<double> of_each_line(MappingBench& bench, const std::string& scene, const Mapping& mapping,
                                 const Number& number) {
  std::vector<double> values;
  for (int line = 0; line < kMotionLines; ++line)
    values.push_back(number(bench.motion(scene, mapping, line)));
  return values;
}

}  // namespace

double largest_step(const MappedMotion& motion) {
  const std::vector<double> track = adaptation_track(motion);
  double largest = 0;
  for (std::size_t i = 1; i < track.size(); ++i)
    largest = std::max(largest, std::abs(track[i] - track[i - 1]));
  return largest;
}

double adaptation_range(const MappedMotion& motion) {
  const std::vector<double> track = adaptation_track(motion);
  const auto [low, high] = std::minmax_element(track.begin(), track.end());
  return *high - *low;
}

std::vector<double> largest_steps(MappingBench& bench, const std::string& scene, const Mapping& mapping) {
  return of_each_line(bench, scene, mapping, largest_step);
}

std::vector<double> adaptation_ranges(MappingBench& bench, const std::string& scene, const Mapping& mapping) {
  return of_each_line(bench, scene, mapping, adaptation_range);
}

std::optional<double> lead_time_s(const RecordedMotion& recording, const std::vector<double>& track,
                                  int window) {
  const auto event = static_cast<std::ptrdiff_t>(recording.event);
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(track.size()) - 1;
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, event - window);
  const std::ptrdiff_t end = std::min(last, event + window);
  if (event - begin < kFewestFrames || end - event < kFewestFrames) return std::nullopt;
  const auto at = [&](std::ptrdiff_t i) { return track[static_cast<std::size_t>(i)]; };
  const double way = at(end) - at(begin);
  if (std::abs(way) < kSmallestStep) return std::nullopt;
  std::ptrdiff_t begun = begin;
  while ((at(begun) - at(begin)) / way < kBegun) ++begun;
  return static_cast<double>(event - begun) / recording.motion.frames_per_second;
}

}  // namespace plenolab
