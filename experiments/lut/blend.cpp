#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "experiments/lut/lut.h"

namespace plenolab {

namespace {

struct BlendOptions {
  CommonOptions common;
  std::vector<std::string> shares;
  std::string out, interpolation = "tetrahedral";
};

struct NamedShare {
  std::string table;
  double weight = 0;
};

NamedShare parse_share(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  NamedShare share;
  if (equals != std::string::npos && equals > 0) {
    share.table = text.substr(0, equals);
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, share.weight);
    if (error == std::errc() && stop == end && share.weight >= 0 && std::isfinite(share.weight)) return share;
  }
  throw UsageError(fmt::format("give tables and weights as LUT=WEIGHT, e.g. warm.cube=0.3, not '{}'", text));
}

/// The identity takes the domain of the others.
std::vector<Lut> read_tables(const std::vector<NamedShare>& shares, Provenance& provenance) {
  std::vector<Lut> tables;
  const Lut* domain = nullptr;
  for (const NamedShare& share : shares) tables.push_back(read_lut_input(share.table, provenance));
  for (std::size_t i = 0; i < shares.size() && !domain; ++i)
    if (shares[i].table != "identity") domain = &tables[i];
  for (std::size_t i = 0; i < shares.size() && domain; ++i)
    if (shares[i].table == "identity")
      tables[i] = identity_lut(kDefaultLutSize, domain->domain_min, domain->domain_max);
  return tables;
}

void run_blend(const Invocation& invocation, const BlendOptions& options) {
  std::vector<NamedShare> shares;
  double sum = 0;
  for (const std::string& text : options.shares) {
    shares.push_back(parse_share(text));
    sum += shares.back().weight;
  }
  if (!(sum <= 1 + 1e-6)) throw UsageError(fmt::format("the weights sum to {:g}, which is more than 1", sum));
  Provenance provenance = begin_run(invocation, options.common);
  if (sum < 1 - 1e-6) shares.push_back({"identity", 1 - sum});
  const std::vector<Lut> tables = read_tables(shares, provenance);
  std::vector<WeightedLut> weighted;
  for (std::size_t i = 0; i < shares.size(); ++i) weighted.push_back({&tables[i], shares[i].weight});
  const Lut blend = blend_luts(weighted, interpolation_of(options.interpolation));
  write_lut_output(options.out, blend, provenance, options.common);
  ResultTable table;
  for (const NamedShare& share : shares)
    table.add({"blend_weight", share.weight, "1", {{"lut", share.table}}});
  add_lut_rows(table, blend, options.out);
  emit_results(table, provenance, options.common);
}

}  // namespace

void add_lut_blend(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<BlendOptions>();
  app.add_option("shares", options->shares, "LUT=WEIGHT …; what is missing to 1 is the identity's")
      ->required();
  add_lut_output(app, options->out);
  add_interpolation_option(app, options->interpolation);
  add_common_options(app, options->common);
  app.footer("Example: plenolab lut blend warm.cube=0.3 cold.cube=0.5 -o blend.cube");
  app.callback([options, &invocation] { run_blend(invocation, *options); });
}

}  // namespace plenolab
