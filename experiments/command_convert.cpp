#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/lightfield/bare_folder.h"
#include "core/lightfield/hci.h"
#include "core/lightfield/light_field_folder.h"
#include "core/lightfield/self_check.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"

namespace plenolab {

namespace {

struct ConvertOptions {
  CommonOptions common;
  std::string source, out;
  std::string to = "plenolab";
  std::string radiance = "relative";
  BareFolderOptions bare;
  double exposure = 0;
  bool linear = false, unchecked = false, force = false;
  std::vector<const CLI::Option*> for_bare_folders;  ///< options that mean nothing for other sources
  const CLI::Option *spacing_x = nullptr, *spacing_y = nullptr, *fov_h = nullptr;
};

bool is_bare_folder(const std::filesystem::path& source) {
  return std::filesystem::is_directory(source) && !is_light_field_folder(source) && !is_hci_folder(source);
}

/// A bare folder does not say where its cameras stand: that must be given, and for other sources it must not.
void require_fitting_options(ConvertOptions& options) {
  if (is_bare_folder(options.source)) {
    if (options.spacing_x->count() == 0 || options.fov_h->count() == 0)
      throw UsageError("a bare folder of EXRs needs --spacing-x and --fov-h: its files do not say them");
    if (options.spacing_y->count() == 0) options.bare.spacing_y_m = options.bare.spacing_x_m;
  } else {
    for (const CLI::Option* option : options.for_bare_folders)
      if (option->count() > 0)
        throw UsageError(fmt::format("{} is for bare folders of EXRs; {} says it itself", option->get_name(),
                                     options.source));
  }
  if (options.linear && !is_hci_folder(options.source))
    throw UsageError("--linear is for HCI folders: only their views are display-referred");
  if (options.exposure > 0 && options.to != "hci") throw UsageError("--exposure is for --to hci");
}

AnyLightField open_source(const ConvertOptions& options) {
  const std::filesystem::path source = options.source;
  if (is_bare_folder(source)) return import_bare_folder(source, options.bare);
  if (options.linear) return import_hci_linear(source);
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

void write_hci(const AnyLightField& any, const ConvertOptions& options, const std::filesystem::path& folder) {
  ProgressBar bar("writing");
  if (const auto* scene = std::get_if<LightField>(&any))
    export_hci(folder, exposed(*scene, options.exposure), {}, bar.callback());
  else
    export_hci(folder, std::get<DisplayLightField>(any), {}, bar.callback());
}

void write_field(const AnyLightField& any, const std::filesystem::path& folder) {
  ProgressBar bar("writing");
  std::visit(
      [&](const auto& field) {
        write_light_field(folder, field, {.colour_type = ExrPixelType::kFloat}, bar.callback());
      },
      any);
}

/// Says what was written: HCI views are cropped to the area common to all, so their size is read back.
void report(const ConvertOptions& options, const ViewGrid& grid, Provenance& provenance) {
  int width = grid.width, height = grid.height;
  if (options.to == "hci") {
    const auto file = std::filesystem::path(options.out) / "parameters.cfg";
    const HciParameters written = parse_hci_parameters(read_text_file(file), file.string());
    width = written.width;
    height = written.height;
  }
  ResultTable table;
  const std::vector<std::pair<std::string, Cell>> columns{{"path", options.out}};
  table.add({"columns", static_cast<double>(grid.columns), "views", columns});
  table.add({"rows", static_cast<double>(grid.rows), "views", columns});
  table.add({"width", static_cast<double>(width), "px", columns});
  table.add({"height", static_cast<double>(height), "px", columns});
  tell(options.common, fmt::format("wrote {}", options.out));
  if (width != grid.width || height != grid.height)
    tell(options.common,
         fmt::format("views were cropped from {}×{} to the area common to all", grid.width, grid.height));
  emit_results(table, provenance, options.common);
}

void run_convert(const Invocation& invocation, ConvertOptions& options) {
  require_fitting_options(options);
  options.bare.unit = options.radiance == "cd/m2" ? RadianceUnit::kCdM2 : RadianceUnit::kRelative;
  Provenance provenance = begin_run(invocation, options.common);
  const AnyLightField field = open_source(options);
  const std::string item = fmt::format("{} --to {}", item_path(options.source), options.to);
  write_result_folder({options.out, "convert", item, options.force}, provenance, [&](const auto& folder) {
    check_disparity(field, options);
    if (options.to == "hci")
      write_hci(field, options, folder);
    else
      write_field(field, folder);
  });
  report(options, grid_of(field), provenance);
}

}  // namespace

void add_convert_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("source", options->source,
                 "HCI folder, light field folder, or a bare folder of EXRs with depth")
      ->required();
  app.add_option("-o,--out", options->out, "Folder to write")->required()->check(not_empty());
  app.add_option("--to", options->to, "Layout to write")
      ->check(one_of({"plenolab", "hci"}))
      ->capture_default_str();
  app.add_flag("--linear", options->linear, "HCI source: decode to relative radiance by gamma 2.2");
  app.add_option("--exposure", options->exposure, "HCI target: scale of radiance before gamma encoding")
      ->check(positive_number());
  options->spacing_x =
      app.add_option("--spacing-x", options->bare.spacing_x_m, "Bare folder: metres between columns")
          ->check(positive_number());
  options->spacing_y = app.add_option("--spacing-y", options->bare.spacing_y_m,
                                      "Bare folder: metres between rows (default: as between columns)")
                           ->check(positive_number());
  options->fov_h = app.add_option("--fov-h", options->bare.fov_h_deg,
                                  "Bare folder: full horizontal opening angle in degrees")
                       ->check(number_between(0.01, 179.99));
  app.add_option("--pattern", options->bare.pattern, "Bare folder: view names with {column} and {row}");
  app.add_option("--columns", options->bare.columns,
                 "Bare folder: columns, for names with one running number")
      ->check(whole_number(1, 1000));
  app.add_flag("--column-first", options->bare.column_first, "Bare folder: the first number is the column");
  app.add_option("--red", options->bare.r, "Bare folder: name of the red channel");
  app.add_option("--green", options->bare.g, "Bare folder: name of the green channel");
  app.add_option("--blue", options->bare.b, "Bare folder: name of the blue channel");
  app.add_option("--depth", options->bare.depth, "Bare folder: name of the planar depth channel (metres)");
  app.add_option("--radiance", options->radiance, "Bare folder: unit of the radiance")
      ->check(one_of({"relative", "cd/m2"}))
      ->capture_default_str();
  for (const char* name : {"--spacing-x", "--spacing-y", "--fov-h", "--pattern", "--columns",
                           "--column-first", "--red", "--green", "--blue", "--depth", "--radiance"})
    options->for_bare_folders.push_back(app.get_option(name));
  app.add_flag("--unchecked", options->unchecked, "Skip the photometric self-check");
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer(
      "HCI views are offset from parallel ones: on import and export they are moved, and cropped to the area "
      "common to "
      "all.\n"
      "Examples: plenolab convert hci/antinous -o antinous\n"
      "          plenolab convert renders --spacing-x 0.12 --spacing-y 0.12 --fov-h 50 -o field");
  app.callback([options, &invocation] { run_convert(invocation, *options); });
}

}  // namespace plenolab
