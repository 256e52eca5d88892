#include <CLI/CLI.hpp>
#include <memory>

#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct InfoOptions {
  CommonOptions common;
  std::vector<std::string> tables;
};

void run_info(const Invocation& invocation, const InfoOptions& options) {
  Provenance provenance = begin_run(invocation, options.common);
  ResultTable table;
  for (const std::string& name : options.tables) {
    const Lut lut = read_lut_input(name, provenance);
    add_lut_rows(table, lut, name);
    add_curve_rows(table, lut, name);
    if (lut.domain_min == Rgb{0, 0, 0} && lut.domain_max == Rgb{1, 1, 1}) continue;
    for (const auto& [channel, member] :
         {std::pair("r", &Rgb::r), std::pair("g", &Rgb::g), std::pair("b", &Rgb::b)}) {
      const decltype(ResultRow::columns) columns{{"lut", name}, {"channel", std::string(channel)}};
      table.add({"lut_domain_low", lut.domain_min.*member, "encoded", columns});
      table.add({"lut_domain_high", lut.domain_max.*member, "encoded", columns});
    }
  }
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_info(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<InfoOptions>();
  app.add_option("lut", options->tables, "Tables: .cube files or .png strips")->required();
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut info warm.cube cold.cube");
  app.callback([options, &invocation] { run_info(invocation, *options); });
}

}  // namespace plenolab
