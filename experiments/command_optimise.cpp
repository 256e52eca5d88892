#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <memory>

#include "analysis/plot.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/suggest.h"
#include "experiments/cli/viewing_options.h"
#include "experiments/optimise/tone_optimiser.h"
#include "experiments/tonemap_fit.h"

namespace plenolab {

void add_optimise_command(CLI::App& app, const Invocation& invocation);

namespace {

struct OptimiseOptions {
  CommonOptions common;
  ToneOptimisationOptions search;
  std::string image, out, trace, plot;
  double cd_m2_per_unit = 0;
  ViewingConditions viewing;
  bool relative = false;
};

void check_quantity(const std::string& quantity) {
  const std::vector<std::string> known = objective_quantities();
  if (std::find(known.begin(), known.end(), quantity) != known.end()) return;
  const std::string similar = did_you_mean(quantity, known);
  throw UsageError(
      fmt::format("--metric: '{}' is no quantity of a metric that judges tone mapped images{}", quantity,
                  similar.empty() ? fmt::format("; there are {}", fmt::join(known, ", ")) : similar));
}

ResultTable trace_rows(const Evolution& evolution, const Objective& objective) {
  const std::vector<SearchParameter> space = generic_search_space();
  ResultTable table;
  for (const EvolutionStep& step : evolution.trace) {
    const decltype(ResultRow::columns) columns{{"iteration", static_cast<long long>(step.iteration)}};
    // Costs of quantities whose higher values are better have the sign turned.
    table.add({objective.quantity, objective.cost(step.score), objective.unit, columns});
    table.add({"deviation", step.deviation, "1", columns});
    table.add({"evaluations", static_cast<double>(step.evaluations), "images", columns});
    for (std::size_t k = 0; k < space.size(); ++k)
      table.add({"parameter_" + space[k].name, step.parameters[k], "1", columns});
  }
  return table;
}

Plot trace_plot(const Evolution& evolution, const Objective& objective) {
  Plot plot;
  plot.x = {.title = "Images judged"};
  plot.y = {.title = objective.quantity + " at the size of the search", .unit = objective.unit};
  plot.key = KeyPosition::kNone;
  PlotSeries best{.title = "Best so far"};
  for (const EvolutionStep& step : evolution.trace)
    best.points.push_back({.x = static_cast<double>(step.evaluations), .y = objective.cost(step.score)});
  plot.series = {best};
  return plot;
}

ResultTable rows_of(const ToneOptimisation& found, const OptimiseOptions& options,
                    const Objective& objective) {
  const decltype(ResultRow::columns) image{{"image", options.image}};
  const auto with = [&](const char* column, const char* cell) {
    auto columns = image;
    columns.push_back({column, std::string(cell)});
    return columns;
  };
  ResultTable table;
  table.add({objective.quantity, found.start_value, objective.unit, with("parameters", "start")});
  table.add({objective.quantity, found.best_value, objective.unit, with("parameters", "optimised")});
  const std::vector<double> best = parameters_of(found.best);
  const std::vector<SearchParameter> space = generic_search_space();
  for (std::size_t k = 0; k < space.size(); ++k)
    table.add({"parameter_" + space[k].name, best[k], "1", image});
  table.add({"iterations", static_cast<double>(found.evolution.trace.back().iteration), "iterations", image});
  table.add({"evaluations", static_cast<double>(found.evolution.trace.back().evaluations), "images", image});
  table.add({"converged", found.evolution.converged ? 1.0 : 0.0, "1", image});
  table.add({"seconds_search", found.seconds_search, "s", image});
  return table;
}

/// The settings as `tonemap --operator generic` takes them.
std::string settings_line(const GenericOptions& o) {
  return fmt::format(
      "--set b={} --set d_l={} --set d_h={} --set c={} --set m1={} --set m2={} --set m3={} "
      "--set scale={}",
      o.brightness, o.low_range, o.high_range, o.contrast, o.fine, o.middle, o.coarse, o.band_scale);
}

ComparisonConditions conditions_of(const OptimiseOptions& options, const Objective& objective) {
  const std::optional<double> scale = luminance_scale(options.cd_m2_per_unit, options.image);
  if (!scale && objective.absolute_luminance) throw UsageError(scale_needed(objective.quantity));
  if (!objective.viewing && !(options.viewing == ViewingConditions{}))
    throw UsageError(
        fmt::format("viewing conditions are for drim: {} does not depend on them", objective.quantity));
  require_valid(options.viewing);
  ComparisonConditions conditions;
  conditions.threads = options.common.threads;
  conditions.cd_m2_per_unit = scale.value_or(1);
  conditions.viewing = options.viewing;
  return conditions;
}

/// What the user would not see in the numbers.
void add_notes(ResultTable& table, const ToneOptimisation& found, const Objective& objective) {
  const auto note = [&](std::string text) {
    table.add({kNoteQuantity, 0, "1", {{"note", std::move(text)}}});
  };
  if (found.start_kept)
    note(fmt::format(
        "The parameters of the start were kept: what was found on the smaller image has {:.4g} at "
        "full size; a smaller --shrink searches closer to it.",
        found.found_value));
  std::string bounds;
  const std::vector<SearchParameter> space = generic_search_space();
  for (std::size_t k = 0; k < space.size(); ++k)
    if (const double v = found.evolution.best[k]; v <= space[k].minimum || v >= space[k].maximum)
      bounds += (bounds.empty() ? "" : ", ") + space[k].name;
  if (!bounds.empty() && !found.start_kept)
    note(fmt::format("At an end of the range: {}; the best may lie beyond.", bounds));
  if (found.repairs.total() > 0)
    note(fmt::format(
        "{} values of the image were NaN, infinite or negative and count as 0 or the largest one.",
        found.repairs.total()));
  if (objective.quantity == "brisque_plenolab")
    note(
        "brisque_plenolab knows noise, blur, JPEG and few levels; a search may find pictures that it likes "
        "and "
        "people do not.");
}

/// The picture comes last: where anything else cannot be written there is none.
void write_results_of(const OptimiseOptions& options, const ToneOptimisation& found,
                      const Objective& objective, Provenance& provenance) {
  if (!options.trace.empty()) write_text_file(options.trace, to_csv(trace_rows(found.evolution, objective)));
  if (!options.plot.empty()) write_plot(trace_plot(found.evolution, objective), options.plot);
  write_run_json_beside(options.out, provenance);
  write_display_image(options.out, found.image);
}

/// In single quotes if a shell would take it for anything but one word.
std::string quoted_for_shell(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("_./-+:,@%=", c); };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

void record_search(Provenance& provenance, const ToneOptimisationOptions& search) {
  provenance.parameters["metric"] = search.quantity;
  provenance.parameters["shrink"] = search.shrink;
  provenance.parameters["children"] = search.evolution.children;
  provenance.parameters["iterations"] = search.evolution.most_iterations;
  provenance.parameters["deviation"] = search.evolution.deviation;
  provenance.parameters["relative"] = search.evolution.relative_deviation;
}

ToneOptimisation optimise_with_progress(const SceneImage& image, const ComparisonConditions& conditions,
                                        const ToneOptimisationOptions& search) {
  ProgressBar bar("optimising");
  const ToneOptimisation found = optimise_tones(image, conditions, search, [&](const EvolutionStep& step) {
    bar.update(static_cast<double>(step.iteration) / std::max(1, search.evolution.most_iterations));
    bar.remark(fmt::format("{} {:.4g}", search.quantity, std::abs(step.score)));
  });
  bar.clear();
  return found;
}

void run_optimise(const Invocation& invocation, const OptimiseOptions& given) {
  OptimiseOptions options = given;
  check_quantity(options.search.quantity);
  options.search.evolution.seed = options.common.seed;
  options.search.evolution.relative_deviation = options.relative;
  Provenance provenance = begin_run(invocation, options.common);
  const OperatorView view = read_operator_view(options.image);
  add_input(provenance, options.image);
  require_keeps_inputs(provenance, options.out);
  const Objective objective = describe_objective(options.search.quantity);
  const ComparisonConditions conditions = conditions_of(options, objective);
  provenance.parameters["cd_m2_per_unit"] = conditions.cd_m2_per_unit;
  record_viewing(provenance, conditions.viewing);
  record_search(provenance, options.search);
  const ToneOptimisation found = optimise_with_progress(*view.colour, conditions, options.search);
  write_results_of(options, found, objective, provenance);
  tell(options.common, fmt::format("wrote {}", options.out));
  ResultTable table = rows_of(found, options, objective);
  add_notes(table, found, objective);
  emit_results(table, provenance, options.common);
  tell(options.common, fmt::format("The same by hand: plenolab tonemap {} -o OUT.png --operator generic {}",
                                   quoted_for_shell(options.image), settings_line(found.best)));
}

void add_search_options(CLI::App& app, OptimiseOptions& options) {
  EvolutionOptions& evolution = options.search.evolution;
  app.add_option("--children", evolution.children, "Images judged in each iteration")
      ->capture_default_str()
      ->check(whole_number(1, 100000));
  app.add_option("--iterations", evolution.most_iterations, "Iterations at most")
      ->capture_default_str()
      ->check(whole_number(0, 1000000));
  app.add_option("--deviation", evolution.deviation, "First standard deviation of the children")
      ->capture_default_str()
      ->check(positive_number());
  app.add_flag("--relative", options.relative, "Deviations in units of each parameter's range");
  app.add_option("--shrink", options.search.shrink, "Search on the image averaged down by this")
      ->capture_default_str()
      ->check(whole_number(1, 64));
}

}  // namespace

void add_optimise_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<OptimiseOptions>();
  app.add_option("image", options->image, "Image with radiance (.exr .hdr .pfm)")->required();
  app.add_option("-o,--out", options->out, "Tone mapped image (.png)")
      ->required()
      ->check(file_ending_in({".png"}));
  app.add_option("--metric", options->search.quantity,
                 "Quantity to improve, of a metric that judges tone mapped images")
      ->capture_default_str();
  add_search_options(app, *options);
  add_luminance_scale_option(app, options->cd_m2_per_unit);
  add_viewing_options(app, options->viewing);
  app.add_option("--trace", options->trace, "Best parameters after each iteration, to this file (.csv)")
      ->check(file_ending_in({".csv"}));
  app.add_option("--plot", options->plot, "Also draw the trace: files NAME.svg, NAME.pdf, …")
      ->check(not_empty());
  add_common_options(app, options->common);
  app.footer("Example: plenolab optimise photo.exr -o tuned.png --shrink 4 --cd-m2-per-unit 100");
  app.callback([options, &invocation] { run_optimise(invocation, *options); });
}

}  // namespace plenolab
