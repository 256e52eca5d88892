// Figures 3 and 4: estimated luminance and PSNR along the observers' line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics.h"
#include "experiments/reproduce/luminance/figure_words.h"
#include "experiments/reproduce/luminance/luminance_tools.h"

namespace plenolab {

ReproductionResult reproduce_estimated_luminance(Laboratory& laboratory);
ReproductionResult reproduce_psnr_along_the_line(Laboratory& laboratory);

namespace {

const PlotAxis kLine{.title = "Position on the observers' line", .unit = "m"};

std::optional<std::pair<double, double>> extent_of(const PlotSeries& series) {
  if (series.points.empty()) return std::nullopt;
  const auto [low, high] =
      std::minmax_element(series.points.begin(), series.points.end(),
                          [](const PlotPoint& a, const PlotPoint& b) { return a.y < b.y; });
  return std::pair{low->y, high->y};
}

/// What the curves look like, for those who do not see them.
std::string alt_text(const Plot& plot, const char* quantity, const char* unit) {
  std::string text = std::string(quantity) + " over the position of the observer:";
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const auto extent = extent_of(plot.series[s]);
    if (!extent) continue;
    const std::string low = fmt::format("{:.3g}", extent->first),
                      high = fmt::format("{:.3g}", extent->second);
    text += fmt::format("{} {} {} {}", s == 0 ? "" : ";", plot.series[s].title,
                        low == high ? low : fmt::format("between {} and {}", low, high), unit);
  }
  return text + ".";
}

ReportPlot estimate_plot(LuminanceBench& bench, const std::string& id) {
  Plot plot;
  plot.x = kLine;
  plot.y = {.title = "Estimated luminance", .unit = "cd/m²", .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  for (const LuminanceMethod method : bench.methods()) {
    PlotSeries series{paper_name(method), PlotSeries::Style::kLines, {}};
    for (const CurvePoint& point : curve_of(bench.estimate(id, bench.method_options(method))))
      series.points.push_back({point.x_m, std::exp(point.ln_luminance)});
    plot.series.push_back(std::move(series));
  }
  PlotSeries truth{"of the true picture", PlotSeries::Style::kPoints, {}};
  const auto& scores = bench.scores(id);
  const GlobalLuminance& brute = bench.estimate(id, bench.method_options(LuminanceMethod::kBruteForce));
  for (std::size_t i = 0; i < scores.x_m.size(); ++i)
    if (const auto ln = difference(brute.ln_at({scores.x_m[i], 0}), scores.ln_error[kOfBruteForce][i]))
      truth.points.push_back({scores.x_m[i], std::exp(*ln)});
  // A scene without any pixel above ε has no such points.
  if (!truth.points.empty()) plot.series.push_back(std::move(truth));
  return {plot, fmt::format("Estimated luminance along the observers' line, scene {}", bench.title(id)),
          alt_text(plot, "Luminance", "cd/m²")};
}

/// One sentence on a scene's curves.
std::string curve_sentence(LuminanceBench& bench, const std::string& id, ReproductionResult& result) {
  std::string text;
  for (const LuminanceMethod method : bench.methods()) {
    const GlobalLuminance& estimate = bench.estimate(id, bench.method_options(method));
    const CurveMeasures measures = measure_curve(estimate);
    const Columns columns{{"scene", id}, {"method", std::string(name_of(method))}};
    result.rows.add({"ln_range", measures.range, "1", columns});
    result.rows.add({"ln_total_variation", measures.total_variation, "1", columns});
    result.rows.add({"undefined_samples", static_cast<double>(estimate.undefined()), "samples", columns});
    if (!estimate.known()) continue;
    const auto [low, high] = std::minmax_element(estimate.ln_luminance.begin(), estimate.ln_luminance.end());
    text += method == LuminanceMethod::kAll
                ? fmt::format("{}: All gives {:.3g} cd/m²", bench.title(id), std::exp(*low))
                : fmt::format(", {} {:.3g} to {:.3g}", paper_name(method), std::exp(*low), std::exp(*high));
  }
  return text + " cd/m².";
}

/// RMS distance in ln from the log average of the true pictures, by method.
std::string truth_sentence(LuminanceBench& bench, const std::string& id, ReproductionResult& result) {
  std::string text = bench.title(id);
  const auto& errors = bench.scores(id).ln_error;
  for (std::size_t m = 0; m < errors.size(); ++m) {
    const std::optional<double> error = rms_of_defined(errors[m]);
    text += fmt::format("{} {} {}", m == 0 ? ":" : ",", paper_name(bench.methods()[m]),
                        error ? fmt::format("{:.3f}", *error) : "undefined");
    if (!error) continue;
    result.rows.add({"ln_rms_to_truth",
                     *error,
                     "1",
                     {{"scene", id}, {"method", std::string(name_of(bench.methods()[m]))}}});
  }
  return text;
}

void add_sentence(std::string& text, const std::string& sentence) {
  if (!text.empty()) text += ' ';
  text += sentence;
}

std::vector<double> finite(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values;
}

ReportPlot psnr_plot(LuminanceBench& bench, const std::string& id, bool ground_truth) {
  Plot plot;
  plot.x = kLine;
  plot.y = {.title = "PSNR", .unit = "dB"};
  plot.key = KeyPosition::kOutside;
  const auto& scores = bench.scores(id);
  const auto& values = scores_against(scores, ground_truth);
  for (std::size_t m = 0; m < values.size(); ++m) {
    PlotSeries series{paper_name(bench.methods()[m]), PlotSeries::Style::kLines, {}};
    for (std::size_t i = 0; i < scores.x_m.size(); ++i)
      if (std::isfinite(values[m][i])) series.points.push_back({scores.x_m[i], values[m][i]});
    plot.series.push_back(std::move(series));
  }
  return {plot,
          fmt::format("PSNR of the tone mapped display against {}, scene {}",
                      ground_truth ? "GroundTruth" : "OnResult", bench.title(id)),
          alt_text(plot, "PSNR", "dB")};
}

/// Mean over the line by method and reference, filed and in words.
std::string psnr_sentence(LuminanceBench& bench, const std::string& id, ReproductionResult& result) {
  const auto& scores = bench.scores(id);
  std::string text = bench.title(id) + ":";
  for (const bool ground_truth : {true, false}) {
    text += fmt::format("{} against {}", ground_truth ? "" : ";", ground_truth ? "GroundTruth" : "OnResult");
    for (std::size_t m = 0; m < bench.methods().size(); ++m) {
      const auto& values = scores_against(scores, ground_truth)[m];
      const std::string reference = ground_truth ? "ground-truth" : "on-result";
      for (std::size_t i = 0; i < values.size(); ++i)
        result.rows.add({"psnr_db",
                         values[i],
                         "dB",
                         {{"scene", id},
                          {"reference", reference},
                          {"method", std::string(name_of(bench.methods()[m]))},
                          {"observer_x_m", scores.x_m[i]}}});
      const std::vector<double> usable = finite(values);
      if (!usable.empty())
        text += fmt::format("{} {} {:.1f}", m == 0 ? "" : ",", paper_name(bench.methods()[m]), mean(usable));
    }
    text += " dB";
  }
  return text + ".";
}

/// What the paper's figure 3 shows, by our curves.
std::string figure_3_words(LuminanceBench& bench, const std::string& id) {
  const auto measures = [&](LuminanceMethod method) {
    return measure_curve(bench.estimate(id, bench.method_options(method)));
  };
  const CurveMeasures brute = measures(LuminanceMethod::kBruteForce),
                      accumulated = measures(LuminanceMethod::kAccumulative);
  const auto& errors = bench.scores(id).ln_error;
  return compare_with_figure_3({.title = bench.title(id),
                                .brute_range = brute.range,
                                .accumulative_range = accumulated.range,
                                .brute_variation = brute.total_variation,
                                .accumulative_variation = accumulated.total_variation,
                                .all_to_truth = rms_of_defined(errors[kOfAll]),
                                .brute_to_truth = rms_of_defined(errors[kOfBruteForce])});
}

std::string figure_4_words(LuminanceBench& bench, const std::string& id, bool ground_truth) {
  const auto& scores = bench.scores(id);
  const auto& db = scores_against(scores, ground_truth);
  return compare_with_figure_4({.title = bench.title(id),
                                .reference = ground_truth ? "GroundTruth" : "OnResult",
                                .x_m = scores.x_m,
                                .all_db = db[kOfAll],
                                .brute_db = db[kOfBruteForce],
                                .accumulative_db = db[kOfAccumulative]});
}

/// Mean gain over Accumulative over the positions of all scenes, dB.
double lead_of_brute_force(LuminanceBench& bench, bool ground_truth) {
  std::vector<double> leads;
  for (const std::string& id : bench.scene_ids()) {
    const auto& db = scores_against(bench.scores(id), ground_truth);
    const std::vector<double> lead = finite(minus(db[kOfBruteForce], db[kOfAccumulative]));
    leads.insert(leads.end(), lead.begin(), lead.end());
  }
  return leads.empty() ? 0 : mean(leads);
}

}  // namespace

ReproductionResult reproduce_estimated_luminance(Laboratory& laboratory) {
  ReproductionResult result;
  LuminanceBench& bench = laboratory.luminance_bench();
  result.paper_shows =
      "Figure 3: All is a level line; BruteForce and Accumulative follow each other over the line, "
      "Accumulative with more restlessness and larger amplitude. The figure does not name its scene.";
  for (const std::string& id : bench.scene_ids()) {
    add_sentence(result.ours_shows, curve_sentence(bench, id, result));
    result.add_plot("luminance-" + id, estimate_plot(bench, id));
  }
  double apart = 0;
  for (const std::string& id : bench.scene_ids()) {
    const auto& brute = bench.estimate(id, bench.method_options(LuminanceMethod::kBruteForce)).ln_luminance;
    const auto& accumulated =
        bench.estimate(id, bench.method_options(LuminanceMethod::kAccumulative)).ln_luminance;
    for (std::size_t i = 0; i < std::min(brute.size(), accumulated.size()); ++i)
      apart = std::max(apart, std::abs(brute[i] - accumulated[i]));
  }
  std::string to_truth;
  for (const std::string& id : bench.scene_ids())
    to_truth += fmt::format("{}{}", to_truth.empty() ? "" : "; ", truth_sentence(bench, id, result));
  add_sentence(result.ours_shows,
               fmt::format("RMS distance in ln from the log average of the true picture: {}.", to_truth));
  for (const std::string& id : bench.scene_ids()) add_sentence(result.differs, figure_3_words(bench, id));
  result.differs += fmt::format(
      " The scenes are our own, built to the paper's words; so are the projectors and the diffuser, of which "
      "it says nothing. BruteForce and Accumulative are at most {:.2f} apart in ln, a factor of {:.2f}. "
      "Spread is what the paper suggests and did not build.",
      apart, std::exp(apart));
  return result;
}

ReproductionResult reproduce_psnr_along_the_line(Laboratory& laboratory) {
  ReproductionResult result;
  LuminanceBench& bench = laboratory.luminance_bench();
  result.paper_shows =
      "Figure 4, scene Pillars: BruteForce and Accumulative lie close to each other and mostly above All; in "
      "certain areas Accumulative is noticeably worse than BruteForce.";
  for (const std::string& id : bench.scene_ids()) {
    add_sentence(result.ours_shows, psnr_sentence(bench, id, result));
    for (const bool ground_truth : {true, false})
      result.add_plot(fmt::format("psnr-{}-{}", id, ground_truth ? "ground-truth" : "on-result"),
                      psnr_plot(bench, id, ground_truth));
  }
  for (const bool ground_truth : {false, true})
    add_sentence(result.differs, figure_4_words(bench, "pillars", ground_truth));
  const double to_truth = lead_of_brute_force(bench, true), to_result = lead_of_brute_force(bench, false);
  result.differs += fmt::format(
      " The paper measures Pillars only. Over both scenes BruteForce is {:.2f} dB {} than Accumulative "
      "against OnResult and {:.2f} dB {} against GroundTruth.{}",
      std::abs(to_result), to_result > 0 ? "better" : "worse", std::abs(to_truth),
      to_truth > 0 ? "better" : "worse",
      to_result > 0 && to_truth < 0
          ? " Brute force estimates what the blurred display shows, accumulation what the scene would."
          : "");
  return result;
}

}  // namespace plenolab
