#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/lightfield/bare_folder.h"
#include "core/lightfield/hci.h"
#include "core/lightfield/light_field_folder.h"
#include "core/lightfield/self_check.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"

namespace plenolab {

namespace {

struct ConvertOptions {
  CommonOptions common;
  std::string source, out;
  std::string to = "plenolab";
  std::string radiance = "relative";
  BareFolderOptions bare;
  double exposure = 0;
  bool linear = false, unchecked = false;
};

AnyLightField open_source(const ConvertOptions& options) {
  const std::filesystem::path source = options.source;
  if (std::filesystem::is_directory(source) && !is_light_field_folder(source)) {
    if (!is_hci_folder(source)) return import_bare_folder(source, options.bare);
    if (options.linear) return import_hci_linear(source);
  }
  return open_any_light_field(source);
}

/// The light field at one exposure, as the 8-bit views of the HCI layout need it.
DisplayLightField exposed(const LightField& field, double exposure) {
  const ViewGrid grid = field.grid();
  if (!(exposure > 0)) exposure = exposure_from(field.view(grid.columns / 2, grid.rows / 2)->colour);
  return DisplayLightField(grid, field.unit(), field.name(), [field, exposure](int column, int row) {
    const auto view = field.view(column, row);
    return KeyView<DisplayReferred>{expose(view->colour, static_cast<float>(exposure)), view->disparity};
  });
}

void check_disparity(const AnyLightField& any, const ConvertOptions& options) {
  if (options.unchecked) return;
  std::visit(
      [&](const auto& field) {
        ProgressBar bar("self-check");
        const SelfCheckResult check = self_check(field, {.threads = options.common.threads}, bar.callback());
        require_consistent(check, options.source);
      },
      any);
}

void write_hci(const AnyLightField& any, const ConvertOptions& options) {
  ProgressBar bar("writing");
  if (const auto* scene = std::get_if<LightField>(&any))
    export_hci(options.out, exposed(*scene, options.exposure), {}, bar.callback());
  else
    export_hci(options.out, std::get<DisplayLightField>(any), {}, bar.callback());
}

void run_convert(const Invocation& invocation, ConvertOptions& options) {
  options.bare.unit = options.radiance == "cd/m2" ? RadianceUnit::kCdM2 : RadianceUnit::kRelative;
  Provenance provenance = begin_run(invocation, options.common);
  const AnyLightField field = open_source(options);
  check_disparity(field, options);
  if (options.to == "hci") {
    write_hci(field, options);
  } else {
    ProgressBar bar("writing");
    std::visit(
        [&](const auto& f) {
          write_light_field(options.out, f, {.colour_type = ExrPixelType::kFloat}, bar.callback());
        },
        field);
  }
  finish_provenance(provenance);
  write_run_json(provenance, options.out);
  const ViewGrid& grid = grid_of(field);
  tell(options.common, fmt::format("wrote {} ({}×{} views of {}×{} pixels)", options.out, grid.columns,
                                   grid.rows, grid.width, grid.height));
}

}  // namespace

void add_convert_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("source", options->source,
                 "HCI folder, light field folder, or a bare folder of EXRs with depth")
      ->required();
  app.add_option("-o,--out", options->out, "Folder to write; must not exist or be empty")->required();
  app.add_option("--to", options->to, "Layout to write")
      ->check(CLI::IsMember({"plenolab", "hci"}))
      ->capture_default_str();
  app.add_flag("--linear", options->linear, "HCI source: decode to relative radiance by gamma 2.2");
  app.add_option("--exposure", options->exposure, "HCI target: scale of radiance before gamma encoding")
      ->check(CLI::PositiveNumber);
  app.add_option("--spacing-x", options->bare.spacing_x_m, "Bare folder: metres between columns");
  app.add_option("--spacing-y", options->bare.spacing_y_m, "Bare folder: metres between rows");
  app.add_option("--fov-h", options->bare.fov_h_deg, "Bare folder: full horizontal opening angle in degrees");
  app.add_option("--pattern", options->bare.pattern, "Bare folder: view names with {column} and {row}");
  app.add_option("--columns", options->bare.columns,
                 "Bare folder: columns, for names with one running number");
  app.add_flag("--column-first", options->bare.column_first, "Bare folder: the first number is the column");
  app.add_option("--red", options->bare.r, "Bare folder: name of the red channel");
  app.add_option("--green", options->bare.g, "Bare folder: name of the green channel");
  app.add_option("--blue", options->bare.b, "Bare folder: name of the blue channel");
  app.add_option("--depth", options->bare.depth, "Bare folder: name of the planar depth channel (metres)");
  app.add_option("--radiance", options->radiance, "Bare folder: unit of the radiance")
      ->check(CLI::IsMember({"relative", "cd/m2"}))
      ->capture_default_str();
  app.add_flag("--unchecked", options->unchecked, "Skip the photometric self-check");
  add_common_options(app, options->common);
  app.footer(
      "Examples: plenolab convert hci/antinous -o antinous\n"
      "          plenolab convert renders --spacing-x 0.12 --spacing-y 0.12 --fov-h 50 -o field");
  app.callback([options, &invocation] { run_convert(invocation, *options); });
}

}  // namespace plenolab
