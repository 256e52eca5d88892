#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/result_folder.h"
#include "experiments/cli/synthesis_options.h"
#include "experiments/cli/wide_table.h"
#include "experiments/evaluate.h"
#include "experiments/score.h"
#include "metrics/error_map.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

struct EvaluateCommandOptions {
  CommonOptions common;
  EvaluateOptions evaluate;
  std::string folder, out;
  std::string strides = "2";
  int memory_mib = 2048;
  bool force = false;
};

DisplayImage displayable(const SceneImage& image, float exposure) {
  return expose(image, exposure);
}
DisplayImage displayable(const DisplayImage& image, float) {
  return image;
}

template <class Referral>
void write_pictures(const fs::path& folder, const EvaluatedView<Referral>& view) {
  const std::string stem = fmt::format("view_r{:02}_c{:02}", view.row, view.column);
  const DisplayImage captured = displayable(view.captured, view.exposure);
  const DisplayImage synthesised = displayable(view.synthesised.image, view.exposure);
  write_display_image(folder / (stem + "_captured.png"), captured);
  write_display_image(folder / (stem + "_synthesised.png"), synthesised);
  write_display_image(folder / (stem + "_error.png"), error_map(synthesised, captured, {}));
  write_display_image(folder / (stem + "_visibility.png"), visibility_map(view.synthesised));
}

std::vector<int> parse_strides(const std::string& text) {
  std::vector<int> strides;
  for (const std::string& part : split_list(text)) {
    int stride = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), stride);
    if (error != std::errc{} || end != part.data() + part.size() || stride < 2)
      throw UsageError(
          fmt::format("--key-stride: give whole numbers of 2 or more, e.g. 2,4, not '{}'", text));
    strides.push_back(stride);
  }
  if (strides.empty()) throw UsageError("--key-stride: give at least one, e.g. 2");
  return strides;
}

/// Throws if a stride leaves no view between key views. A grid too small for any stride is bad input instead,
/// which evaluate() reports.
void require_strides_fit(const std::vector<int>& strides, const ViewGrid& grid) {
  const int largest = std::max(grid.columns, grid.rows) - 1;
  for (const int stride : strides)
    if (largest >= 2 && stride > largest)
      throw UsageError(fmt::format("--key-stride: {} is more than the {}×{} grid allows, which is {}", stride,
                                   grid.columns, grid.rows, largest));
}

template <class Referral>
ResultTable evaluate_stride(const BasicLightField<Referral>& field, const EvaluateCommandOptions& options,
                            int stride, const fs::path& pictures) {
  EvaluateOptions evaluate_options = options.evaluate;
  evaluate_options.key_stride = stride;
  evaluate_options.synthesis.threads = options.common.threads;
  ProgressBar bar(fmt::format("key stride {}", stride));
  return evaluate<Referral>(field, evaluate_options, bar.callback(),
                            [&](const EvaluatedView<Referral>& view) {
                              if (!pictures.empty())
                                write_pictures(pictures / fmt::format("stride_{}", stride), view);
                            });
}

void print_for_people(const ResultTable& table) {
  fmt::print("{}", to_wide_text(table, {"key_stride", "view"},
                                {{"psnr_gamma_db", "PSNR gamma [dB]"},
                                 {"psnr_linear_db", "PSNR linear [dB]"},
                                 {"psnr_pq_db", "PSNR PQ [dB]"},
                                 {"ssim_gamma", "SSIM"},
                                 {"share_above_threshold", "visible difference"},
                                 {"restored_pixels", "restored [px]"},
                                 {"unseen_pixels", "unseen [px]"},
                                 {"restored_share", "restored"},
                                 {"unseen_share", "unseen"},
                                 {"views_scored", "views"},
                                 {"key_views", "key views"}}));
}

/// All strides; pictures go below `pictures` unless it is empty.
ResultTable evaluate_strides(const AnyLightField& any, const EvaluateCommandOptions& options,
                             const std::vector<int>& strides, const fs::path& pictures) {
  ResultTable table;
  for (const int stride : strides)
    std::visit([&](const auto& field) { table.append(evaluate_stride(field, options, stride, pictures)); },
               any);
  return table;
}

void run_evaluate(const Invocation& invocation, const EvaluateCommandOptions& options) {
  const std::vector<int> strides = parse_strides(options.strides);
  require_fitting(options.evaluate.synthesis);
  Provenance provenance = begin_run(invocation, options.common);
  const AnyLightField any = open_any_light_field(options.folder, options.memory_mib);
  require_strides_fit(strides, grid_of(any));
  if (options.evaluate.exposure > 0 && std::holds_alternative<DisplayLightField>(any))
    throw UsageError("--exposure is for light fields with radiance; this one is display-referred");
  add_input(provenance, options.folder);
  ResultTable table;
  if (options.out.empty()) {
    table = evaluate_strides(any, options, strides, {});
  } else {
    const std::string item = item_path(options.folder);
    write_result_folder({options.out, "evaluate", item, options.force}, provenance,
                        [&](const fs::path& folder) {
                          table = evaluate_strides(any, options, strides, folder);
                          write_text_file(folder / "results.csv", to_csv(table));
                        });
  }
  if (!output_is_for_programs(options.common)) print_for_people(table);
  write_results(table, provenance, options.common);
  if (!options.out.empty())
    tell(options.common, fmt::format("wrote pictures and results.csv to {}", options.out));
}

}  // namespace

void add_evaluate_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<EvaluateCommandOptions>();
  app.add_option("folder", options->folder, "Folder of a captured or imported light field")->required();
  app.add_option("--key-stride", options->strides,
                 "Take every K-th view as key view and synthesise the others; several as K1,K2")
      ->capture_default_str();
  app.add_option("-o,--out", options->out,
                 "Also write pictures of every view (captured, synthesised, error, visibility)")
      ->check(not_empty());
  app.add_option("--exposure", options->evaluate.exposure,
                 "Scale before gamma encoding (default: from the middle view)")
      ->check(positive_number());
  app.add_option("--cd-m2-per-unit", options->evaluate.cd_m2_per_unit,
                 "Luminance of a pixel value of 1, for PQ")
      ->check(positive_number())
      ->capture_default_str();
  add_memory_option(app, options->memory_mib);
  add_synthesis_options(app, options->evaluate.synthesis);
  add_force_option(app, options->force);
  add_common_options(app, options->common);
  app.footer("Example: plenolab evaluate captured --key-stride 2,4 -o results/evaluation");
  app.callback([options, &invocation] { run_evaluate(invocation, *options); });
}

}  // namespace plenolab
