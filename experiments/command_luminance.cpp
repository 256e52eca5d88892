#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "analysis/plot.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "core/luminance/display_folder.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/display_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/wide_table.h"
#include "experiments/score.h"

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

/// Methods and observers, as asked for.
struct Plan {
  std::vector<LuminanceOptions> methods;
  std::vector<double> observers_m;  ///< empty: three of the display's range
};

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : split_list(text)) {
    char* end = nullptr;
    numbers.push_back(std::strtod(part.c_str(), &end));
    if (end == part.c_str() || *end != '\0' || !std::isfinite(numbers.back()))
      throw UsageError(fmt::format("--observers: give positions in metres, e.g. -4,0,4, not '{}'", text));
  }
  return numbers;
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
  if (options.smoothed &&
      std::none_of(plan.methods.begin(), plan.methods.end(), [](const auto& m) { return m.smoothed; }))
    throw UsageError("--smoothed is for the method accumulative");
  plan.observers_m = numbers_of(options.observers);
  return plan;
}

/// An observer that is looked through, and how files and rows name it.
struct Observer {
  std::string name;
  ObserverPosition position;
};

std::vector<Observer> observers_of(const Plan& plan, const DisplaySpace& space) {
  std::vector<Observer> observers;
  const double y = (space.y_min_m + space.y_max_m) / 2;
  if (!plan.observers_m.empty()) {
    for (const double x : plan.observers_m) observers.push_back({fmt::format("{:g}m", x), {x, y}});
    return observers;
  }
  const double middle = (space.x_min_m + space.x_max_m) / 2, half = (space.x_max_m - space.x_min_m) / 2;
  for (const auto& [name, side] : {std::pair{"left", -0.8}, {"centre", 0.0}, {"right", 0.8}})
    observers.push_back({name, {middle + side * half, y}});
  return observers;
}

/// One run of the command.
struct Run {
  const LuminanceCommandOptions& options;
  const ShownField& field;
  std::vector<TimedEstimate> estimates;
  std::vector<LuminanceOptions> methods;
  ResultTable rows, samples;

  Columns columns(const LuminanceOptions& method) const {
    return {{"source", options.source}, {"method", setting_name(method)}};
  }
};

void add_method_rows(Run& run, const LuminanceOptions& method, const TimedEstimate& estimate) {
  const Columns columns = run.columns(method);
  const GlobalLuminance& luminance = estimate.luminance;
  run.rows.add({"seconds", estimate.seconds, "s", columns});
  run.rows.add({"samples", static_cast<double>(luminance.samples.size()), "samples", columns});
  run.rows.add({"undefined_samples", static_cast<double>(luminance.undefined()), "samples", columns});
  if (!luminance.known()) return;
  const auto [low, high] = std::minmax_element(luminance.ln_luminance.begin(), luminance.ln_luminance.end());
  run.rows.add({"luminance_min_cd_m2", std::exp(*low), "cd/m²", columns});
  run.rows.add({"luminance_max_cd_m2", std::exp(*high), "cd/m²", columns});
  run.rows.add({"ln_total_variation", measure_curve(luminance).total_variation, "1", columns});
  for (int i = 0; i < luminance.samples.size(); ++i) {
    const ObserverPosition at = luminance.samples.position(i);
    run.samples.add({"luminance_cd_m2",
                     std::exp(luminance.ln_luminance[static_cast<std::size_t>(i)]),
                     "cd/m²",
                     {{"method", setting_name(method)},
                      {"x_m", at.x_m},
                      {"y_m", at.y_m},
                      {"defined", static_cast<long long>(luminance.defined[static_cast<std::size_t>(i)])}}});
  }
}

void write_light(const fs::path& folder, const std::string& name, const DisplayLightImage& light) {
  if (!folder.empty() && !light.empty()) write_display_image(folder / (name + ".png"), encoded(light));
}

/// What one observer sees, tone mapped with each estimate, beside the references.
void look(Run& run, const Observer& observer, const std::vector<DisplayRays>& mapped,
          const fs::path& folder) {
  const RayRendering rendering{.threads = run.options.common.threads};
  const PinholeSize size = run.field.display->resolution();
  const ReferencePictures references = reference_pictures(
      run.field, observer.position, size, run.options.reinhard, run.options.average, rendering);
  write_light(folder, "ground-truth-" + observer.name, references.ground_truth);
  write_light(folder, "on-result-" + observer.name, references.on_result);
  for (std::size_t m = 0; m < mapped.size(); ++m) {
    Columns columns = run.columns(run.methods[m]);
    columns.emplace_back("observer_x_m", observer.position.x_m);
    const auto ln = run.estimates[m].luminance.ln_at(observer.position);
    if (ln) run.rows.add({"luminance_cd_m2", std::exp(*ln), "cd/m²", columns});
    const DisplayLightImage seen =
        perceive(*run.field.display, mapped[m], observer.position, size, rendering.threads).image;
    // Black beside black compares nothing.
    if (ln && references.ln_truth)
      run.rows.add({"psnr_ground_truth_db", light_psnr_db(seen, references.ground_truth), "dB", columns});
    if (ln && references.ln_result)
      run.rows.add({"psnr_on_result_db", light_psnr_db(seen, references.on_result), "dB", columns});
    write_light(folder, fmt::format("{}-{}", name_of(run.methods[m].method), observer.name), seen);
  }
  if (folder.empty()) return;
  const SceneImage& hdr = references.result;
  write_scene_image(folder / fmt::format("perceived-{}.exr", observer.name), hdr, 1.0);
  write_display_image(folder / fmt::format("perceived-{}.png", observer.name),
                      expose(hdr, exposure_from(hdr)));
}

Plot line_plot(const Run& run) {
  Plot plot;
  plot.x = {.title = "Position on the observer line", .unit = "m"};
  plot.y = {.title = "Luminance adapted to", .unit = "cd/m²", .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    PlotSeries series{setting_name(run.methods[m]), PlotSeries::Style::kLines, {}};
    for (const CurvePoint& point : curve_of(run.estimates[m].luminance))
      series.points.push_back({point.x_m, std::exp(point.ln_luminance)});
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

void compute(Run& run, const Plan& plan, const fs::path& folder) {
  const ObserverSamples samples = observer_samples(*run.field.display, run.options.display);
  std::vector<DisplayRays> mapped;
  for (const LuminanceOptions& method : plan.methods) {
    run.methods.push_back(method);
    run.estimates.push_back(timed_estimate(run.field, samples, method));
    add_method_rows(run, method, run.estimates.back());
    mapped.push_back(map_rays(*run.field.display, run.field.rays, run.estimates.back().luminance,
                              run.options.reinhard, run.options.common.threads)
                         .light);
  }
  for (const Observer& observer : observers_of(plan, run.field.display->space()))
    look(run, observer, mapped, folder);
  if (run.field.repairs.total() > 0)
    run.rows.add({"repaired_values",
                  static_cast<double>(run.field.repairs.total()),
                  "values",
                  {{"source", run.options.source}}});
  if (folder.empty()) return;
  write_text_file(folder / "samples.csv", to_csv(run.samples));
  const Plot plot = line_plot(run);
  if (!plot.series.empty()) write_plot(plot, folder / "luminance");
  const auto* projectors = dynamic_cast<const ProjectorDisplay*>(run.field.display.get());
  if (run.options.images && projectors) write_display_folder(folder / "display", *projectors, run.field.rays);
}

void print_tables(const Run& run) {
  fmt::print("{}\n{}",
             to_wide_text(run.rows, {"source", "method"},
                          {{"luminance_min_cd_m2", "least [cd/m²]"},
                           {"luminance_max_cd_m2", "most [cd/m²]"},
                           {"ln_total_variation", "variation of ln"},
                           {"undefined_samples", "undefined"},
                           {"samples", "samples"},
                           {"seconds", "seconds"}}),
             to_wide_text(run.rows, {"method", "observer_x_m"},
                          {{"luminance_cd_m2", "luminance [cd/m²]"},
                           {"psnr_ground_truth_db", "PSNR, ground truth [dB]"},
                           {"psnr_on_result_db", "PSNR, on result [dB]"}}));
}

void run_luminance(const Invocation& invocation, const LuminanceCommandOptions& options) {
  require_field_source(options.source, options.display);
  const Plan plan = plan_of(options);
  if (options.images && (options.out.empty() || options.display.kind != "projectors"))
    throw UsageError("--display-images writes images of projectors: give -o, and no other display");
  Provenance provenance = begin_run(invocation, options.common);
  if (fs::exists(options.source)) add_input(provenance, options.source);
  provenance.parameters["display"] = options.display.kind;
  provenance.parameters["preset"] = options.display.preset;
  provenance.parameters["epsilon_cd_m2"] = options.average.epsilon;
  provenance.parameters["key"] = options.reinhard.key;
  const ShownField field = open_field(options.source, options.display, {.threads = options.common.threads});
  Run run{options, field, {}, {}, {}, {}};
  if (options.out.empty())
    compute(run, plan, {});
  else
    write_result_folder({options.out, "luminance", options.source, options.force}, provenance,
                        [&](const fs::path& folder) { compute(run, plan, folder); });
  if (!output_is_for_programs(options.common)) print_tables(run);
  write_results(run.rows, provenance, options.common);
  if (!run.estimates.front().luminance.known())
    tell(options.common,
         fmt::format("No ray of {} that counts is above {:g} cd/m²: its luminance is undefined, its "
                     "pictures are black.",
                     options.source, options.average.epsilon));
  if (!options.out.empty()) tell(options.common, fmt::format("wrote {}", options.out));
}

void add_method_options(CLI::App& app, LuminanceCommandOptions& options) {
  app.add_option("--method", options.methods, "all, brute-force, accumulative, spread; several with commas")
      ->capture_default_str();
  app.add_flag("--smoothed", options.smoothed, "Accumulative: add half of the neighbouring samples");
  app.add_option("--pinhole", options.pinhole, "Size of brute force's pinhole images")->capture_default_str();
  app.add_option("--epsilon", options.average.epsilon, "Luminance in cd/m² that pixels must exceed to count")
      ->check(number_between(1e-30, 1e30))
      ->capture_default_str();
  app.add_option("--key", options.reinhard.key, "Key value of the tone mapping")
      ->check(number_between(1e-6, 4))
      ->capture_default_str();
}

}  // namespace

void add_luminance_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<LuminanceCommandOptions>();
  app.add_option("source", options->source,
                 "Scene (pillars, sphere), folder with display.json and projector images in cd/m², or folder "
                 "of a light field, the cameras of whose middle row become views")
      ->required();
  add_method_options(app, *options);
  add_display_options(app, options->display);
  app.add_option("--observers", options->observers,
                 "Positions in metres that are looked from (default: left, centre and right of the range)");
  app.add_option("-o,--out", options->out, "Folder for views, plot and samples.csv")->check(not_empty());
  app.add_flag("--display-images", options->images, "Also write the projectors' images, with display.json");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab luminance sphere -o results/sphere\n"
      "          plenolab luminance pillars --method accumulative,spread --preset full --observers -2,2");
  app.callback([options, &invocation] { run_luminance(invocation, *options); });
}

}  // namespace plenolab
