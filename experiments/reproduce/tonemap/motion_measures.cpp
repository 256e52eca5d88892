#include "experiments/reproduce/tonemap/motion_measures.h"

#include <algorithm>
#include <cmath>

namespace plenolab {

namespace {

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

}  // namespace plenolab
