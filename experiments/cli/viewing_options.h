#pragma once

#include <optional>
#include <string>

#include "analysis/provenance.h"
#include "metrics/table.h"

namespace CLI {
class App;
}

namespace plenolab {

/// Declares --pixels-per-degree, --distance, --display-peak and --display-black.
void add_viewing_options(CLI::App& app, ViewingConditions& viewing);

/// Throws UsageError unless black is below the peak.
void require_valid(const ViewingConditions& viewing);

/// Notes the viewing conditions among the parameters of a run.
void record_viewing(Provenance& provenance, const ViewingConditions& viewing);

/// Declares --cd-m2-per-unit; 0 stands for "as the files say". `unless_said` tells what is done if they do
/// not.
void add_luminance_scale_option(CLI::App& app, double& cd_m2_per_unit, const std::string& unless_said = "");

/// Why a metric of absolute luminance cannot be had without a scale, with the option that gives it.
std::string scale_needed(const std::string& metric);

/// The scale that the user gives, or else the one that the file says; nothing if neither does.
std::optional<double> luminance_scale(double given_cd_m2_per_unit, const std::string& file);

}  // namespace plenolab
