#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "analysis/statistics.h"
#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/image/repair.h"
#include "core/lightfield/profile.h"
#include "core/lightfield/self_check.h"
#include "experiments/cli/image_description.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/score.h"

namespace plenolab {

namespace {

struct InfoOptions {
  CommonOptions common;
  std::string path;
  int memory_mib = 2048;
};

void add_grid_rows(ResultTable& table, const ViewGrid& grid, const Columns& columns) {
  table.add({"columns", static_cast<double>(grid.columns), "views", columns});
  table.add({"rows", static_cast<double>(grid.rows), "views", columns});
  table.add({"width", static_cast<double>(grid.width), "px", columns});
  table.add({"height", static_cast<double>(grid.height), "px", columns});
  table.add({"spacing_x", grid.spacing_x_m, "m", columns});
  table.add({"spacing_y", grid.spacing_y_m, "m", columns});
  table.add({"fov_h", grid.fov_h_deg, "deg", columns});
}

void add_repair_rows(ResultTable& table, const PixelRepairs& defects, const Columns& columns) {
  table.add({"nan_values", static_cast<double>(defects.nan), "values", columns});
  table.add({"infinite_values", static_cast<double>(defects.positive_infinity), "values", columns});
  table.add({"negative_values", static_cast<double>(defects.negative), "values", columns});
}

void add_profile_rows(ResultTable& table, const LightFieldProfile& profile, const Columns& columns) {
  const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
  table.add({"min_disparity", profile.min_disparity_px, "px", columns});
  table.add({"max_disparity", profile.max_disparity_px, "px", columns});
  table.add({"constant_disparity", flag(profile.constant_disparity), "1", columns});
  table.add({"depth_edge_share", profile.depth_edge_share, "1", columns});
  table.add({"luminance_p1_log10", profile.log10_p1, "log10", columns});
  table.add({"luminance_p99_log10", profile.log10_p99, "log10", columns});
  table.add({"dynamic_range_log10", profile.dynamic_range_log10, "log10", columns});
  table.add({"grey", flag(profile.grey), "1", columns});
  table.add({"constant_colour", flag(profile.constant_colour), "1", columns});
  table.add({"lighting_change", profile.lighting_change, "1", columns});
  add_repair_rows(table, profile.defects, columns);
}

void add_self_check_rows(ResultTable& table, const SelfCheckResult& check, const Columns& columns) {
  for (const HypothesisError& e : check.errors) {
    Columns with_hypothesis = columns;
    with_hypothesis.emplace_back("hypothesis", std::string(describe(e.hypothesis)));
    table.add({"self_check_error", e.error, "1", with_hypothesis});
  }
  table.add({"self_check_best_scale", check.best_scale, "1", columns});
  table.add({"self_check_best_scale_x", check.best_scale_x, "1", columns});
  table.add({"self_check_best_scale_y", check.best_scale_y, "1", columns});
}

ResultTable light_field_info(const AnyLightField& any, const InfoOptions& options, SelfCheckResult& check) {
  ResultTable table;
  const Columns columns{{"path", options.path}};
  add_grid_rows(table, grid_of(any), columns);
  std::visit(
      [&](const auto& field) {
        {
          ProgressBar bar("profile");
          add_profile_rows(table, profile(field, bar.callback()), columns);
        }
        ProgressBar bar("self-check");
        check = self_check(field, {.threads = options.common.threads}, bar.callback());
      },
      any);
  add_self_check_rows(table, check, columns);
  return table;
}

void add_luminance_rows(ResultTable& table, const AnyImage& any, const Columns& columns) {
  std::visit(
      [&](const auto& image) {
        std::vector<double> luminances;
        for (const Rgb& c : image.pixels())
          if (const float y = luminance(c); std::isfinite(y)) luminances.push_back(y);
        if (luminances.empty()) return;
        for (const auto& [name, p] : {std::pair{"luminance_min", 0.0},
                                      {"luminance_p1", 0.01},
                                      {"luminance_p50", 0.5},
                                      {"luminance_p99", 0.99},
                                      {"luminance_max", 1.0}})
          table.add({name, quantile(luminances, p), "1", columns});
      },
      any);
  if (const auto* scene = std::get_if<SceneImage>(&any))
    add_repair_rows(table, count_defects(*scene), columns);
}

void add_channel_rows(ResultTable& table, const ChannelDescription& channel, Columns columns) {
  if (!channel.part.empty()) columns.emplace_back("part", channel.part);
  columns.emplace_back("channel", channel.name);
  columns.emplace_back("type", channel.type);
  if (!channel.measured) {
    table.add({"channel_unread", 1, "1", columns});
    return;
  }
  table.add({"channel_min", channel.least, "1", columns});
  table.add({"channel_max", channel.most, "1", columns});
  table.add({"channel_not_finite", static_cast<double>(channel.not_finite), "values", columns});
}

ResultTable image_info(const ImageDescription& image, const std::string& path) {
  ResultTable table;
  const Columns columns{{"path", path}};
  table.add({"width", static_cast<double>(image.width), "px", columns});
  table.add({"height", static_cast<double>(image.height), "px", columns});
  table.add({"channels", static_cast<double>(image.channels.size()), "channels", columns});
  for (const ChannelDescription& channel : image.channels) add_channel_rows(table, channel, columns);
  if (image.has_colour) add_luminance_rows(table, read_any_image(path), columns);
  return table;
}

/// Metadata are texts: rows of their own for programs, lines for people.
void report_image(const InfoOptions& options, Provenance& provenance) {
  const ImageDescription image = describe_image(options.path);
  add_input(provenance, options.path);
  ResultTable table = image_info(image, options.path);
  if (!output_is_for_programs(options.common)) fmt::print("{}", to_text(table));
  for (const auto& [name, text] : image.metadata) {
    table.add({"metadata", 1, "1", {{"path", options.path}, {"name", name}, {"text", text}}});
    tell(options.common, fmt::format("{}: {}", name, text));
  }
  write_results(table, provenance, options.common);
}

void run_info(const Invocation& invocation, const InfoOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  if (!std::filesystem::is_directory(options.path)) {
    report_image(options, provenance);
    return;
  }
  const AnyLightField field = open_any_light_field(options.path, options.memory_mib);
  SelfCheckResult check;
  const ResultTable table = light_field_info(field, options, check);
  emit_results(table, provenance, options.common);
  tell(options.common, fmt::format("self-check: {}", check.explanation));
  require_consistent(check, options.path);
}

}  // namespace

void add_info_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<InfoOptions>();
  app.add_option("path", options->path, "Folder of a light field, or an image")->required();
  add_memory_option(app, options->memory_mib);
  add_common_options(app, options->common);
  app.footer(
      "A light field whose disparity does not fit its views (wrong sign, axis or scale) ends with exit "
      "status 1.\n"
      "Example: plenolab info results/cellar");
  app.callback([options, &invocation] { run_info(invocation, *options); });
}

}  // namespace plenolab
