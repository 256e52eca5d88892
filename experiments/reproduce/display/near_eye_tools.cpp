#include "experiments/reproduce/display/near_eye_tools.h"

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

std::string thesis(const std::string& where) {
  return "Hansen & Klein 2016, " + where;
}

Interval ratio_over_scenes(const std::vector<double>& numerators, const std::vector<double>& denominators,
                           std::uint64_t seed) {
  return bootstrap_units(
      numerators.size(),
      [&](std::span<const double> drawn) {
        double above = 0, below = 0;
        for (const double i : drawn) {
          above += numerators[static_cast<std::size_t>(i)];
          below += denominators[static_cast<std::size_t>(i)];
        }
        return above / std::max(below, 1e-12);
      },
      seed);
}

Plane<float> absolute_difference(const DisplayImage& a, const DisplayImage& b) {
  Plane<float> difference(a.width(), a.height());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb d = a.pixels()[i] - b.pixels()[i];
    difference.pixels()[i] = (std::abs(d.r) + std::abs(d.g) + std::abs(d.b)) / 3;
  }
  return difference;
}

double mean_absolute(const DisplayImage& a, const DisplayImage& b) {
  double sum = 0;
  const Plane<float> difference = absolute_difference(a, b);
  for (const float d : difference.pixels()) sum += static_cast<double>(d);
  return sum / static_cast<double>(a.size());
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

NearEyeTimes times_of(NearEyeBench& bench, const NearEyeBench::Recipe& recipe) {
  NearEyeTimes times;
  for (const std::string& id : bench.scene_ids()) {
    const NearEyeBench::Timing& t = bench.timing(id, recipe);
    times.direct.push_back(t.direct_total_s());
    times.reprojected.push_back(t.reprojected_total_s());
  }
  return times;
}

}  // namespace plenolab
