#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "core/io/bytes.h"
#include "core/lut/cube_file.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/checks.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct ConvertOptions {
  CommonOptions common;
  std::string table, out, interpolation = "tetrahedral", title, domain;
  int size = 0;
  bool clamp = false;
};

/// Inputs of the first and last node, the same for all channels.
struct Domain {
  float low = 0, high = 1;
};

Domain parse_domain(const std::string& text) {
  const std::vector<std::string> parts = split_list(text);
  Domain domain;
  const auto parse = [](const std::string& part, float& value) {
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && stop == part.data() + part.size() && std::isfinite(value);
  };
  if (parts.size() != 2 || !parse(parts[0], domain.low) || !parse(parts[1], domain.high) ||
      !(domain.low < domain.high))
    throw UsageError(fmt::format("--domain needs LOW,HIGH, as in 0,1, not '{}'", text));
  return domain;
}

/// Curves become a lattice of the size asked for at once, which loses less than by way of another size.
Lut read_at_size(const ConvertOptions& options, Provenance& provenance) {
  Lut lut = read_lut_input(options.table, provenance);
  if (options.size == 0 || options.size == lut.size) return lut;
  if (options.table == "identity") return identity_lut(options.size);
  if (lower_extension(options.table) == ".cube") {
    const CubeContent content = read_cube_content(options.table);
    if (content.curves) return lut_of_content(content, options.size);
  }
  return resample_lut(lut, options.size, interpolation_of(options.interpolation));
}

void run_convert(const Invocation& invocation, const ConvertOptions& options) {
  if (!options.title.empty() && lower_extension(options.out) != ".cube")
    throw UsageError("--title is for .cube files: a strip has no place for it");
  const Domain domain = options.domain.empty() ? Domain{} : parse_domain(options.domain);
  Provenance provenance = begin_run(invocation, options.common);
  Lut lut = read_at_size(options, provenance);
  ResultTable table;
  if (options.table != "identity") add_curve_rows(table, lut, options.table);
  if (!options.domain.empty())
    lut = resample_lut(lut, lut.size, {domain.low, domain.low, domain.low},
                       {domain.high, domain.high, domain.high}, interpolation_of(options.interpolation));
  if (options.clamp)
    table.add({"values_cut",
               static_cast<double>(cut_all_to_unit(lut.nodes)),
               "channel values",
               {{"lut", options.out}}});
  if (!options.title.empty()) lut.title = options.title;
  write_lut_output(options.out, lut, provenance, options.common);
  add_lut_rows(table, lut, options.out);
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_convert(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("lut", options->table, "Table: .cube, .png strip, or 'identity'")->required();
  add_lut_output(app, options->out);
  app.add_option("--size", options->size,
                 "Nodes along each axis (default: as they are; up to 65 for a table of curves)")
      ->check(whole_number(kSmallestLut, kLargestLut));
  app.add_option("--domain", options->domain,
                 "Inputs LOW,HIGH of the first and last node (default: as they are)");
  app.add_flag("--clamp", options->clamp, "Cut outputs to 0 … 1, which strips hold, and count them");
  add_interpolation_option(app, options->interpolation);
  app.add_option("--title", options->title, "Title in the .cube file");
  add_common_options(app, options->common);
  app.footer(
      "Example: plenolab lut convert identity --size 32 -o neutral.png, graded in any picture editor, then\n"
      "         plenolab lut convert neutral.png -o look.cube");
  app.callback([options, &invocation] { run_convert(invocation, *options); });
}

}  // namespace plenolab
