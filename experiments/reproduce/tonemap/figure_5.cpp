// Figure 5 (section 2.1.2): trimming of the histogram, pass by pass.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/tone_scene.h"
#include "experiments/reproduce/tonemap/trimming.h"
#include "experiments/score.h"

namespace plenolab {

ReproductionResult reproduce_trimming(Laboratory& laboratory);

namespace {

constexpr std::array kCeilings{HistogramCeiling::kPerceptual, HistogramCeiling::kAsPrinted};
/// A dark scene and a bright one.
constexpr std::array kTrimmedScenes{"cellar", "dunes"};
/// Of the plots: the 4096 bins of the operator are too narrow to be seen.
constexpr int kPlottedBins = 96;
/// Rows of a table; of longer logs the first ones and the last are shown.
constexpr std::size_t kShownPasses = 10;

/// Shares of the pixels over luminance.
PlotSeries histogram_series(std::string title, const LogHistogram& shares) {
  const std::vector<double> coarse = resample(shares.counts, kPlottedBins);
  PlotSeries series{.title = std::move(title), .style = PlotSeries::Style::kLines, .points = {}};
  const double width = (shares.log_max - shares.log_min) / kPlottedBins;
  for (int i = 0; i < kPlottedBins; ++i)
    series.points.push_back({.x = std::pow(10.0, shares.log_min + (i + 0.5) * width),
                             .y = 100 * coarse[static_cast<std::size_t>(i)]});
  return series;
}

/// One scene with its logs, in the order of kCeilings.
struct TrimmedScene {
  std::string id, title;
  LogHistogram shares;  ///< before trimming, of all pixels
  std::vector<TrimmingLog> logs;
};

TrimmedScene trim_scene(Laboratory& laboratory, const std::string& id) {
  const int threads = laboratory.options().threads;
  const ToneScene scene = tone_scene(laboratory, id);
  const std::size_t middle = middle_view(scene.field.grid());
  TrimmedScene trimmed{id, scene.title, {}, {}};
  for (const HistogramCeiling ceiling : kCeilings) {
    const HistogramOptions options{.ceiling = ceiling};
    const LogHistogram histogram = histogram_of_view(scene, middle, options.bins, threads);
    trimmed.shares = shares_of(histogram);
    trimmed.logs.push_back(log_trimming(options, histogram, scene.statistics.floor));
  }
  return trimmed;
}

void add_pass_rows(ReproductionResult& result, const TrimmedScene& scene, std::size_t which,
                   ReportTable& table) {
  const TrimmingLog& log = scene.logs[which];
  const std::string ceiling = name_of(kCeilings[which]);
  for (std::size_t i = 0; i < log.passes.size(); ++i) {
    const LoggedPass& pass = log.passes[i];
    const auto number = static_cast<long long>(i + 1);
    const Columns columns{{"scene", scene.id}, {"ceiling", ceiling}, {"pass", number}};
    result.rows.add({"total_before", pass.pass.total, "px", columns});
    result.rows.add({"trimmed", pass.pass.trimmed, "px", columns});
    result.rows.add({"trimmed_bins", static_cast<double>(pass.pass.bins), "bins", columns});
    result.rows.add({"largest_slope", pass.largest_slope, "1", columns});
    if (i + 1 > kShownPasses - 1 && i + 1 < log.passes.size()) continue;
    table.rows.push_back({scene.title, ceiling, number, std::round(pass.pass.total),
                          std::round(pass.pass.trimmed), static_cast<long long>(pass.pass.bins),
                          pass.largest_slope});
  }
}

ReportPlot histogram_plot(const TrimmedScene& scene) {
  Plot plot;
  plot.x = {.title = "Luminance", .unit = "cd/m²", .logarithmic = true};
  plot.y = {.title = "Pixels per bin", .unit = "% of the view", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  plot.series = {histogram_series("before", scene.shares)};
  for (std::size_t i = 0; i < scene.logs.size(); ++i)
    if (scene.logs[i].trimmed)
      plot.series.push_back(histogram_series("ceiling " + name_of(kCeilings[i]), *scene.logs[i].trimmed));
  return {plot,
          fmt::format("{}: histogram of the middle key view before and after trimming, in {} bins; what is "
                      "missing was trimmed. A ceiling that ends in a linear mapping leaves no histogram",
                      scene.title, kPlottedBins),
          fmt::format("Histograms of {} before and after trimming", scene.title)};
}

/// "12 passes leave 78.1 %, largest slope 0.44 (before: 5.9)".
std::string log_text(const TrimmingLog& log) {
  if (log.passes.empty()) return "no pass (" + log.linear_because + ")";
  std::string text = fmt::format("{} {}", log.passes.size(), log.passes.size() == 1 ? "pass" : "passes");
  if (!log.trimmed) return text + " until linear mapping (" + log.linear_because + ")";
  return text + fmt::format(" leaving {:.1f} % of the pixels; largest slope {:.2f} (before: {:.1f})",
                            100 * log.left_share(), log.passes.back().largest_slope, log.slope_before);
}

std::string difference_text(const std::vector<TrimmedScene>& scenes) {
  std::string text =
      "The log follows the pseudo-code line by line, and ends each scene by one of its two returns. The "
      "ceiling printed in "
      "section 5.1.4 is the inverse ratio of the one that limits contrast to the scene's: ";
  for (const TrimmedScene& scene : scenes) {
    const TrimmingLog &right = scene.logs[0], &printed = scene.logs[1];
    text += fmt::format("{} keeps {:.1f} % of its histogram with the right one and {:.1f} % as printed; ",
                        scene.title, 100 * right.left_share(), 100 * printed.left_share());
  }
  text += "too much is trimmed.";
  if (scenes.front().logs.front().passes.size() > 0 &&
      scenes.front().logs.front().passes.back().largest_slope > 1)
    text +=
        " Slopes above 1 remain under the perceptual ceiling where the display is darker than the scene, as "
        "differences are seen less there.";
  return text;
}

}  // namespace

ReproductionResult reproduce_trimming(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 5 is pseudo-code: bins are cut to a ceiling again and again until a pass trims no more than "
      "2.5 "
      "% of the pixels; if less than that share is left, it fails. No histogram is shown.";
  ReportTable table{
      "Trimming of the middle key views; slope: of log display luminance over log luminance",
      {"scene", "ceiling", "pass", "total before [px]", "trimmed [px]", "bins cut", "largest slope after"},
      {},
      3};
  std::vector<TrimmedScene> scenes;
  for (const char* id : kTrimmedScenes) {
    scenes.push_back(trim_scene(laboratory, id));
    const TrimmedScene& scene = scenes.back();
    for (std::size_t i = 0; i < scene.logs.size(); ++i) {
      add_pass_rows(result, scene, i, table);
      result.ours_shows +=
          fmt::format("{}, ceiling {}: {}. ", scene.title, name_of(kCeilings[i]), log_text(scene.logs[i]));
    }
    result.add_plot(scene.id + "-histogram", histogram_plot(scene));
  }
  result.differs = difference_text(scenes);
  result.add_table(std::move(table));
  return result;
}

}  // namespace plenolab
