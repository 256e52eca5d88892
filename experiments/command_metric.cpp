#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/suggest.h"
#include "experiments/cli/viewing_options.h"
#include "experiments/metric_list.h"
#include "experiments/metric_maps.h"
#include "experiments/score.h"
#include "experiments/tonemap_fit.h"

namespace plenolab {

namespace {

struct MetricOptions {
  CommonOptions common;
  std::string reference, test, maps;
  std::string names = "all";
  double exposure = 0, cd_m2_per_unit = 0;
  ViewingConditions viewing;
  bool force = false, list = false, ignore_undefined = false;
};

/// What is compared, as read from files; no reference if none is given.
struct MetricInput {
  AnyImage test;
  std::optional<AnyImage> reference;
  std::optional<double> cd_m2_per_unit;  ///< nothing if neither the user nor a file says
};

/// Throws UsageError with the nearest name for one that there is not.
std::vector<const Metric*> metrics_named(const std::string& names) {
  const std::vector<std::string> wanted = split_list(names);
  if (wanted.empty()) throw UsageError("--metric: give at least one metric or family, or all");
  std::vector<std::string> known{"all"};
  for (const Metric& metric : metrics()) known.insert(known.end(), {metric.name, metric.family});
  for (const std::string& name : wanted)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(fmt::format("--metric: there is no metric '{}'{}", name, did_you_mean(name, known)));
  return select_metrics(wanted);
}

/// The scale that the user or the files give; throws InputError if files contradict each other.
std::optional<double> scale_of(const MetricOptions& options) {
  if (options.cd_m2_per_unit > 0) return options.cd_m2_per_unit;
  std::optional<double> scale;
  for (const std::string& path : {options.reference, options.test}) {
    if (path.empty() || is_display_file(path)) continue;
    const std::optional<double> declared = declared_cd_m2_per_unit(path);
    if (scale && declared && *scale != *declared)
      throw InputError(
          fmt::format("{} says that a value of 1 is {} cd/m², {} says {}; --cd-m2-per-unit decides for both",
                      options.reference, *scale, options.test, *declared));
    if (declared) scale = declared;
  }
  return scale;
}

bool has_radiance(const MetricInput& input) {
  return std::holds_alternative<SceneImage>(input.test) ||
         (input.reference && std::holds_alternative<SceneImage>(*input.reference));
}

/// Without a scale, metrics of absolute luminance are refused if they were asked for by name, and left out of
/// "all" with a note.
std::vector<const Metric*> with_known_scale(std::vector<const Metric*> chosen, const MetricInput& input,
                                            const MetricOptions& options, ResultTable& table) {
  if (input.cd_m2_per_unit || !has_radiance(input)) return chosen;
  const std::vector<std::string> named = split_list(options.names);
  const auto needs_scale = [](const Metric* metric) { return metric->absolute_luminance; };
  for (const Metric* metric : chosen) {
    if (!needs_scale(metric)) continue;
    for (const std::string& name : named)
      if (name == metric->name || name == metric->family) throw UsageError(scale_needed(metric->name));
    table.add({kNoteQuantity,
               0,
               "1",
               {{"note", fmt::format("{} is left out: --cd-m2-per-unit would say what a pixel value of 1 is.",
                                     metric->name)}}});
  }
  std::erase_if(chosen, needs_scale);
  return chosen;
}

MetricInput read_input(const MetricOptions& options, Provenance& provenance) {
  MetricInput input;
  if (!options.reference.empty()) {
    input.reference = read_any_image(options.reference);
    add_input(provenance, options.reference);
  }
  input.test = read_any_image(options.test);
  add_input(provenance, options.test);
  input.cd_m2_per_unit = scale_of(options);
  return input;
}

ComparisonConditions conditions_for(const MetricInput& input, const MetricOptions& options,
                                    Provenance& provenance) {
  ComparisonConditions conditions;
  conditions.cd_m2_per_unit = input.cd_m2_per_unit.value_or(1);
  conditions.viewing = options.viewing;
  conditions.threads = options.common.threads;
  const auto* scene = input.reference ? std::get_if<SceneImage>(&*input.reference) : nullptr;
  const bool exposed = scene != nullptr && std::holds_alternative<SceneImage>(input.test);
  if (options.exposure > 0 && !exposed)
    throw UsageError("--exposure is for two images with radiance, not for .png");
  if (exposed)
    conditions.exposure = options.exposure > 0 ? static_cast<float>(options.exposure) : exposure_from(*scene);
  provenance.parameters["exposure"] = conditions.exposure;
  provenance.parameters["cd_m2_per_unit"] = conditions.cd_m2_per_unit;
  record_viewing(provenance, options.viewing);
  return conditions;
}

std::vector<Measurement> measure_input(const MetricInput& input, const MetricOptions& options,
                                       const std::vector<const Metric*>& chosen,
                                       const ComparisonConditions& conditions, Provenance& provenance) {
  if (!input.reference) {
    const auto* picture = std::get_if<DisplayImage>(&input.test);
    if (picture == nullptr)
      throw InputError(
          fmt::format("{} has radiance; metrics without a reference judge a .png", options.test));
    return measure(*picture, chosen, conditions);
  }
  if (options.maps.empty()) return measure_with_maps(input.test, *input.reference, chosen, conditions);
  std::vector<Measurement> measurements;
  const std::string item = fmt::format("{} {}", item_path(options.test), item_path(options.reference));
  write_result_folder(
      {options.maps, "metric", item, options.force}, provenance, [&](const std::filesystem::path& folder) {
        measurements = measure_with_maps(input.test, *input.reference, chosen, conditions, folder);
      });
  return measurements;
}

bool takes(const Metric& metric, const MetricInput& input) {
  const bool scene = std::holds_alternative<SceneImage>(input.test);
  if (!input.reference) return !scene && metric.judge;
  if (std::holds_alternative<DisplayImage>(*input.reference))
    return !scene && (metric.compare_display || metric.judge);
  return scene ? static_cast<bool>(metric.compare_scene) : metric.compare_mapped || metric.judge;
}

/// "all" leaves out what does not suit the images; of those asked for by name none may be left out.
void require_named_are_taken(const std::vector<const Metric*>& chosen, const MetricInput& input,
                             const MetricOptions& options) {
  const std::vector<std::string> named = split_list(options.names);
  if (std::find(named.begin(), named.end(), "all") != named.end()) return;
  if (!input.reference && std::holds_alternative<SceneImage>(input.test)) return;  // said when it is measured
  std::vector<std::string> taken;
  for (const Metric& metric : metrics())
    if (takes(metric, input)) taken.push_back(metric.name);
  for (const Metric* metric : chosen)
    if (!takes(*metric, input))
      throw UsageError(fmt::format(
          "--metric: {} does not take this kind of images; {}", metric->name,
          taken.empty() ? "none does" : fmt::format("those that do are {}", fmt::join(taken, ", "))));
}

void run_list(const Invocation& invocation, const MetricOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  if (!output_is_for_programs(options.common)) fmt::print("{}", metric_list_text());
  write_results(metric_list_rows(), provenance, options.common);
}

/// Pixels that are finite in both images; nothing if that is all of them.
std::optional<Mask> defined_pixels(const MetricInput& input) {
  const auto mask_of = [](const AnyImage& any) {
    return std::visit([](const auto& image) { return mask_of_finite(image); }, any);
  };
  Mask mask = mask_of(input.test);
  if (input.reference) {
    const Mask other = mask_of(*input.reference);
    for (std::size_t i = 0; i < mask.size() && i < other.size(); ++i)
      mask.pixels()[i] = static_cast<unsigned char>(mask.pixels()[i] & other.pixels()[i]);
  }
  const auto pixels = mask.pixels();
  if (std::all_of(pixels.begin(), pixels.end(), [](unsigned char v) { return v != 0; })) return {};
  return mask;
}

void run_metric(const Invocation& invocation, const MetricOptions& options) {
  if (options.list) return run_list(invocation, options);
  if (options.test.empty())
    throw UsageError(
        "give --test, the image to measure, or --list to see the metrics (see 'plenolab metric --help')");
  std::vector<const Metric*> chosen = metrics_named(options.names);
  if (options.reference.empty()) {
    const bool judging =
        std::any_of(chosen.begin(), chosen.end(), [](const Metric* metric) { return !!metric->judge; });
    if (!judging) throw UsageError(fmt::format("--ref: '{}' compares with a reference image", options.names));
    if (!options.maps.empty()) throw UsageError("--maps: there are maps only of two images; give --ref, too");
  }
  require_valid(options.viewing);
  Provenance provenance = begin_run(invocation, options.common);
  const MetricInput input = read_input(options, provenance);
  require_named_are_taken(chosen, input, options);
  ResultTable table;
  chosen = with_known_scale(std::move(chosen), input, options, table);
  ComparisonConditions conditions = conditions_for(input, options, provenance);
  const std::optional<Mask> defined = options.ignore_undefined ? defined_pixels(input) : std::nullopt;
  if (defined) {
    conditions.valid = &*defined;
    const auto ignored = std::count(defined->pixels().begin(), defined->pixels().end(), 0);
    table.add({"ignored_pixels", static_cast<double>(ignored), "px", {{"test", options.test}}});
  }
  const auto measurements = measure_input(input, options, chosen, conditions, provenance);
  if (measurements.empty())
    throw InputError(fmt::format("none of the metrics '{}' takes this kind of image", options.names));
  Columns columns{{"test", options.test}};
  if (input.reference) columns.push_back({"reference", options.reference});
  add_measurement_rows(table, measurements, columns);
  emit_results(table, provenance, options.common);
  if (!options.maps.empty()) tell(options.common, fmt::format("wrote {}", options.maps));
}

std::string metric_names() {
  std::string names;
  for (const Metric& metric : metrics()) names += (names.empty() ? "" : ", ") + metric.name;
  return names;
}

}  // namespace

void add_metric_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<MetricOptions>();
  app.add_option("--ref", options->reference,
                 "Reference image (.exr .hdr .pfm .png); metrics that judge one image alone need none");
  app.add_option("--test", options->test,
                 "Test image of the same size; a .png beside an .exr is its tone mapped version");
  app.add_flag("--list", options->list,
               "List metrics, what they take, their quantities and which way is better");
  app.add_option("--metric", options->names, "Metrics or families, comma-separated: " + metric_names())
      ->capture_default_str();
  app.add_option("--exposure", options->exposure,
                 "Scale before gamma encoding (default: 99th percentile of the reference becomes 1)")
      ->check(positive_number());
  add_luminance_scale_option(app, options->cd_m2_per_unit, "1 for PQ");
  add_viewing_options(app, options->viewing);
  app.add_flag("--ignore-undefined", options->ignore_undefined,
               "Leave out pixels that are NaN or infinite in either image");
  app.add_option("--maps", options->maps, "Folder for pictures of where the images differ");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab metric --ref truth.exr --test novel.exr --metric psnr,ssim\n"
      "          plenolab metric --ref scene.exr --test mapped.png --metric drim,tmqi --maps maps\n"
      "          plenolab metric --list");
  app.callback([options, &invocation] { run_metric(invocation, *options); });
}

}  // namespace plenolab
