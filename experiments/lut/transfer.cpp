#include <fmt/format.h>

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

/// A table that loses more of the way than this is worth a word.
constexpr double kMuchLost = 0.1;

std::vector<std::string> notes_on(const ColourTransfer& transfer) {
  const double before = transfer.distance_before, unbaked = transfer.distance_unbaked,
               after = transfer.distance_after;
  std::vector<std::string> notes;
  if (unbaked > before)
    notes.emplace_back("the colours are farther apart than before: give more --samples or --iterations");
  else if (after > before)
    notes.emplace_back("by the table the colours are farther apart than before: give more nodes (--size)");
  else if (after - unbaked > kMuchLost * (before - unbaked))
    notes.emplace_back(
        fmt::format("the table of {0} × {0} × {0} nodes loses {1:.0f} % of the way: give more nodes (--size)",
                    transfer.lut.size, 100 * (after - unbaked) / (before - unbaked)));
  return notes;
}

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
  table.add({"colour_distance_unbaked", transfer.distance_unbaked, "CIELAB units", columns});
  table.add({"colour_distance_after", transfer.distance_after, "CIELAB units", columns});
  table.add({"seconds_transfer", seconds, "s", columns});
  for (const std::string& note : notes_on(transfer)) table.add({kNoteQuantity, 0, "1", {{"note", note}}});
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
