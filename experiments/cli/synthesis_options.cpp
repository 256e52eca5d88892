#include "experiments/cli/synthesis_options.h"

#include <CLI/CLI.hpp>
#include <map>

#include "core/base/error.h"
#include "experiments/cli/checks.h"

namespace plenolab {

namespace {

template <class Enum>
void add_choice(CLI::App& app, const std::string& name, Enum& value,
                const std::map<std::string, Enum>& choices, const std::string& help) {
  std::string current;
  std::vector<std::string> names;
  for (const auto& [text, choice] : choices) {
    names.push_back(text);
    if (choice == value) current = text;
  }
  app.add_option_function<std::string>(
         name, [&value, choices](const std::string& text) { value = choices.at(text); }, help)
      ->check(one_of(names))
      ->default_str(current);
}

}  // namespace

void add_synthesis_options(CLI::App& app, SynthesisOptions& options) {
  add_choice(app, "--camera", options.camera,
             {{"shifted", CameraKind::kShiftedFrustum}, {"fixed-screen", CameraKind::kFixedScreen}},
             "Shifted frustum, or a screen that stands still in the scene");
  app.add_option("--screen-depth", options.screen_depth_m, "Depth of the fixed screen in metres")
      ->check(positive_or_infinite());
  add_choice(app, "--search", options.search, {{"linear", SearchKind::kLinear}, {"fast", SearchKind::kFast}},
             "Literal search or the fast one (same result)");
  app.add_option("--step", options.step_px, "Distance of search samples in pixels")
      ->check(number_between(0.25, 4))
      ->capture_default_str();
  app.add_option("--key-views", options.key_views, "Use the nearest 4, 2 or 1 key views")
      ->check(one_of({"4", "2", "1"}))
      ->capture_default_str();
  add_choice(app, "--border", options.border_weight,
             {{"printed", BorderWeight::kPrinted},
              {"linear", BorderWeight::kLinearGradient},
              {"none", BorderWeight::kNone}},
             "Weights towards the borders of key views");
  app.add_flag("--keep-thin", options.keep_thin, "Keep structures thinner than 2×2 pixels");
  app.add_flag("!--no-restore", options.restore, "Leave disoccluded pixels that no view shows black");
  app.add_flag("!--no-prune", options.prune, "Run also the stages that cannot change the result");
}

void require_fitting(const SynthesisOptions& options) {
  const bool fixed_screen = options.camera == CameraKind::kFixedScreen,
             has_depth = options.screen_depth_m > 0;
  if (fixed_screen && !has_depth)
    throw UsageError("--camera fixed-screen needs --screen-depth METRES: where the screen stands");
  if (!fixed_screen && has_depth)
    throw UsageError("--screen-depth is for --camera fixed-screen: the shifted frustum has no screen");
}

}  // namespace plenolab
