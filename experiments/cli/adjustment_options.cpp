#include "experiments/cli/adjustment_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

struct AdjustmentOption {
  const char* name;
  double KeyViewAdjustmentOptions::*value;
  double least, most;
  const char* help;
};

constexpr AdjustmentOption kOptions[] = {
    {"--sigma-views", &KeyViewAdjustmentOptions::sigma_views, 1e-3, 1e3,
     "Adjustment: width over the camera plane, in key views"},
    {"--support", &KeyViewAdjustmentOptions::support_views, 0, 1e9,
     "Adjustment: key views farther apart take nothing from each other, in key views"},
    {"--sigma-d", &KeyViewAdjustmentOptions::sigma_d_px, 1e-6, 1e6,
     "Adjustment: width over disparity, in pixels"},
    {"--sigma-l", &KeyViewAdjustmentOptions::sigma_log_luminance, 1e-6, 1e6,
     "Adjustment: width over HDR luminance, in log10 units"},
    {"--smoothing", &KeyViewAdjustmentOptions::smoothing_share, 1e-6, 10,
     "Smoothing of the factors: width, as a share of the larger side"},
    {"--smoothing-sigma-d", &KeyViewAdjustmentOptions::smoothing_sigma_d_px, 1e-6, 1e6,
     "Smoothing of the factors: width over disparity, in pixels"},
    {"--smoothing-sigma-l", &KeyViewAdjustmentOptions::smoothing_sigma_log_luminance, 1e-6, 1e6,
     "Smoothing of the factors: width over HDR luminance, in log10 units"},
};

}  // namespace

void add_adjustment_options(CLI::App& app, KeyViewAdjustmentOptions& options) {
  for (const AdjustmentOption& option : kOptions)
    app.add_option(option.name, options.*option.value, option.help)
        ->check(number_between(option.least, option.most))
        ->capture_default_str();
}

bool adjustment_options_given(const CLI::App& app) {
  return std::any_of(std::begin(kOptions), std::end(kOptions), [&](const AdjustmentOption& option) {
    return app.get_option(option.name)->count() > 0;
  });
}

}  // namespace plenolab
