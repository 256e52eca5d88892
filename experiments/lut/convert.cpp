#include <CLI/CLI.hpp>
#include <memory>

#include "experiments/cli/checks.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct ConvertOptions {
  CommonOptions common;
  std::string table, out, interpolation = "tetrahedral", title;
  int size = 0;
};

void run_convert(const Invocation& invocation, const ConvertOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  Lut lut = read_lut_input(options.table, provenance);
  if (options.size > 0 && options.size != lut.size)
    lut = options.table == "identity"
              ? identity_lut(options.size)
              : resample_lut(lut, options.size, interpolation_of(options.interpolation));
  if (!options.title.empty()) lut.title = options.title;
  write_lut_output(options.out, lut, provenance, options.common);
  ResultTable table;
  add_lut_rows(table, lut, options.out);
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_convert(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("lut", options->table, "Table: .cube, .png strip, or 'identity'")->required();
  add_lut_output(app, options->out);
  app.add_option("--size", options->size, "Nodes along each axis (default: as they are)")
      ->check(whole_number(kSmallestLut, kLargestLut));
  add_interpolation_option(app, options->interpolation);
  app.add_option("--title", options->title, "Title in the .cube file");
  add_common_options(app, options->common);
  app.footer(
      "Example: plenolab lut convert identity --size 32 -o neutral.png, graded in any picture editor, then\n"
      "         plenolab lut convert neutral.png -o look.cube");
  app.callback([options, &invocation] { run_convert(invocation, *options); });
}

}  // namespace plenolab
