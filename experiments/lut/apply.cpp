#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/lut/grade.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/result_folder.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct ApplyOptions {
  CommonOptions common;
  std::string table, image, out, interpolation = "tetrahedral";
  int bits = 8;
};

void require_display_image(const std::string& path) {
  if (!is_display_file(path))
    throw InputError(
        fmt::format("{} is scene-referred, but look-up tables grade encoded pictures: tone map it first "
                    "(plenolab tonemap)",
                    path));
}

void run_apply(const Invocation& invocation, const ApplyOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  const PreparedLut lut(read_lut_input(options.table, provenance));
  require_display_image(options.image);
  const DisplayImage image = read_display_image(options.image);
  add_input(provenance, options.image);
  require_keeps_inputs(provenance, options.out);
  const Stopwatch watch;
  const GradedImage graded =
      lut.grade(image, {interpolation_of(options.interpolation), options.common.threads});
  const double seconds = watch.seconds();
  write_display_image(options.out, graded.image, options.bits == 16 ? PngDepth::k16Bit : PngDepth::k8Bit);
  write_run_json_beside(options.out, provenance);
  tell(options.common, fmt::format("wrote {}", options.out));
  ResultTable table;
  const decltype(ResultRow::columns) columns{{"image", options.image}, {"lut", options.table}};
  table.add({"values_cut", static_cast<double>(graded.cut), "channel values", columns});
  table.add({"seconds_grade", seconds, "s", columns});
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_apply(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ApplyOptions>();
  app.add_option("lut", options->table, "Table: .cube or .png strip")->required();
  app.add_option("image", options->image, "Picture to grade (.png)")->required();
  app.add_option("-o,--out", options->out, "Graded picture (.png)")
      ->required()
      ->check(file_ending_in({".png"}));
  add_interpolation_option(app, options->interpolation);
  app.add_option("--bits", options->bits, "Bits per channel of the result: 8 or 16")
      ->capture_default_str()
      ->check(one_of({"8", "16"}));
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut apply warm.cube frame.png -o graded.png");
  app.callback([options, &invocation] { run_apply(invocation, *options); });
}

}  // namespace plenolab
