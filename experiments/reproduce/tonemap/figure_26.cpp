// Figure 26 (section 5.1.4): smallest visible difference against luminance.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tonemap/histogram_adjustment.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/curves.h"

namespace plenolab {

ReproductionResult reproduce_visibility_threshold(Laboratory& laboratory);

namespace {

constexpr double kDarkest_cd_m2 = 1e-6, kBrightest_cd_m2 = 1e5;
/// Luminances between the pieces of just_noticeable_difference_cd_m2.
const std::array kBorders_cd_m2{1.148e-4, std::pow(10.0, -1.44), std::pow(10.0, -0.0184),
                                std::pow(10.0, 1.9)};

/// A straight line in log-log: threshold = factor · luminance^exponent.
struct PowerLaw {
  double factor = 1, exponent = 1;
  double at(double luminance) const { return factor * std::pow(luminance, exponent); }
};

/// Least squares over log-spaced luminances of the brightest piece.
PowerLaw fit_bright_end() {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  const auto places = log_spaced(kBorders_cd_m2.back() * 1.001, kBrightest_cd_m2, 100);
  for (const double luminance : places) {
    const double x = std::log10(luminance), y = std::log10(just_noticeable_difference_cd_m2(luminance));
    sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
  }
  const auto n = static_cast<double>(places.size());
  const double exponent = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  return {std::pow(10.0, (sum_y - exponent * sum_x) / n), exponent};
}

/// How the threshold changes at a border of two pieces.
struct Jump {
  double at_cd_m2 = 0, below = 0, above = 0;
  double ratio() const { return above / below; }
};

std::array<Jump, kBorders_cd_m2.size()> jumps() {
  std::array<Jump, kBorders_cd_m2.size()> all;
  constexpr double kBeside = 1e-9;  // of the border, to be surely on either side of it
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double at = kBorders_cd_m2[i];
    all[i] = {at, just_noticeable_difference_cd_m2(at * (1 - kBeside)),
              just_noticeable_difference_cd_m2(at * (1 + kBeside))};
  }
  return all;
}

ReportPlot threshold_plot(const PowerLaw& weber) {
  const auto places = log_spaced(kDarkest_cd_m2, kBrightest_cd_m2, 600);
  Plot plot;
  plot.x = {.title = "Adaptation luminance", .unit = "cd/m²", .logarithmic = true};
  plot.y = {.title = "Smallest visible difference", .unit = "cd/m²", .logarithmic = true};
  plot.key = KeyPosition::kTopLeft;
  plot.series = {curve_series("threshold", places, just_noticeable_difference_cd_m2),
                 curve_series(fmt::format("Weber's law, {:.1f} %", 100 * weber.at(1)), places,
                              [&](double luminance) { return weber.at(luminance); })};
  return {plot, "Smallest visible difference over luminance, and the line through its bright end",
          "A curve that is flat in the dark, bends upwards and joins a straight line at the bright end"};
}

ReportTable jump_table(ReproductionResult& result) {
  ReportTable table{"The threshold at the borders of its pieces",
                    {"border [cd/m²]", "below [cd/m²]", "above [cd/m²]", "jump [%]"},
                    {},
                    4};
  for (const Jump& jump : jumps()) {
    const double percent = 100 * (jump.ratio() - 1);
    table.rows.push_back({jump.at_cd_m2, jump.below, jump.above, percent});
    result.rows.add({"threshold_jump", percent, "%", {{"border_cd_m2", jump.at_cd_m2}}});
  }
  return table;
}

void describe(ReproductionResult& result, const PowerLaw& weber) {
  const auto all = jumps();
  const auto largest = *std::max_element(all.begin(), all.end(), [](const Jump& a, const Jump& b) {
    return std::abs(a.ratio() - 1) < std::abs(b.ratio() - 1);
  });
  const auto times_weber = [&](double l) { return just_noticeable_difference_cd_m2(l) / weber.at(l); };
  result.ours_shows = fmt::format(
      "From {:.0f} cd/m² on the threshold is {:.2f} % of the luminance (exponent {:.3f}: Weber's law). At 1 "
      "cd/m² it is {:.1f} times, at 0.01 cd/m² {:.1f} times and at 0.0001 cd/m² {:.0f} times what that law "
      "gives. At the borders of its pieces it jumps by up to {:+.2f} % (at {:.3g} cd/m²).",
      kBorders_cd_m2.back(), 100 * weber.at(1), weber.exponent, times_weber(1), times_weber(0.01),
      times_weber(1e-4), 100 * (largest.ratio() - 1), largest.at_cd_m2);
  result.differs = times_weber(0.01) > 2
                       ? "They agree: bright scenes are seen logarithmically, dark ones are not, so that a "
                         "dark scene allows "
                         "far less slope than its contrast."
                       : "They differ: the threshold follows Weber's law in the dark as well.";
  result.differs += fmt::format(" The jumps are those of the published pieces; {}.",
                                std::abs(largest.ratio() - 1) < 0.03
                                    ? "at less than 3 % none of them shows in a ceiling"
                                    : "one of 3 % or more may show as a step of the ceiling");
}

}  // namespace

ReproductionResult reproduce_visibility_threshold(Laboratory&) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 26 (from Ward Larson et al. 1997, data of Ferwerda et al. 1996) shows the just noticeable "
      "difference over luminance: logarithmic response in bright scenes, not in dark ones.";
  const PowerLaw weber = fit_bright_end();
  result.rows.add({"weber_fraction", weber.at(1), "1", {}});
  result.rows.add({"weber_exponent", weber.exponent, "1", {}});
  describe(result, weber);
  result.add_plot("threshold", threshold_plot(weber));
  result.add_table(jump_table(result));
  return result;
}

}  // namespace plenolab
