#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/tonemap/operators/entries.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/operator_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/result_folder.h"
#include "experiments/tonemap_fit.h"
#include "experiments/tonemap_layers.h"
#include "metrics/consistency.h"

namespace plenolab {

namespace {

struct TonemapOptions {
  CommonOptions common;
  OperatorOptions chosen;
  std::string image, out, layers, disparity;
  bool list = false, force = false;
};

OperatorView read_view(const TonemapOptions& options) {
  if (options.disparity.empty()) return read_operator_view(options.image);
  if (!is_exr_file(options.image))
    throw UsageError(fmt::format("--disparity: only .exr files have channels, not {}", options.image));
  return read_operator_view(options.image, options.disparity, true);
}

void require_disparity(const OperatorChoice& choice, const OperatorView& view, const std::string& image) {
  if (!choice.variant.needs_disparity || view.disparity) return;
  throw InputError(fmt::format(
      "{} has no channel '{}', which variant {} of {} needs: name the channel with --disparity, "
      "or choose variant {}",
      image, kDisparityChannel, choice.variant.id, choice.info->id, choice.info->variants.front().id));
}

void write_mapped(const std::string& path, const DisplayImage& image) {
  if (is_display_file(path))
    write_display_image(path, image);
  else
    write_exr(path, image, {}, {.colour_type = ExrPixelType::kFloat});
}

/// What was measured on the way.
struct MappedImage {
  ToneMapped mapped;
  FittedOperator fitted;
  double seconds_fit = 0, seconds_map = 0;
};

MappedImage map_image(const OperatorChoice& choice, const OperatorView& view,
                      std::optional<double> cd_m2_per_unit, int threads) {
  MappedImage result;
  const Stopwatch fit_watch;
  result.fitted = fit_image(choice, view, cd_m2_per_unit, threads);
  result.seconds_fit = fit_watch.seconds();
  const Stopwatch map_watch;
  result.mapped = result.fitted.apply(view, threads);
  result.seconds_map = map_watch.seconds();
  return result;
}

ResultTable rows_of(const MappedImage& result, const Columns& columns) {
  ResultTable table;
  add_fit_rows(table, result.fitted.values, result.fitted.notes, columns);
  add_count_rows(table, result.mapped.counts, columns);
  table.add({"mean_luma", mean_luma(result.mapped.image), "luma", columns});
  table.add({"seconds_fit", result.seconds_fit, "s", columns});
  table.add({"seconds_map", result.seconds_map, "s", columns});
  return table;
}

void write_layer_folder(const TonemapOptions& options, const OperatorChoice& choice, const OperatorView& view,
                        const DisplayImage& result, const Invocation& invocation) {
  Provenance provenance = begin_run(invocation, options.common);
  add_input(provenance, options.image);
  provenance.parameters["settings"] = settings_text(choice);
  const std::string item = fmt::format("{} --operator {} --variant {} --layers", item_path(options.image),
                                       choice.info->id, choice.variant.id);
  const double floor = log_floor(measure_view(*view.colour, options.common.threads));
  const BilateralLayers layers =
      bilateral_layers(bilateral_options(choice.variant.id, choice.values), *view.colour,
                       view.disparity.get(), floor, options.common.threads);
  write_result_folder({options.layers, "tonemap", item, options.force}, provenance,
                      [&](const std::filesystem::path& folder) {
                        write_text_file(folder / "layers.csv", to_csv(write_layers(layers, result, folder)));
                      });
  tell(options.common, fmt::format("wrote the layers to {}", options.layers));
}

void run_map(const Invocation& invocation, const TonemapOptions& options) {
  const OperatorChoice choice = choose_operator(options.chosen);
  require_view_variant(choice);
  require_not_adjusted(choice);
  if (!options.layers.empty() && choice.info->id != "bilateral")
    throw UsageError(fmt::format("--layers: only --operator bilateral has layers, not {}", choice.info->id));
  Provenance provenance = begin_run(invocation, options.common);
  const OperatorView view = read_view(options);
  require_disparity(choice, view, options.image);
  add_input(provenance, options.image);
  require_keeps_inputs(provenance, options.out);
  provenance.parameters["operator"] = choice.info->id;
  provenance.parameters["variant"] = choice.variant.id;
  provenance.parameters["settings"] = settings_text(choice);
  const MappedImage result =
      map_image(choice, view, declared_cd_m2_per_unit(options.image), options.common.threads);
  if (!options.layers.empty()) write_layer_folder(options, choice, view, result.mapped.image, invocation);
  write_mapped(options.out, result.mapped.image);
  write_run_json_beside(options.out, provenance);
  tell(options.common, fmt::format("wrote {}", options.out));
  emit_results(
      rows_of(result,
              {{"image", options.image}, {"operator", choice.info->id}, {"variant", choice.variant.id}}),
      provenance, options.common);
}

std::string range_text(const Setting& setting) {
  if (!setting.choices.empty()) return fmt::format("{}", fmt::join(setting.choices, "|"));
  return fmt::format("{} to {}", setting.minimum, setting.maximum);
}

SettingValue default_of(const Setting& setting) {
  return {setting.default_value, !setting.automatic.empty()};
}

void add_list_rows(ResultTable& table, const OperatorInfo& info) {
  for (const OperatorVariant& v : info.variants)
    table.add({"needs_disparity",
               v.needs_disparity ? 1.0 : 0.0,
               "1",
               {{"operator", info.id},
                {"variant", v.id},
                {"scope", scope_name(v.scope)},
                {"help", v.description}}});
  for (const Setting& s : info.settings)
    table.add({"setting",
               s.default_value,
               s.unit.empty() ? "1" : s.unit,
               {{"operator", info.id},
                {"setting", s.name},
                {"default", to_text(s, default_of(s))},
                {"range", range_text(s)},
                {"automatic", s.automatic},
                {"help", s.help}}});
}

std::string list_text(const OperatorInfo& info) {
  std::string text = fmt::format("{:<11} {}: {}\n{:<11} {}; input in {} units\n", info.id, info.title,
                                 info.description, "", info.source, info.input_unit);
  for (const OperatorVariant& v : info.variants)
    text += fmt::format("{:<11} --variant {:<23} {} (fitted to each {}{})\n", "", v.id, v.description,
                        scope_name(v.scope), v.needs_disparity ? ", needs disparity" : "");
  for (const Setting& s : info.settings)
    text += fmt::format("{:<11} --set {:<27} {}{} [{}]{}\n", "",
                        fmt::format("{}={}", s.name, to_text(s, default_of(s))), s.help,
                        s.unit.empty() ? "" : " (" + s.unit + ")", range_text(s),
                        s.automatic.empty() ? "" : fmt::format("; auto: {}", s.automatic));
  return text + "\n";
}

void run_list(const Invocation& invocation, const TonemapOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  ResultTable table;
  std::string text;
  for (const OperatorInfo& info : tone_mapping_operators()) {
    if (!options.chosen.name.empty() && info.id != options.chosen.name) continue;
    add_list_rows(table, info);
    text += list_text(info);
  }
  if (!output_is_for_programs(options.common)) fmt::print("{}", text);
  write_results(table, provenance, options.common);
}

void run_tonemap(const Invocation& invocation, const TonemapOptions& options) {
  if (options.list) return run_list(invocation, options);
  if (options.image.empty())
    throw UsageError("give the image to map, or --list to see the operators (see 'plenolab tonemap --help')");
  if (options.out.empty())
    throw UsageError("--out is required: the image to write (see 'plenolab tonemap --help')");
  run_map(invocation, options);
}

}  // namespace

void add_tonemap_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<TonemapOptions>();
  app.add_option("image", options->image, "Image with radiance: .exr .hdr .pfm, or a view of a light field");
  app.add_option("-o,--out", options->out, "Image to write: .png, or .exr for display values as they are")
      ->check(file_ending_in({".png", ".exr"}));
  add_operator_options(app, options->chosen);
  app.add_flag("--list", options->list,
               "List operators, their variants, and settings with defaults and ranges");
  app.add_option("--layers", options->layers,
                 "Also write the layers of the bilateral operator to this folder")
      ->check(not_empty());
  app.add_option("--disparity", options->disparity,
                 "Channel of the .exr that holds disparity (default: disparity, if there)")
      ->check(not_empty());
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Operators that need cd/m2 take the unit from the .exr (whiteLuminance) or the light field around it;\n"
      "where neither says it, from the image's log average, unless --set unit= or exposure= gives it.\n"
      "Examples: plenolab tonemap novel.exr -o novel.png --operator reinhard05 --set b=-1\n"
      "          plenolab tonemap photograph.hdr -o photograph.png --operator bilateral --set contrast=50\n"
      "          plenolab tonemap --list");
  app.callback([options, &invocation] { run_tonemap(invocation, *options); });
}

}  // namespace plenolab
