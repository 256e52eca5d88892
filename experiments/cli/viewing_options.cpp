#include "experiments/cli/viewing_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "experiments/cli/checks.h"
#include "experiments/tonemap_fit.h"

namespace plenolab {

void add_viewing_options(CLI::App& app, ViewingConditions& viewing) {
  app.add_option("--pixels-per-degree", viewing.pixels_per_degree,
                 "Pixels of the images in one degree of the viewer's visual angle")
      ->check(number_between(1, 1000))
      ->capture_default_str();
  app.add_option("--distance", viewing.distance_m, "From the viewer to the picture, m")
      ->check(number_between(0.05, 100))
      ->capture_default_str();
  app.add_option("--display-peak", viewing.display_peak_cd_m2,
                 "White of the display that shows a .png, cd/m2")
      ->check(number_between(1e-6, 1e6))
      ->capture_default_str();
  app.add_option("--display-black", viewing.display_black_cd_m2, "Black of that display, cd/m2")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
}

void require_valid(const ViewingConditions& viewing) {
  if (viewing.display_black_cd_m2 >= viewing.display_peak_cd_m2)
    throw UsageError(fmt::format("--display-black {:g} must be below --display-peak {:g}",
                                 viewing.display_black_cd_m2, viewing.display_peak_cd_m2));
}

void record_viewing(Provenance& provenance, const ViewingConditions& viewing) {
  provenance.parameters["pixels_per_degree"] = viewing.pixels_per_degree;
  provenance.parameters["distance_m"] = viewing.distance_m;
  provenance.parameters["display_peak_cd_m2"] = viewing.display_peak_cd_m2;
  provenance.parameters["display_black_cd_m2"] = viewing.display_black_cd_m2;
}

void add_luminance_scale_option(CLI::App& app, double& cd_m2_per_unit, const std::string& unless_said) {
  app.add_option(
         "--cd-m2-per-unit", cd_m2_per_unit,
         fmt::format("Luminance of a pixel value of 1 (default: what an .exr or its light field says{})",
                     unless_said.empty() ? "" : "; " + unless_said))
      ->check(positive_number());
}

std::string scale_needed(const std::string& metric) {
  return fmt::format(
      "--cd-m2-per-unit: {} needs the luminance of a pixel value of 1, which the images do not say", metric);
}

std::optional<double> luminance_scale(double given_cd_m2_per_unit, const std::string& file) {
  if (given_cd_m2_per_unit > 0) return given_cd_m2_per_unit;
  return declared_cd_m2_per_unit(file);
}

}  // namespace plenolab
