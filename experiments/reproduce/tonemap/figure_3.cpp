// Figure 3 (section 2.1.2): response curves of Reinhard & Devlin for several contrast parameters.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/tonemap/photoreceptor.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/curves.h"
#include "experiments/score.h"

namespace plenolab {

ReproductionResult reproduce_response_curves(Laboratory& laboratory);

namespace {

/// Over the automatic range of m, 0.3 to 1.
constexpr std::array kContrasts{0.3, 0.45, 0.6, 0.75, 0.9, 1.0};
/// Level that a global receptor is adapted to: a bright interior.
constexpr double kGlobal_cd_m2 = 100;
constexpr double kDarkest_cd_m2 = 1e-4, kBrightest_cd_m2 = 1e6;

Photoreceptor receptor_of(double contrast, double light_adaptation) {
  return {.contrast = contrast,
          .light_adaptation = light_adaptation,
          .global = {kGlobal_cd_m2, kGlobal_cd_m2, kGlobal_cd_m2}};
}

struct CurveFacts {
  double contrast = 0, light_adaptation = 0;
  SteepestPlace steepest;
  double darkest = 0, brightest = 0;  ///< response at the ends of the plot
};

std::vector<double> luminances() {
  return log_spaced(kDarkest_cd_m2, kBrightest_cd_m2, 401);
}

CurveFacts facts_of(double contrast, double light_adaptation) {
  const Photoreceptor receptor = receptor_of(contrast, light_adaptation);
  const auto response = [&](double luminance) { return respond_to_grey(receptor, luminance); };
  return {contrast, light_adaptation, steepest_place(luminances(), response), response(kDarkest_cd_m2),
          response(kBrightest_cd_m2)};
}

std::vector<CurveFacts> facts_for(double light_adaptation) {
  std::vector<CurveFacts> facts;
  for (const double contrast : kContrasts) facts.push_back(facts_of(contrast, light_adaptation));
  return facts;
}

ReportPlot plot_curves(double light_adaptation) {
  Plot plot;
  plot.x = {.title = "Luminance", .unit = "cd/m²", .logarithmic = true};
  plot.y = {.title = "Response V", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  for (const double contrast : kContrasts)
    plot.series.push_back(
        curve_series(fmt::format("m = {:g}", contrast), luminances(),
                     [receptor = receptor_of(contrast, light_adaptation)](double luminance) {
                       return respond_to_grey(receptor, luminance);
                     }));
  const std::string level = light_adaptation == 1
                                ? "each pixel adapted to its own luminance (l = 1, the default)"
                                : fmt::format("all pixels adapted to {:g} cd/m² (l = 0)", kGlobal_cd_m2);
  return {plot, fmt::format("Response to grey over luminance, {}; b = 0", level),
          fmt::format("Rising curves of the response for six contrast parameters, {}", level)};
}

void add_facts(ReproductionResult& result, const std::vector<CurveFacts>& facts, ReportTable& table) {
  for (const CurveFacts& f : facts) {
    const Columns columns{{"m", f.contrast}, {"l", f.light_adaptation}};
    result.rows.add({"largest_slope", f.steepest.slope, "1/log10 unit", columns});
    result.rows.add({"steepest_luminance", f.steepest.x, "cd/m2", columns});
    result.rows.add({"darkest_response", f.darkest, "1", columns});
    result.rows.add({"brightest_response", f.brightest, "1", columns});
    // A flat curve has no steepest place.
    const Cell place = f.steepest.slope > 1e-6 ? Cell{f.steepest.x} : Cell{std::string("none")};
    table.rows.push_back({f.light_adaptation, f.contrast, f.steepest.slope, place, f.darkest, f.brightest});
  }
}

std::pair<CurveFacts, CurveFacts> flattest_and_steepest(const std::vector<CurveFacts>& facts) {
  const auto [low, high] = std::minmax_element(
      facts.begin(), facts.end(),
      [](const CurveFacts& a, const CurveFacts& b) { return a.steepest.slope < b.steepest.slope; });
  return {*low, *high};
}

void describe(ReproductionResult& result, const std::vector<CurveFacts>& own,
              const std::vector<CurveFacts>& global) {
  const auto [flat, steep] = flattest_and_steepest(own);
  const auto [global_flat, global_steep] = flattest_and_steepest(global);
  result.ours_shows = fmt::format(
      "With the thesis' default, adaptation to the pixel itself (l = 1), the largest slope falls from {:.3f} "
      "per log10 unit at m = {:g} to {:.3f} at m = {:g}. With adaptation to a common level of {:g} cd/m² (l "
      "= "
      "0) it lies between {:.3f} and {:.3f}, and the steepest place moves from {:.3g} to {:.3g} cd/m².",
      steep.steepest.slope, steep.contrast, flat.steepest.slope, flat.contrast, kGlobal_cd_m2,
      global_flat.steepest.slope, global_steep.steepest.slope, global.front().steepest.x,
      global.back().steepest.x);
  const bool shape_kept = global_steep.steepest.slope - global_flat.steepest.slope < 1e-3;
  result.differs =
      shape_kept
          ? "The thesis says that m controls the shape of the curve. That holds where a pixel adapts to "
            "itself; where all adapt to one level, m moves the curve along the axis and leaves its shape."
          : "Both ways to adapt agree with the thesis: m controls the shape of the curve.";
  if (flat.steepest.slope < 1e-6)
    result.differs += fmt::format(
        " At m = {:g}, where the automatic rule ends for an image whose log average is its minimum, the "
        "response of a pixel adapted to itself is {:.2f} whatever its luminance: all contrast is lost.",
        flat.contrast, flat.darkest);
}

}  // namespace

ReproductionResult reproduce_response_curves(Laboratory&) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 3, taken from Reinhard & Devlin 2005, shows tone mapping curves for several contrast "
      "parameters "
      "m; the text says that m and the brightness b control the shape of the curve.";
  const std::vector<CurveFacts> own = facts_for(1), global = facts_for(0);
  describe(result, own, global);
  result.add_plot("adapted-to-the-pixel", plot_curves(1));
  result.add_plot("adapted-to-one-level", plot_curves(0));
  ReportTable table{"Slope of the curves over log10 luminance and their ends in the plots",
                    {"l", "m", "largest slope", "at [cd/m²]", fmt::format("V at {:g}", kDarkest_cd_m2),
                     fmt::format("V at {:g}", kBrightest_cd_m2)},
                    {},
                    3};
  add_facts(result, own, table);
  add_facts(result, global, table);
  result.add_table(std::move(table));
  return result;
}

}  // namespace plenolab
