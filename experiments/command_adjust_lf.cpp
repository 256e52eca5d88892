#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "experiments/cli/adjustment_options.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/tonemap_field.h"

namespace plenolab {

namespace {

struct AdjustFieldOptions {
  CommonOptions common;
  KeyViewAdjustmentOptions adjustment;
  std::string hdr, mapped, out;
  int memory_mib = 2048;
  bool force = false;
};

DisplayLightField open_mapped(const std::string& folder, int memory_mib) {
  const AnyLightField any = open_any_light_field(folder, memory_mib);
  if (const auto* field = std::get_if<DisplayLightField>(&any)) return *field;
  throw InputError(
      fmt::format("{} holds scene radiance, but the tone mapped light field is needed here: give the folder "
                  "with radiance first, then one that 'plenolab tonemap-lf' wrote",
                  folder));
}

void run_adjust_lf(const Invocation& invocation, const AdjustFieldOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  // A third each for both light fields and the views in work.
  const int third_mib = (options.memory_mib + 2) / 3;
  const LightField hdr = open_radiance(options.hdr, third_mib);
  const DisplayLightField mapped = open_mapped(options.mapped, third_mib);
  add_input(provenance, options.hdr);
  add_input(provenance, options.mapped);
  const std::string item = fmt::format("{} {}", item_path(options.hdr), item_path(options.mapped));
  const Stopwatch watch;
  ResultTable table;
  write_result_folder({options.out, "adjust-lf", item, options.force}, provenance, [&](const auto& folder) {
    ProgressBar bar("adjusting");
    const KeyViewAdjustmentRun run{.threads = options.common.threads,
                                   .memory_bound_bytes = static_cast<std::size_t>(third_mib) << 20,
                                   .progress = bar.callback()};
    const Columns columns{{"path", options.out}};
    std::vector<double> mean_luma;
    add_adjustment_rows(
        table, write_adjusted_light_field(folder, hdr, mapped, options.adjustment, run, mean_luma), columns);
    add_luma_rows(table, mean_luma, columns);
    table.add({"seconds", watch.seconds(), "s", columns});
  });
  tell(options.common, fmt::format("wrote the light field {}", options.out));
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_adjust_lf_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<AdjustFieldOptions>();
  app.add_option("hdr", options->hdr, "Folder of the light field with radiance")->required();
  app.add_option("mapped", options->mapped, "Folder of the same light field, tone mapped by any operator")
      ->required();
  app.add_option("-o,--out", options->out, "Folder of the adjusted light field to write")
      ->required()
      ->check(not_empty());
  add_adjustment_options(app, options->adjustment);
  add_memory_option(app, options->memory_mib);
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer("Example: plenolab adjust-lf results/cellar results/cellar-mapped -o results/cellar-adjusted");
  app.callback([options, &invocation] { run_adjust_lf(invocation, *options); });
}

}  // namespace plenolab
