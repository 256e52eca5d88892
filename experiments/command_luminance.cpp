#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "core/base/error.h"
#include "core/luminance/display_folder.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/display_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/luminance_run.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct LuminanceCommandOptions {
  CommonOptions common;
  DisplayOptions display;
  std::string source, methods = "all,brute-force,accumulative,spread", pinhole = "256x144", out, observers;
  bool smoothed = false, images = false, force = false;
  LogAverageOptions average;
  RayReinhardOptions reinhard;
};

/// Height of an observer of whom only x is given.
constexpr double kMiddleRow = std::numeric_limits<double>::quiet_NaN();

/// Methods and observers, as asked for.
struct Plan {
  std::vector<LuminanceOptions> methods;
  std::vector<NamedObserver> observers;  ///< empty: three of the display's range
};

double metres(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !std::isfinite(value))
    throw UsageError(
        fmt::format("--observers: give positions in metres, e.g. -4,0,4, or X:Y on a plane, not '{}'", text));
  return value == 0 ? 0 : value;  // not -0
}

/// A position with the name that files have of it.
NamedObserver observer_named(const std::string& text) {
  const auto colon = text.find(':');
  const double x = metres(text.substr(0, colon));
  if (colon == std::string::npos) return {fmt::format("{:g}m", x), {x, kMiddleRow}};
  const double y = metres(text.substr(colon + 1));
  return {fmt::format("{:g}m-{:g}m", x, y), {x, y}};
}

/// Results would replace each other.
void require_different(std::vector<std::string> names, const char* option, const char* what) {
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end())
    throw UsageError(fmt::format("{}: give each {} once, not {} twice", option, what, *twice));
}

PinholeSize pinhole_of(const std::string& text) {
  PinholeSize size;
  int used = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%n", &size.width, &size.height, &used) != 2 ||
      used != static_cast<int>(text.size()))
    throw UsageError(fmt::format("--pinhole: give a size as WIDTHxHEIGHT, e.g. 256x144, not '{}'", text));
  if (size.width < 1 || size.height < 1 || size.width > 16'384 || size.height > 16'384)
    throw UsageError(fmt::format("--pinhole: give 1 to 16384 pixels each way, not '{}'", text));
  return size;
}

Plan plan_of(const LuminanceCommandOptions& options) {
  Plan plan;
  const std::vector<std::string>& known = luminance_method_names();
  for (const std::string& name : split_list(options.methods)) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(
          fmt::format("--method: there is no method '{}' (there are: {})", name, fmt::join(known, ", ")));
    plan.methods.push_back({.method = luminance_method_named(name),
                            .average = options.average,
                            .pinhole = pinhole_of(options.pinhole),
                            .threads = options.common.threads});
    plan.methods.back().smoothed = options.smoothed && name == "accumulative";
  }
  if (plan.methods.empty()) throw UsageError("--method: give at least one method");
  require_different(split_list(options.methods), "--method", "method");
  if (options.smoothed &&
      std::none_of(plan.methods.begin(), plan.methods.end(), [](const auto& m) { return m.smoothed; }))
    throw UsageError("--smoothed is for the method accumulative");
  std::vector<std::string> positions;
  for (const std::string& text : split_list(options.observers)) {
    plan.observers.push_back(observer_named(text));
    positions.push_back(plan.observers.back().name);
  }
  require_different(std::move(positions), "--observers", "position");
  return plan;
}

/// Three of the range. Displays with separate positions are looked at from the nearest of these: between two,
/// the picture of neither is what the scene shows there.
std::vector<NamedObserver> default_observers(const RayDisplay& display) {
  const DisplaySpace& space = display.space();
  const double middle = (space.x_min_m + space.x_max_m) / 2, half = (space.x_max_m - space.x_min_m) / 2,
               y = (space.y_min_m + space.y_max_m) / 2;
  const bool projectors = dynamic_cast<const ProjectorDisplay*>(&display) != nullptr;
  const ObserverSamples positions = observer_samples(display, {});
  std::vector<NamedObserver> observers;
  for (const auto& [name, side] : {std::pair{"centre", 0.0}, {"left", -0.8}, {"right", 0.8}}) {
    ObserverPosition at{middle + side * half, y};
    if (!projectors) at = positions.position(positions.nearest(at));
    const bool taken = std::any_of(observers.begin(), observers.end(),
                                   [&](const NamedObserver& other) { return other.position.x_m == at.x_m; });
    if (!taken) observers.push_back({name, at});
  }
  std::sort(observers.begin(), observers.end(),
            [](const NamedObserver& a, const NamedObserver& b) { return a.position.x_m < b.position.x_m; });
  return observers;
}

std::vector<NamedObserver> observers_of(const Plan& plan, const RayDisplay& display) {
  if (plan.observers.empty()) return default_observers(display);
  const DisplaySpace& space = display.space();
  const ObserverSamples positions = observer_samples(display, {});
  const double middle = (space.y_min_m + space.y_max_m) / 2;
  const int row = positions.nearest({positions.position(0).x_m, middle});
  std::vector<NamedObserver> observers = plan.observers;
  for (NamedObserver& observer : observers) {
    if (std::isnan(observer.position.y_m))
      observer.position.y_m = space.on_a_plane() ? positions.position(row).y_m : middle;
    else if (!space.on_a_plane())
      throw UsageError(
          "--observers: X:Y is for displays with full parallax; others have a line of observers");
  }
  return observers;
}

void require_display_images(const LuminanceCommandOptions& options) {
  if (!options.images) return;
  const bool projectors =
      fs::exists(options.source) ? is_display_folder(options.source) : options.display.kind == "projectors";
  if (options.out.empty() || !projectors)
    throw UsageError("--display-images writes images of projectors: give -o, and no other display");
}

/// What the run is told to do, once the field is known.
LuminancePlan full_plan(const LuminanceCommandOptions& options, const Plan& plan, const ShownField& field) {
  return {.source = options.source,
          .methods = plan.methods,
          .observers = observers_of(plan, *field.display),
          .samples = observer_samples(*field.display, options.display),
          .average = options.average,
          .reinhard = options.reinhard,
          .display_images = options.images,
          .threads = options.common.threads};
}

void record_options(Provenance& provenance, const LuminanceCommandOptions& options, const ShownField& field) {
  if (is_display_scene(options.source)) {
    provenance.parameters["display"] = options.display.kind;
    provenance.parameters["preset"] = options.display.preset.empty() ? "small" : options.display.preset;
  }
  provenance.parameters["epsilon_" + luminance_unit(field).suffix] = options.average.epsilon;
  provenance.parameters["key"] = options.reinhard.key;
  if (options.display.cd_m2_per_unit > 0)
    provenance.parameters["cd_m2_per_unit"] = options.display.cd_m2_per_unit;
}

void run_luminance(const Invocation& invocation, const LuminanceCommandOptions& options) {
  require_field_source(options.source, options.display);
  const Plan plan = plan_of(options);
  require_display_images(options);
  Provenance provenance = begin_run(invocation, options.common);
  if (fs::exists(options.source)) add_input(provenance, options.source);
  const ShownField field = open_field(options.source, options.display, {.threads = options.common.threads});
  record_options(provenance, options, field);
  const LuminancePlan full = full_plan(options, plan, field);
  LuminanceResults results;
  if (options.out.empty())
    results = run_luminance_plan(field, full, {});
  else
    write_result_folder({options.out, "luminance", options.source, options.force}, provenance,
                        [&](const fs::path& folder) { results = run_luminance_plan(field, full, folder); });
  if (!output_is_for_programs(options.common)) fmt::print("{}", luminance_tables(field, results));
  write_results(results.rows, provenance, options.common);
  for (const std::string& note : results.notes) tell(options.common, note);
  if (!options.out.empty()) tell(options.common, fmt::format("wrote {}", options.out));
}

void add_method_options(CLI::App& app, LuminanceCommandOptions& options) {
  app.add_option("--method", options.methods, "all, brute-force, accumulative, spread; several with commas")
      ->capture_default_str();
  app.add_flag("--smoothed", options.smoothed, "Accumulative: add half of the neighbouring samples");
  app.add_option("--pinhole", options.pinhole, "Size of brute force's pinhole images")->capture_default_str();
  app.add_option("--epsilon", options.average.epsilon,
                 "Luminance that pixels must exceed to count, in cd/m² or the unit of a relative source")
      ->check(number_between(1e-30, 1e30))
      ->capture_default_str();
  app.add_option("--key", options.reinhard.key, "Key value of the tone mapping")
      ->check(number_between(1e-6, 4))
      ->capture_default_str();
}

}  // namespace

void add_luminance_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<LuminanceCommandOptions>();
  app.add_option(
         "source", options->source,
         "Scene (pillars, sphere), folder with display.json and projector images in cd/m², or folder "
         "of a light field, the cameras of whose middle row become views; its luminance may be relative")
      ->required();
  add_method_options(app, *options);
  add_display_options(app, options->display);
  app.add_option(
      "--observers", options->observers,
      "Positions in metres that are looked from, X or, for full parallax, X:Y (default: left, centre and "
      "right of the range, for displays with separate views the nearest of these)");
  app.add_option("-o,--out", options->out, "Folder for views, plot and samples.csv")->check(not_empty());
  app.add_flag("--display-images", options->images, "Also write the projectors' images, with display.json");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.get_option("--seed")->description("Taken as everywhere; nothing here is random");
  app.footer(
      "Examples: plenolab luminance sphere -o results/sphere\n"
      "          plenolab luminance pillars --method accumulative,spread --preset full --observers -2,2");
  app.callback([options, &invocation] { run_luminance(invocation, *options); });
}

}  // namespace plenolab
