#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <variant>

#include "core/io/bytes.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/result_folder.h"
#include "experiments/lut/lut.h"
#include "experiments/lut/picture.h"

namespace plenolab {

namespace {

struct ApplyOptions {
  CommonOptions common;
  GradingOptions grading;
  std::string table, image, out;
};

/// Curves are applied as they are, without a lattice that cuts their corners.
using GradingTable = std::variant<PreparedLut, CubeContent>;

GradingTable read_grading_table(const std::string& path, Provenance& provenance) {
  if (path == "identity" || lower_extension(path) != ".cube")
    return PreparedLut(read_lut_input(path, provenance));
  CubeContent content = read_cube_content(path);
  add_input(provenance, path);
  if (content.curves) return content;
  return PreparedLut(*content.lattice);
}

void run_apply(const Invocation& invocation, const ApplyOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  const GradingTable table = read_grading_table(options.table, provenance);
  const PictureFile picture = read_picture(options.image, provenance);
  require_keeps_inputs(provenance, options.out);
  const GradedPicture graded = std::visit(
      [&](const auto& by) { return grade_picture(picture, by, options.grading, options.common.threads); },
      table);
  write_display_image(options.out, graded.graded.image, graded.depth);
  write_run_json_beside(options.out, provenance);
  tell(options.common, fmt::format("wrote {}", options.out));
  ResultTable rows;
  add_grading_rows(rows, picture, graded, {{"image", options.image}, {"lut", options.table}});
  emit_results(rows, provenance, options.common);
}

}  // namespace

void add_lut_apply(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ApplyOptions>();
  app.add_option("lut", options->table, "Table: .cube or .png strip")->required();
  app.add_option("image", options->image, "Picture to grade (.png)")->required();
  app.add_option("-o,--out", options->out, "Graded picture (.png)")
      ->required()
      ->check(file_ending_in({".png"}));
  add_grading_options(app, options->grading);
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut apply warm.cube frame.png -o graded.png");
  app.callback([options, &invocation] { run_apply(invocation, *options); });
}

}  // namespace plenolab
