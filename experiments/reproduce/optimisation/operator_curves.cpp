// Figure 7 and table 1: the perceptual quantiser against gamma, and the parameters of the generic operator.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/tonemap/pq_operator.h"
#include "experiments/optimise/tone_optimiser.h"
#include "experiments/reproduce/optimisation/tuning_tools.h"

namespace plenolab {

ReproductionResult reproduce_pq_curve(Laboratory& laboratory);
ReproductionResult reproduce_generic_parameters(Laboratory& laboratory);

namespace {

constexpr double kGamma = 2.4, kGammaPeak_cd_m2 = 100, kCodes = 1023;

double gamma_luminance(double signal) {
  return kGammaPeak_cd_m2 * std::pow(signal, kGamma);
}

double gamma_signal(double luminance_cd_m2) {
  return std::pow(luminance_cd_m2 / kGammaPeak_cd_m2, 1 / kGamma);
}

Plot curves_plot() {
  Plot plot;
  plot.x = {.title = "Signal", .unit = "1"};
  plot.y = {.title = "Luminance", .unit = "cd/m²", .logarithmic = true, .minimum = 1e-4, .maximum = 2e4};
  plot.key = KeyPosition::kBottomRight;
  PlotSeries pq{"PQ (SMPTE ST 2084)", PlotSeries::Style::kLines, {}},
      gamma{"gamma 2.4, peak 100 cd/m²", PlotSeries::Style::kLines, {}};
  for (int i = 1; i <= 250; ++i) {
    const double signal = i / 250.0;
    if (const double l = pq_luminance(signal); l >= 1e-4) pq.points.push_back({.x = signal, .y = l});
    if (const double l = gamma_luminance(signal); l >= 1e-4) gamma.points.push_back({.x = signal, .y = l});
  }
  plot.series = {std::move(pq), std::move(gamma)};
  return plot;
}

/// Change of luminance from one 10-bit code to the next, at a luminance, in % of it.
double step_percent(double signal, double (*luminance)(double)) {
  const double here = luminance(signal), next = luminance(signal + 1 / kCodes);
  return 100 * (next - here) / here;
}

/// What table 1 prints.
struct PrintedParameter {
  const char *name, *meaning;
  double low, high;
};
constexpr std::array kTable1{PrintedParameter{"b", "brightness", -2, 2},
                             PrintedParameter{"d_l", "lower midtone range", 0, 2.5},
                             PrintedParameter{"d_h", "higher midtone range", 0, 2.5},
                             PrintedParameter{"c", "contrast", 0.2, 1.5},
                             PrintedParameter{"m1", "high frequencies", -2, 2},
                             PrintedParameter{"m2", "medium frequencies", -2, 2},
                             PrintedParameter{"m3", "low frequencies", -2, 2}};

/// Curves with one parameter of the curve at both ends of its range, the others at the start.
Plot parameter_plot(std::size_t parameter) {
  const std::vector<SearchParameter> space = generic_search_space();
  Plot plot;
  plot.x = {.title = "Luminance over the log average", .unit = "log10"};
  plot.y = {.title = "Luma", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kTopLeft;
  plot.width_px = 520;
  plot.height_px = 300;
  for (const double value : {space[parameter].minimum, space[parameter].start, space[parameter].maximum}) {
    std::vector<double> values;
    for (const SearchParameter& p : space) values.push_back(p.start);
    values[parameter] = value;
    const GenericOptions options = generic_options(values);
    PlotSeries series{fmt::format("{} = {:g}", space[parameter].name, value), PlotSeries::Style::kLines, {}};
    for (int i = -200; i <= 200; ++i)
      series.points.push_back({.x = i * 0.02, .y = generic_curve(options, i * 0.02)});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// What the formula itself gives at d_l = 0, where it divides by 0.
double literal_at_zero_range(double x, double contrast) {
  const double d_l = 0, a_l = (contrast * d_l - 1) / d_l;
  return 0.5 * contrast * x / (1 - a_l * x) + 0.5;
}

}  // namespace

ReproductionResult reproduce_pq_curve(Laboratory&) {
  ReproductionResult result;
  result.add_plot("pq-and-gamma", {curves_plot(), "Luminance of a signal by PQ and by gamma 2.4",
                                   "Luminance over the signal from 0 to 1 for both curves."});
  ReportTable table{"Signals of a luminance, and the step from one 10-bit code to the next there",
                    {"luminance [cd/m²]", "PQ signal", "PQ step [%]", "gamma signal", "gamma step [%]"},
                    {},
                    3};
  double dark_pq = 0, dark_gamma = 0;
  bool finer_in_the_dark = true;
  for (const double l : {0.001, 0.01, 0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    const double pq = pq_signal(l), pq_step = step_percent(pq, pq_luminance);
    const bool shown = l <= kGammaPeak_cd_m2;
    const double gamma = shown ? gamma_signal(l) : 0, step = shown ? step_percent(gamma, gamma_luminance) : 0;
    table.rows.push_back({l, pq, pq_step, shown ? Cell(gamma) : Cell(std::string("–")),
                          shown ? Cell(step) : Cell(std::string("–"))});
    const Columns columns{{"luminance_cd_m2", l}};
    result.rows.add({"pq_signal", pq, "1", columns});
    result.rows.add({"pq_step", pq_step, "%", columns});
    if (shown) result.rows.add({"gamma_step", step, "%", columns});
    if (l == 0.01) dark_pq = pq_step, dark_gamma = step;
    if (l <= 0.01) finer_in_the_dark = finer_in_the_dark && pq_step < step;
  }
  result.add_table(std::move(table));
  const double codes_pq = kCodes * pq_signal(0.01), codes_gamma = kCodes * gamma_signal(0.01),
               above = 100 * (1 - pq_signal(kGammaPeak_cd_m2));
  result.paper_shows =
      "Figure 7: PQ against gamma 2.4. PQ is said to be more sensitive below 0.01 cd/m² and to reach beyond "
      "the 100 cd/m² of gamma.";
  result.ours_shows = fmt::format(
      "At 0.01 cd/m² a 10-bit step of PQ is {:.1f} % of luminance, one of gamma {:.1f} %; below it PQ has "
      "{:.0f} codes, gamma {:.0f}. PQ keeps {:.0f} % of its signals for what lies above 100 cd/m².",
      dark_pq, dark_gamma, codes_pq, codes_gamma, above);
  const char* more = codes_pq > 1.1 * codes_gamma   ? "more codes than"
                     : codes_gamma > 1.1 * codes_pq ? "fewer codes than"
                                                    : "about as many codes as";
  result.differs = fmt::format(
      "Below 0.01 cd/m² PQ, whose peak is 100 times as high, has {} gamma; its steps there are {}. The text "
      "has the displayed luminance as x and the physical one as y; here x is the signal.",
      more, finer_in_the_dark ? "finer, as the text says" : "not all finer, against the text");
  return result;
}

ReproductionResult reproduce_generic_parameters(Laboratory&) {
  ReproductionResult result;
  ReportTable table{"Parameters of the generic operator: ranges as printed and as searched here",
                    {"parameter", "what it does", "printed from", "to", "searched from", "to", "start"},
                    {},
                    4};
  const std::vector<SearchParameter> space = generic_search_space();
  int equal = 0;
  for (std::size_t k = 0; k < kTable1.size(); ++k) {
    const PrintedParameter& printed = kTable1[k];
    table.rows.push_back({std::string(printed.name), std::string(printed.meaning), printed.low, printed.high,
                          space[k].minimum, space[k].maximum, space[k].start});
    const Columns columns{{"parameter", std::string(printed.name)}};
    result.rows.add({"search_minimum", space[k].minimum, "1", columns});
    result.rows.add({"search_maximum", space[k].maximum, "1", columns});
    result.rows.add({"search_start", space[k].start, "1", columns});
    equal += printed.low == space[k].minimum && printed.high == space[k].maximum ? 1 : 0;
  }
  result.add_table(std::move(table));
  for (std::size_t k = 0; k < 4; ++k)
    result.add_plot("curve-" + space[k].name,
                    {parameter_plot(k), fmt::format("Curves at the ends of the range of {}", space[k].name),
                     "Luma over luminance for three values of the parameter."});
  const double literal = literal_at_zero_range(0, space[3].start);
  const GenericOptions narrow{.low_range = space[1].minimum, .high_range = space[2].minimum};
  const double rise = generic_curve(narrow, narrow.high_range) - generic_curve(narrow, -narrow.low_range);
  result.paper_shows = "Table 1: seven parameters of the generic operator with their ranges.";
  result.ours_shows = fmt::format("{} of {} ranges are searched as printed; d_l and d_h begin at {:g}.",
                                  equal, kTable1.size(), space[1].minimum);
  result.differs = fmt::format(
      "At the printed lower limit 0 of d_l and d_h the formula divides by 0 ({} at x = b); at our limit the "
      "curve is the step that it tends to, from 0 to 1 within {:g} log10 units (it rises by {:.3f}). "
      "Frequencies and gains of m₁ to m₃ are not printed and chosen here.",
      std::isfinite(literal) ? fmt::format("its value is {:g}", literal) : "its value is no number",
      narrow.low_range + narrow.high_range, rise);
  return result;
}

}  // namespace plenolab
