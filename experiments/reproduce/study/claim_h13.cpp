// H-13, chapter 5: the mean difference of an image does not predict what people choose.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "analysis/psychophysics/rank_correlation.h"
#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"
#include "experiments/reproduce/tonemap/claim_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_h13(Laboratory& laboratory);

namespace {

/// ρ below which the difference would explain more than half of the variance of the ranks of choices.
const double kHalfExplained = -std::sqrt(0.5);

std::array<double, 5> choices_on(const std::string& display) {
  std::array<double, 5> choices{};
  std::size_t i = 0;
  for (const StudyCount& count : published_main_study())
    if (count.display == display) choices[i++] = static_cast<double>(count.chose_test.hits);
  return choices;
}

/// The correlation among images 1 to 4, without the one that was made to fail.
double rho_without_last(const std::array<double, 5>& values, const std::array<double, 5>& choices) {
  const auto first_four = [](const std::array<double, 5>& all) { return std::span(all).first(4); };
  return rank_correlation(first_four(values), first_four(choices)).rho.estimate;
}

struct Statistic {
  std::string name;
  std::array<double, 5> values;
};

void add_correlation(ReproductionResult& result, ReportTable& table, const Statistic& statistic,
                     const std::string& display, const RankCorrelation& r) {
  table.rows.push_back({statistic.name, display, r.rho.estimate, r.rho.low, r.rho.high, r.p_two_sided});
  const std::vector<std::pair<std::string, Cell>> columns{{"statistic", statistic.name},
                                                          {"display", display}};
  result.rows.add({"spearman_rho", r.rho.estimate, "1", columns});
  result.rows.add({"spearman_rho_low", r.rho.low, "1", columns});
  result.rows.add({"spearman_rho_high", r.rho.high, "1", columns});
  result.rows.add({"spearman_p", r.p_two_sided, "1", columns});
}

ReportPlot scatter(const std::array<double, 5>& means) {
  Plot plot;
  plot.x = {.title = "Mean difference |VC − IC|"};
  plot.y = {.title = "Choices of the reprojected image", .minimum = 0, .maximum = 34};
  plot.key = KeyPosition::kOutside;
  for (const std::string display : {"light-field", "monitor"}) {
    PlotSeries series{display, PlotSeries::Style::kPoints, {}};
    const std::array<double, 5> choices = choices_on(display);
    for (std::size_t i = 0; i < means.size(); ++i)
      series.points.push_back({.x = means[i], .y = choices[i], .label = std::to_string(i + 1)});
    plot.series.push_back(std::move(series));
  }
  return {
      plot, "Choices (table 5.1) over the mean difference of the images (table 5.3, mean of the channels)",
      "Ten points, numbered by image: image 5 has the largest difference and the fewest choices; the other "
      "four show no common order"};
}

}  // namespace

ReproductionResult reproduce_claim_h13(Laboratory&) {
  ReproductionResult result;
  const PublishedDifferences d = published_differences();
  ReportTable table{"Rank correlation (Spearman) of choices with the printed differences, 5 images",
                    {"difference", "display", "ρ", "95 % from", "to", "exact p"},
                    {},
                    3};
  std::vector<RankCorrelation> of_mean;
  for (const Statistic& statistic :
       {Statistic{"mean", d.mean}, Statistic{"median", d.median}, Statistic{"largest", d.largest}})
    for (const std::string display : {"light-field", "monitor"}) {
      const RankCorrelation r = rank_correlation(statistic.values, choices_on(display));
      add_correlation(result, table, statistic, display, r);
      if (statistic.name == "mean") of_mean.push_back(r);
    }
  result.paper_shows =
      "Chapter 5 with table 5.3: a low mean difference does not necessarily indicate that more participants "
      "will choose the reprojected image.";
  result.ours_shows = fmt::format(
      "Rank correlation of mean difference and choices: ρ = {:.2f} (exact p = {:.2f}) on the light-field "
      "display, {:.2f} (p = {:.2f}) on the monitor. With five images only a perfect order could reach p = "
      "{:.3f}.",
      of_mean[0].rho.estimate, of_mean[0].p_two_sided, of_mean[1].rho.estimate, of_mean[1].p_two_sided,
      of_mean[0].smallest_p);
  const std::array<const char*, 2> names{"light-field display", "monitor"};
  for (std::size_t i = 0; i < names.size(); ++i)
    add_claim(
        result,
        {fmt::format("H-13{}", i == 0 ? 'a' : 'b'), "Hansen & Klein 2016, chapter 5, table 5.3",
         fmt::format("The mean difference does not predict the choices on the {}.", names[i])},
        {of_mean[i].rho,
         Comparison::kAbove,
         kHalfExplained,
         "spearman_rho",
         "1",
         "95 % by Fisher's z (Bonett & Wright 2000), 5 images",
         {"images 1 to 5 of the thesis"},
         fmt::format("Not predicting is taken to mean that less than half of the variance of the ranks is "
                     "explained (ρ > {:.3f}). Exact p of ρ = 0: {:.2f}.",
                     kHalfExplained, of_mean[i].p_two_sided)});
  const double display = rho_without_last(d.mean, choices_on("light-field")),
               monitor = rho_without_last(d.mean, choices_on("monitor"));
  result.rows.add({"spearman_rho_without_image_5", display, "1", {{"display", "light-field"}}});
  result.rows.add({"spearman_rho_without_image_5", monitor, "1", {{"display", "monitor"}}});
  result.differs =
      outcome_words(result) +
      fmt::format(
          " Five images are too few to tell a predictor from none. Without image 5, which was made to fail, "
          "ρ is {:.2f} on the light-field display and {:.2f} on the monitor.",
          display, monitor);
  result.add_plot("choices-over-difference", scatter(d.mean));
  result.add_table(std::move(table));
  return result;
}

}  // namespace plenolab
