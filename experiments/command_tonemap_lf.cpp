#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "experiments/cli/adjustment_options.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/operator_options.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/tonemap_field.h"

namespace plenolab {

namespace {

struct TonemapFieldOptions {
  CommonOptions common;
  OperatorOptions chosen;
  KeyViewAdjustmentOptions adjustment;
  std::string folder, out;
  int memory_mib = 2048;
  bool force = false;
};

void run_tonemap_lf(const Invocation& invocation, const TonemapFieldOptions& options, bool adjustment_given) {
  const OperatorChoice choice = choose_operator(options.chosen);
  require_view_variant(choice);
  if (adjustment_given && !choice.adjusted)
    throw UsageError("options of key-view adjustment are for --variant adjusted or VARIANT+adjusted");
  Provenance provenance = begin_run(invocation, options.common);
  // Half for the views that are read, half for what is made of them.
  const int half_mib = (options.memory_mib + 1) / 2;
  const LightField field = open_radiance(options.folder, choice.adjusted ? half_mib : options.memory_mib);
  add_input(provenance, options.folder);
  provenance.parameters["settings"] = settings_text(choice);
  const FieldMappingOptions mapping_options{.choice = choice,
                                            .adjustment = options.adjustment,
                                            .threads = options.common.threads,
                                            .memory_bound_bytes = static_cast<std::size_t>(half_mib) << 20};
  const std::string item = fmt::format("{} --operator {} --variant {}", item_path(options.folder),
                                       choice.info->id, choice.variant_name());
  ResultTable table;
  write_result_folder({options.out, "tonemap-lf", item, options.force}, provenance, [&](const auto& folder) {
    ProgressBar bar("tone mapping");
    const FieldMapping mapping = write_mapped_light_field(folder, field, mapping_options, bar.callback());
    table =
        rows_of(mapping, field.grid(), {{"operator", choice.info->id}, {"variant", choice.variant_name()}});
  });
  tell(options.common, fmt::format("wrote the light field {}", options.out));
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_tonemap_lf_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<TonemapFieldOptions>();
  app.add_option("folder", options->folder, "Folder of a light field with radiance")->required();
  app.add_option("-o,--out", options->out, "Folder of the tone mapped light field to write")
      ->required()
      ->check(not_empty());
  add_operator_options(app, options->chosen);
  add_adjustment_options(app, options->adjustment);
  add_memory_option(app, options->memory_mib);
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "Key-view adjustment follows with --variant adjusted (after the first variant) or VARIANT+adjusted.\n"
      "Example: plenolab tonemap-lf results/cellar --operator reinhard05 --variant adjusted -o "
      "results/cellar-mapped");
  app.callback(
      [options, &app, &invocation] { run_tonemap_lf(invocation, *options, adjustment_options_given(app)); });
}

}  // namespace plenolab
