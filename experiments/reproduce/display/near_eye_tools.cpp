#include "experiments/reproduce/display/near_eye_tools.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

std::string thesis(const std::string& where) {
  return "Hansen & Klein 2016, " + where;
}

Interval share_over_scenes(const std::vector<double>& shares, std::uint64_t seed) {
  const Interval interval = mean_interval(shares, seed).value();
  return {interval.estimate, std::max(0.0, interval.low), std::min(1.0, interval.high)};
}

Interval ratio_over_scenes(const std::vector<double>& numerators, const std::vector<double>& denominators,
                           std::uint64_t seed) {
  constexpr double kZero = 1e-12;
  std::vector<double> logs;
  for (std::size_t i = 0; i < numerators.size(); ++i)
    if (numerators[i] > 0 || denominators[i] > 0)
      logs.push_back(std::log(std::max(numerators[i], kZero) / std::max(denominators[i], kZero)));
  const auto interval = mean_interval(logs, seed);
  if (!interval) return {logs.empty() ? 1 : std::exp(logs[0]), 0, std::numeric_limits<double>::infinity()};
  return {std::exp(interval->estimate), std::exp(interval->low), std::exp(interval->high)};
}

namespace {

/// |a − b| of each channel, in codes.
std::array<int, 3> code_difference(const Rgb& a, const Rgb& b) {
  const auto apart = [](float u, float v) { return std::abs(display_code(u) - display_code(v)); };
  return {apart(a.r, b.r), apart(a.g, b.g), apart(a.b, b.b)};
}

}  // namespace

Plane<float> absolute_difference(const DisplayImage& a, const DisplayImage& b) {
  Plane<float> difference(a.width(), a.height());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto codes = code_difference(a.pixels()[i], b.pixels()[i]);
    difference.pixels()[i] = static_cast<float>(codes[0] + codes[1] + codes[2]) / (3 * 255);
  }
  return difference;
}

double mean_absolute(const DisplayImage& a, const DisplayImage& b) {
  return mean_difference(difference_statistics(a, b));
}

double share_beyond_codes(const DisplayImage& a, const DisplayImage& b, int codes) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto channels = code_difference(a.pixels()[i], b.pixels()[i]);
    beyond += *std::max_element(channels.begin(), channels.end()) > codes;
  }
  return static_cast<double>(beyond) / static_cast<double>(a.size());
}

DisplayImage centre_enlarged(const DisplayImage& light_field, const SubimageLayout& layout, int factor) {
  const auto [column, row] = central_position(layout);
  return magnify(subimage(light_field, layout, column, row), factor);
}

void conclude_on_scenes(ReproductionResult& result, NearEyeBench& bench, Claim claim, Verdict verdict,
                        std::string explanation) {
  verdict.scenes = bench.scene_ids();
  verdict.explanation = std::move(explanation);
  conclude(result, std::move(claim), std::move(verdict));
}

ReprojectedTimes reprojected_times(NearEyeBench& bench) {
  ReprojectedTimes times;
  for (const std::string& id : bench.scene_ids()) {
    const NearEyeBench::SceneTiming& timing = bench.timing(id);
    times.supersampled.push_back(timing.supersampled.reprojected_s());
    times.plain.push_back(timing.plain.reprojected_s());
  }
  return times;
}

NearEyeTimes times_side_by_side(NearEyeBench& bench) {
  NearEyeTimes times;
  for (const std::string& id : bench.scene_ids()) {
    const NearEyeBench::SceneTiming& timing = bench.timing(id, true);
    times.direct_supersampled.push_back(timing.supersampled.direct_s());
    times.direct_plain.push_back(timing.plain.direct_s());
  }
  times.reprojected = reprojected_times(bench);
  return times;
}

}  // namespace plenolab
