#include "experiments/lut/lut.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/bytes.h"
#include "core/lut/cube_file.h"
#include "core/lut/strip_file.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/result_folder.h"

namespace plenolab {

void add_interpolation_option(CLI::App& app, std::string& interpolation) {
  app.add_option("--interpolation", interpolation,
                 "Between nodes: tetrahedral (greys stay grey) or trilinear")
      ->capture_default_str()
      ->check(one_of({"tetrahedral", "trilinear"}));
}

LutInterpolation interpolation_of(const std::string& word) {
  return word == "trilinear" ? LutInterpolation::kTrilinear : LutInterpolation::kTetrahedral;
}

Lut read_lut_input(const std::string& path, Provenance& provenance) {
  if (path == "identity") return identity_lut(kDefaultLutSize);
  Lut lut = read_lut(path);
  add_input(provenance, path);
  return lut;
}

void add_lut_output(CLI::App& app, std::string& out) {
  app.add_option("-o,--out", out, "Table to write: .cube, or .png for a strip of 16 bits")
      ->required()
      ->check(file_ending_in({".cube", ".png"}));
}

void require_lut_output(const std::string& out, const Lut& lut, const Provenance& provenance) {
  require_keeps_inputs(provenance, out);
  if (lower_extension(out) == ".png")
    strip_of_lut(lut);
  else
    lut.validate();
}

void write_lut_output(const std::string& out, const Lut& lut, Provenance& provenance,
                      const CommonOptions& common) {
  require_keeps_inputs(provenance, out);
  write_lut(out, lut);
  write_run_json_beside(out, provenance);
  tell(common, fmt::format("wrote {}", out));
}

void add_lut_rows(ResultTable& table, const Lut& lut, const std::string& name) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  double sum = 0, largest = 0;
  for (int b = 0; b < lut.size; ++b)
    for (int g = 0; g < lut.size; ++g)
      for (int r = 0; r < lut.size; ++r) {
        const Rgb out = lut.node(r, g, b), change = out - lut.input_of(r, g, b);
        low = std::min({low, out.r, out.g, out.b});
        high = std::max({high, out.r, out.g, out.b});
        for (const float channel : {change.r, change.g, change.b}) {
          sum += std::abs(channel);
          largest = std::max<double>(largest, std::abs(channel));
        }
      }
  const decltype(ResultRow::columns) columns{{"lut", name}};
  table.add({"lut_size", static_cast<double>(lut.size), "nodes", columns});
  table.add({"lut_minimum", low, "encoded", columns});
  table.add({"lut_maximum", high, "encoded", columns});
  table.add({"lut_mean_change", sum / (3.0 * static_cast<double>(lut.nodes.size())), "encoded", columns});
  table.add({"lut_largest_change", largest, "encoded", columns});
}

void add_curve_rows(ResultTable& table, const Lut& lut, const std::string& path) {
  if (lower_extension(path) != ".cube") return;
  const CubeContent content = read_cube_content(path);
  if (!content.curves) return;
  const LutCurves& curves = *content.curves;
  const Rgb range = curves.domain_max - curves.domain_min;
  const std::size_t steps = 2 * (curves.nodes.size() - 1);
  float largest = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const Rgb c = curves.domain_min + range * (static_cast<float>(i) / static_cast<float>(steps));
    const Rgb error = sample_lut(lut, c, LutInterpolation::kTetrahedral) -
                      sample_content(content, c, LutInterpolation::kTetrahedral);
    largest = std::max({largest, std::abs(error.r), std::abs(error.g), std::abs(error.b)});
  }
  const decltype(ResultRow::columns) columns{{"lut", path}};
  table.add({"lut_curve_nodes", static_cast<double>(curves.nodes.size()), "nodes", columns});
  table.add({"lut_largest_curve_error", largest, "encoded", columns});
}

}  // namespace plenolab
