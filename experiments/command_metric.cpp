#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/suggest.h"
#include "experiments/score.h"

namespace plenolab {

namespace {

struct MetricOptions {
  CommonOptions common;
  std::string reference, test;
  std::string names = "all";
  double exposure = 0, cd_m2_per_unit = 1;
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

void run_metric(const Invocation& invocation, const MetricOptions& options) {
  const auto chosen = metrics_named(options.names);
  Provenance provenance = begin_run(invocation, options.common);
  const AnyImage reference = read_any_image(options.reference);
  const AnyImage test = read_any_image(options.test);
  add_input(provenance, options.reference);
  add_input(provenance, options.test);
  if (reference.index() != test.index())
    throw InputError(
        fmt::format("{} and {} cannot be compared: one is scene-referred, the other display-referred",
                    options.reference, options.test));
  ComparisonConditions conditions;
  conditions.cd_m2_per_unit = options.cd_m2_per_unit;
  conditions.threads = options.common.threads;
  std::vector<Measurement> measurements;
  if (const auto* scene = std::get_if<SceneImage>(&reference)) {
    conditions.exposure = options.exposure > 0 ? static_cast<float>(options.exposure) : exposure_from(*scene);
    measurements = measure(std::get<SceneImage>(test), *scene, chosen, conditions);
  } else {
    if (options.exposure > 0) throw UsageError("--exposure is for images with radiance, not for .png");
    measurements =
        measure(std::get<DisplayImage>(test), std::get<DisplayImage>(reference), chosen, conditions);
  }
  provenance.parameters["exposure"] = conditions.exposure;
  provenance.parameters["cd_m2_per_unit"] = conditions.cd_m2_per_unit;
  if (measurements.empty())
    throw InputError(fmt::format("none of the metrics '{}' takes this kind of image", options.names));
  ResultTable table;
  add_measurement_rows(table, measurements, {{"test", options.test}, {"reference", options.reference}});
  emit_results(table, provenance, options.common);
}

std::string metric_names() {
  std::string names;
  for (const Metric& metric : metrics()) names += (names.empty() ? "" : ", ") + metric.name;
  return names;
}

}  // namespace

void add_metric_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<MetricOptions>();
  app.add_option("--ref", options->reference, "Reference image (.exr .hdr .pfm .png)")->required();
  app.add_option("--test", options->test, "Test image of the same size")->required();
  app.add_option("--metric", options->names, "Metrics or families, comma-separated: " + metric_names())
      ->capture_default_str();
  app.add_option("--exposure", options->exposure,
                 "Scale before gamma encoding (default: 99th percentile of the reference becomes 1)")
      ->check(positive_number());
  app.add_option("--cd-m2-per-unit", options->cd_m2_per_unit, "Luminance of a pixel value of 1, for PQ")
      ->check(positive_number())
      ->capture_default_str();
  add_common_options(app, options->common);
  app.footer("Example: plenolab metric --ref truth.exr --test novel.exr --metric psnr,ssim");
  app.callback([options, &invocation] { run_metric(invocation, *options); });
}

}  // namespace plenolab
