#include "experiments/cli/synthesis_options.h"

#include <CLI/CLI.hpp>
#include <map>

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
      ->check(CLI::IsMember(names))
      ->default_str(current);
}

}  // namespace

void add_synthesis_options(CLI::App& app, SynthesisOptions& options) {
  add_choice(app, "--camera", options.camera,
             {{"shifted", CameraKind::kShiftedFrustum}, {"fixed-screen", CameraKind::kFixedScreen}},
             "Shifted frustum, or a screen that stands still in the scene");
  app.add_option("--screen-depth", options.screen_depth_m, "Depth of the fixed screen in metres");
  add_choice(app, "--search", options.search, {{"linear", SearchKind::kLinear}, {"fast", SearchKind::kFast}},
             "Literal search or the fast one (same result)");
  app.add_option("--step", options.step_px, "Distance of search samples in pixels, 0.25 to 4")
      ->capture_default_str();
  app.add_option("--key-views", options.key_views, "Use the nearest 4, 2 or 1 key views")
      ->check(CLI::IsMember({1, 2, 4}))
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

}  // namespace plenolab
