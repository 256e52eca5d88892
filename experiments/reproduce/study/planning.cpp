// Beyond the thesis: what its test can tell, and how many participants a study needs.
#include <fmt/format.h>

#include <array>

#include "analysis/psychophysics/binomial.h"
#include "analysis/psychophysics/planning.h"
#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"

namespace plenolab {

ReproductionResult reproduce_study_planning(Laboratory& laboratory);

namespace {

constexpr std::array<std::int64_t, 4> kStudySizes{34, 40, 100, 400};
constexpr std::array kTrueRates{0.3, 0.35, 0.4, 0.5};
constexpr std::array kMargins{0.1, 0.15, 0.2};
constexpr std::array kPowers{0.8, 0.95};
constexpr std::int64_t kMostPlotted = 300;

PlotSeries line(const std::string& title) {
  return {title, PlotSeries::Style::kLines, {}};
}

/// Probability of passing over the true rate, for several numbers of participants.
ReportPlot pass_plot() {
  Plot plot;
  plot.x = {.title = "True rate of choosing the test image", .minimum = 0, .maximum = 0.6};
  plot.y = {.title = "Probability of passing", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  for (const std::int64_t n : kStudySizes) {
    PlotSeries series = line(fmt::format("{} participants", n));
    const std::int64_t critical = critical_number(n, kPublishedNullRate, kPublishedAlpha);
    for (int i = 0; i <= 120; ++i)
      series.points.push_back({.x = 0.005 * i, .y = upper_tail(critical, n, 0.005 * i)});
    plot.series.push_back(std::move(series));
  }
  return {plot, "Probability of passing over the true rate (0.5: pure guessing)",
          "Rising curves for 34, 40, 100 and 400 participants; the more participants, the steeper near 0.2"};
}

/// Power of both tests over the number of participants if participants only guess.
ReportPlot power_plot() {
  Plot plot;
  plot.x = {.title = "Participants"};
  plot.y = {.title = "Power if participants only guess", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  PlotSeries pass = line(fmt::format("refute {:g}", kPublishedNullRate));
  const std::vector<double> powers = power_curve(kPublishedNullRate, 0.5, kPublishedAlpha, kMostPlotted);
  for (std::size_t i = 0; i < powers.size(); ++i)
    pass.points.push_back({.x = static_cast<double>(i + 1), .y = powers[i]});
  plot.series.push_back(std::move(pass));
  for (const double margin : kMargins) {
    PlotSeries series = line(fmt::format("show 0.5 ± {:g}", margin));
    for (std::int64_t n = 1; n <= kMostPlotted; ++n)
      series.points.push_back(
          {.x = static_cast<double>(n), .y = equivalence_power(n, 0.5, {.margin = margin})});
    plot.series.push_back(std::move(series));
  }
  return {
      plot, "Power over the number of participants who only guess; exact tests, hence the teeth",
      "A curve that reaches 0.99 at about 34 for refuting 0.19, and three that rise later for equivalence "
      "margins of 0.2, 0.15 and 0.1"};
}

void add_size(ReproductionResult& result, ReportTable& table, const std::string& test, double rate,
              double power, const SampleSize& size) {
  table.rows.push_back(
      {test, rate, power, static_cast<long long>(size.first), static_cast<long long>(size.stable)});
  const std::vector<std::pair<std::string, Cell>> columns{
      {"test", test}, {"true_rate", rate}, {"power", power}};
  result.rows.add({"trials_first", static_cast<double>(size.first), "1", columns});
  result.rows.add({"trials_stable", static_cast<double>(size.stable), "1", columns});
}

void add_sizes(ReproductionResult& result) {
  ReportTable table{
      "Participants needed: the first number with the power, and the one from which all have it",
      {"to show", "true rate", "power", "first", "stable"},
      {},
      3};
  for (const double power : kPowers) {
    for (const double rate : kTrueRates)
      add_size(result, table, fmt::format("rate above {:g}", kPublishedNullRate), rate, power,
               plan_test(
                   {.p_null = kPublishedNullRate, .p_true = rate, .alpha = kPublishedAlpha, .power = power}));
    for (const double margin : kMargins)
      add_size(result, table, fmt::format("rate within 0.5 ± {:g}", margin), 0.5, power,
               plan_equivalence({.margin = margin, .alpha = kPublishedAlpha}, 0.5, power));
  }
  result.add_table(std::move(table));
}

}  // namespace

ReproductionResult reproduce_study_planning(Laboratory&) {
  ReproductionResult result;
  const double half_guess = test_power(34, kPublishedNullRate, 0.25, kPublishedAlpha);
  const double all_guess = test_power(34, kPublishedNullRate, 0.5, kPublishedAlpha);
  const EquivalenceOptions equivalence{.alpha = kPublishedAlpha};
  const bool possible = !equivalence_region(34, equivalence).empty();
  const SampleSize needed = plan_equivalence(equivalence, 0.5, 0.8);
  result.paper_shows =
      "Section 4.1.2 tests whether more than 19 % of choices are wrong. It states neither the power of the "
      "test nor how many participants it would take to show that they only guess.";
  result.ours_shows = fmt::format(
      "With 34 participants an image that all of them guess at passes with probability {:.3f}; one that half "
      "of them see through with certainty (true rate 0.25) still passes with {:.3f}. {} That takes {} "
      "participants for a power of 0.8.",
      all_guess, half_guess,
      possible ? "Counts near one half would show that the rate lies within 0.5 ± 0.15."
               : "No count of 34 can show that the rate lies within 0.5 ± 0.15.",
      needed.stable);
  result.differs =
      "The thesis has no such analysis. The test tells image 5 from the others well; for what 'passed' is "
      "said to mean it has " +
      std::string(possible ? "few" : "too few") + " participants.";
  result.add_plot("probability-of-passing", pass_plot());
  result.add_plot("power-over-participants", power_plot());
  add_sizes(result);
  result.rows.add({"pass_probability", half_guess, "1", {{"true_rate", 0.25}, {"trials", 34LL}}});
  result.rows.add({"pass_probability", all_guess, "1", {{"true_rate", 0.5}, {"trials", 34LL}}});
  return result;
}

}  // namespace plenolab
