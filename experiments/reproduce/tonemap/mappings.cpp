#include "experiments/reproduce/tonemap/mappings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/statistics.h"
#include "core/tonemap/reinhard_devlin.h"

namespace plenolab {

namespace {

double reinhard_exposure(MappingBench& bench, const std::string& scene) {
  const LightFieldStatistics& statistics = bench.statistics(scene);
  return std::clamp(std::pow(10, -evaluate(statistics.all, statistics.floor).log_average), 1e-9, 1e9);
}

std::string exposure_setting(double exposure) {
  return fmt::format("exposure={:.6g}", exposure);
}

/// Settings of limits by hand.
std::vector<std::string> manual_limits(MappingBench& bench, const std::string& scene) {
  const double exposure = reinhard_exposure(bench, scene);
  const LightField field = bench.laboratory().light_field(scene);
  const LightFieldStatistics& statistics = bench.statistics(scene);
  std::vector<double> lowest, highest;
  for (std::size_t i = 0; i < statistics.views.size(); ++i) {
    const int column = static_cast<int>(i) % field.grid().columns,
              row = static_cast<int>(i) / field.grid().columns;
    const LumaLimits limits = measure_limits(fit({.exposure = exposure}, statistics.of_view(i)),
                                             field.view(column, row)->colour, bench.threads());
    lowest.push_back(limits.min);
    highest.push_back(limits.max);
  }
  return {exposure_setting(exposure), "limits=manual", fmt::format("luma_min={:.6g}", median(lowest)),
          fmt::format("luma_max={:.6g}", median(highest))};
}

}  // namespace

Mapping mapping_for(MappingBench& bench, const std::string& scene, Shown shown) {
  const auto reinhard = [&](const char* label, const char* variant) {
    return mapping_of(label, "reinhard05", variant, {exposure_setting(reinhard_exposure(bench, scene))});
  };
  switch (shown) {
    case Shown::kBilateralNaive:
      return mapping_of("Bilateral, naive", "bilateral", "naive");
    case Shown::kBilateralEnhanced:
      return mapping_of("Bilateral, enhanced", "bilateral", "enhanced");
    case Shown::kHistogram:
      return mapping_of("Histogram adjustment", "histogram", "naive");
    case Shown::kHistogramFixed:
      return mapping_of("Histogram adjustment, 4 passes", "histogram", "naive", {"passes=4"});
    case Shown::kReinhardNaive:
      return reinhard("Reinhard 2005, naive", "naive");
    case Shown::kReinhardJoint:
      return mapping_of("Reinhard 2005, joint", "reinhard05", "joint", manual_limits(bench, scene));
    case Shown::kReinhardJointAuto:
      return reinhard("Reinhard 2005, joint, automatic limits", "joint");
    case Shown::kReinhardAdjusted:
      return reinhard("Reinhard 2005, naive, key views adjusted", "naive+adjusted");
    case Shown::kReinhardResults:
      return reinhard("Reinhard 2005, results interpolated", "interpolate-results");
    case Shown::kReinhardStatistics:
      return reinhard("Reinhard 2005, statistics interpolated", "interpolate-statistics");
    case Shown::kRobust:
      return mapping_of("Robust adaptive", "robust", "interpolate-statistics");
  }
  return {};
}

std::vector<Mapping> mappings_for(MappingBench& bench, const std::string& scene,
                                  const std::vector<Shown>& shown) {
  std::vector<Mapping> mappings;
  for (const Shown one : shown) mappings.push_back(mapping_for(bench, scene, one));
  return mappings;
}

std::string short_label(const std::string& label) {
  constexpr std::string_view kOperator = "Reinhard 2005, ";
  return label.starts_with(kOperator) ? label.substr(kOperator.size()) : label;
}

std::vector<Shown> all_shown() {
  std::vector<Shown> all;
  for (int i = 0; i <= static_cast<int>(Shown::kRobust); ++i) all.push_back(static_cast<Shown>(i));
  return all;
}

std::vector<double> adaptation_track(const MappedMotion& motion) {
  std::vector<double> track;
  double sum = 0;
  for (const FrameConsistency& frame : motion.frames)
    track.push_back(sum += frame.change && frame.change->share >= kEnoughOfAFrame ? frame.change->mean : 0);
  return track;
}

}  // namespace plenolab
