#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/timing.h"
#include "core/io/image_file.h"
#include "core/lut/colour_transfer.h"
#include "experiments/cli/checks.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct TransferOptions {
  CommonOptions common;
  ColourTransferOptions transfer;
  std::string source, target, out;
};

void run_transfer(const Invocation& invocation, TransferOptions options) {
  Provenance provenance = begin_run(invocation, options.common);
  const DisplayImage source = read_display_image(options.source), target = read_display_image(options.target);
  add_input(provenance, options.source);
  add_input(provenance, options.target);
  options.transfer.seed = options.common.seed;
  const Stopwatch watch;
  const ColourTransfer transfer = transfer_colours(source, target, options.transfer);
  const double seconds = watch.seconds();
  write_lut_output(options.out, transfer.lut, provenance, options.common);
  ResultTable table;
  const decltype(ResultRow::columns) columns{{"source", options.source}, {"target", options.target}};
  table.add({"colour_distance_before", transfer.distance_before, "CIELAB units", columns});
  table.add({"colour_distance_after", transfer.distance_after, "CIELAB units", columns});
  table.add({"seconds_transfer", seconds, "s", columns});
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_transfer(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<TransferOptions>();
  ColourTransferOptions& transfer = options->transfer;
  app.add_option("source", options->source, "Picture whose colours are to change (.png)")->required();
  app.add_option("target", options->target, "Picture whose colours it is to take (.png)")->required();
  add_lut_output(app, options->out);
  app.add_option("--amount", transfer.amount, "0 changes nothing, 1 transfers fully")
      ->capture_default_str()
      ->check(number_between(0, 1));
  app.add_option("--iterations", transfer.iterations, "Random rotations")
      ->capture_default_str()
      ->check(whole_number(1, 1000));
  app.add_option("--size", transfer.size, "Nodes along each axis of the table")
      ->capture_default_str()
      ->check(whole_number(kSmallestLut, kLargestLut));
  app.add_option("--samples", transfer.samples, "Pixels taken of each picture")
      ->capture_default_str()
      ->check(whole_number(2, 100000000));
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut transfer frame.png painting.png -o look.cube");
  app.callback([options, &invocation] { run_transfer(invocation, *options); });
}

}  // namespace plenolab
