#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/synthesis/synthesizer.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/synthesis_options.h"
#include "experiments/score.h"

namespace plenolab {

namespace {

struct SynthOptions {
  CommonOptions common;
  SynthesisOptions synthesis;
  std::string folder, at, out, visibility, provenance, inspect;
  int memory_mib = 2048;
};

constexpr std::array kStateNames{"not used", "used",     "out of frustum", "disocclusion",
                                 "occluded", "restored", "weight zero"};

void write_image(const std::string& path, const SceneImage& image, RadianceUnit unit) {
  if (is_display_file(path))
    write_display_image(path, expose(image, exposure_from(image)));
  else
    write_scene_image(path, image, unit == RadianceUnit::kCdM2 ? std::optional(1.0) : std::nullopt);
}

void write_image(const std::string& path, const DisplayImage& image, RadianceUnit) {
  if (is_display_file(path))
    write_display_image(path, image);
  else
    write_exr(path, image);
}

/// One plane of a correspondence's property in key view `index`.
template <class Property>
Plane<float> property_plane(const Plane<PixelProvenance>& provenance, std::size_t index,
                            const Property& property) {
  Plane<float> plane(provenance.width(), provenance.height());
  for (std::size_t i = 0; i < plane.size(); ++i)
    plane.pixels()[i] = static_cast<float>(property(provenance.pixels()[i][index]));
  return plane;
}

/// Writes the provenance of every pixel as an EXR: the novel view and, for the key view of column C and row
/// R, channels cCrR.x, .y, .disparity, .weight, .state and .probes.
template <class Referral>
void write_provenance(const std::string& path, const NovelView<Referral>& view) {
  std::vector<std::pair<std::string, Plane<float>>> planes;
  for (std::size_t i = 0; i < view.views.size(); ++i) {
    const std::string prefix = fmt::format("c{}r{}.", view.views[i].column, view.views[i].row);
    const auto add = [&](const char* name, auto property) {
      planes.emplace_back(prefix + name, property_plane(view.provenance, i, property));
    };
    add("x", [](const Correspondence& c) { return c.x; });
    add("y", [](const Correspondence& c) { return c.y; });
    add("disparity", [](const Correspondence& c) { return c.disparity_px; });
    add("weight", [](const Correspondence& c) { return c.weight; });
    add("state", [](const Correspondence& c) { return static_cast<int>(c.state); });
    add("probes", [](const Correspondence& c) { return c.probes; });
  }
  std::vector<ExrExtraChannel> channels;
  for (const auto& [name, plane] : planes) channels.push_back({name, &plane});
  write_exr(path, view.image, channels, {.colour_type = ExrPixelType::kFloat});
}

struct PixelIndex {
  int x = 0, y = 0;
};

PixelIndex parse_pixel(const std::string& text, const ViewGrid& grid) {
  const CameraPosition p = parse_position(text, "--inspect");
  if (!(p.s >= 0 && p.t >= 0 && p.s < grid.width && p.t < grid.height) || p.s != std::floor(p.s) ||
      p.t != std::floor(p.t))
    throw UsageError(
        fmt::format("--inspect: '{}' is not a pixel X,Y of the {}×{} view", text, grid.width, grid.height));
  return {static_cast<int>(p.s), static_cast<int>(p.t)};
}

template <class Referral>
ResultTable inspect_pixel(const NovelView<Referral>& view, PixelIndex pixel) {
  ResultTable table;
  for (std::size_t i = 0; i < view.views.size(); ++i) {
    const Correspondence& c = view.provenance.at(pixel.x, pixel.y)[i];
    const Columns columns{{"view", fmt::format("{},{}", view.views[i].column, view.views[i].row)},
                          {"state", std::string(kStateNames.at(static_cast<std::size_t>(c.state)))}};
    table.add({"correspondence_x", c.x, "px", columns});
    table.add({"correspondence_y", c.y, "px", columns});
    table.add({"disparity", c.disparity_px, "px", columns});
    table.add({"weight", c.weight, "1", columns});
    table.add({"probes", static_cast<double>(c.probes), "probes", columns});
  }
  return table;
}

template <class Referral>
ResultTable summary(const NovelView<Referral>& view) {
  ResultTable table;
  const Columns columns{{"s", view.position.s}, {"t", view.position.t}};
  const auto add = [&](const char* quantity, double value, const char* unit) {
    table.add({quantity, value, unit, columns});
  };
  add("key_views", static_cast<double>(view.views.size()), "views");
  add("max_disparity", view.d_max_px, "px");
  add("unseen_pixels", static_cast<double>(view.unseen_pixels), "px");
  add("restored_pixels", static_cast<double>(view.restored_pixels), "px");
  add("repaired_values", static_cast<double>(view.repaired_values), "values");
  add("samples_per_search", view.statistics.samples_per_search(), "samples");
  add("seconds_prepare", view.timings.prepare_s, "s");
  add("seconds_synthesis", view.timings.total_s - view.timings.prepare_s, "s");
  for (const PrunedStage& stage : view.pruned) {
    Columns with_stage = columns;
    with_stage.emplace_back("stage", stage.stage);
    with_stage.emplace_back("reason", stage.reason);
    table.add({"stage_left_out", 1, "1", with_stage});
  }
  return table;
}

template <class Referral>
void synthesize_and_write(const BasicLightField<Referral>& field, const SynthOptions& options,
                          Provenance& provenance) {
  const CameraPosition position = parse_position(options.at, "--at");
  require_on_grid(position, field.grid(), "--at");
  std::optional<PixelIndex> inspected;
  if (!options.inspect.empty()) inspected = parse_pixel(options.inspect, field.grid());
  SynthesisOptions synthesis = options.synthesis;
  synthesis.threads = options.common.threads;
  synthesis.record_provenance = !options.provenance.empty() || !options.inspect.empty();
  synthesis.count_probes = synthesis.record_provenance;
  const NovelView<Referral> view = synthesize(field, position, synthesis);
  ResultTable table = summary(view);
  if (inspected) table.append(inspect_pixel(view, *inspected));
  write_image(options.out, view.image, field.unit());
  if (!options.visibility.empty()) write_display_image(options.visibility, visibility_map(view));
  if (!options.provenance.empty()) write_provenance(options.provenance, view);
  write_run_json_beside(options.out, provenance);
  emit_results(table, provenance, options.common);
}

void run_synth(const Invocation& invocation, const SynthOptions& options) {
  require_fitting(options.synthesis);
  Provenance provenance = begin_run(invocation, options.common);
  const AnyLightField any = open_any_light_field(options.folder, options.memory_mib);
  if (std::holds_alternative<DisplayLightField>(any) && !is_display_file(options.out))
    require_extension(options.out, ".exr");
  add_input(provenance, options.folder);
  std::visit([&](const auto& field) { synthesize_and_write(field, options, provenance); }, any);
}

}  // namespace

void add_synth_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<SynthOptions>();
  app.add_option("folder", options->folder, "Folder of the light field")->required();
  app.add_option("--at", options->at, "Camera position S,T in view spacings; the top-left key view is 0,0")
      ->required();
  app.add_option("-o,--out", options->out,
                 "Image to write: .exr .hdr .pfm keep radiance, .png is exposed for display")
      ->required()
      ->check(file_ending_in({".exr", ".hdr", ".pfm", ".png"}));
  app.add_option("--visibility", options->visibility,
                 "Also write the visibility map (.png): green = seen by all key views, red = by none")
      ->check(file_ending_in({".png"}));
  app.add_option(
         "--provenance", options->provenance,
         "Also write, for each key view, where every pixel came from (.exr, channels cCrR.x .y .disparity "
         ".weight .state .probes)")
      ->check(file_ending_in({".exr"}));
  app.add_option("--inspect", options->inspect, "Print where the pixel X,Y came from");
  add_memory_option(app, options->memory_mib);
  add_synthesis_options(app, options->synthesis);
  add_common_options(app, options->common);
  app.footer("Example: plenolab synth results/cellar --at 1.5,0.5 -o novel.exr --visibility visibility.png");
  app.callback([options, &invocation] { run_synth(invocation, *options); });
}

}  // namespace plenolab
