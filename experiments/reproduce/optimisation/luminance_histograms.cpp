#include "experiments/reproduce/optimisation/luminance_histograms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "analysis/psychophysics/welch.h"
#include "core/image/colour.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/reinhard_global.h"
#include "experiments/optimise/tone_optimiser.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/score.h"
#include "experiments/tonemap_fit.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::array kStandIns{"cellar", "tunnel", "tree", "boats", "desk", "dunes", "dominoes"};
constexpr std::array kPhotographs{"Desk.exr"};

/// The image averaged down to about the number of pixels of a game-like frame.
SceneImage of_equal_size(const SceneImage& image, const OptimisationBench& bench) {
  const double ratio = static_cast<double>(image.size()) / (bench.width() * bench.height());
  return averaged_down(image, std::max(1, static_cast<int>(std::lround(std::sqrt(ratio)))));
}

void add_source(std::vector<HistogramSource>& sources, const std::string& name, bool photograph,
                SceneImage image) {
  const std::optional<HistogramShape> shape = histogram_shape(scene_luminance(image, 1));
  if (shape) sources.push_back({name, photograph, std::move(image), *shape});
}

void add_photographs(std::vector<HistogramSource>& sources, const OptimisationBench& bench) {
  const char* folder = std::getenv("PLENOLAB_OUTSIDE_DATA");
  if (!folder) return;
  for (const char* file : kPhotographs) {
    const fs::path path = fs::path(folder) / "hdr" / file;
    if (!fs::exists(path)) continue;
    const OperatorView view = read_operator_view(path);
    add_source(sources, fmt::format("photograph {}", path.stem().string()), true,
               of_equal_size(RepairedView(*view.colour).image(), bench));
  }
}

DisplayImage by_reinhard(const SceneImage& image) {
  const ViewStatistics measured = measure_view(image);
  return apply(fit(ReinhardGlobalOptions{}, evaluate(measured, log_floor(measured))), image).image;
}

Plot histogram_plot(const HistogramSource& source) {
  Plot plot;
  plot.x = {.title = "Luminance", .unit = "log10 of the image's unit"};
  plot.y = {.title = "Pixels in a bin", .unit = "%", .minimum = 0};
  plot.key = KeyPosition::kNone;
  plot.width_px = 620;
  plot.height_px = 240;
  PlotSeries series{source.name, PlotSeries::Style::kLines, {}};
  const HistogramShape& s = source.shape;
  for (std::size_t i = 0; i < s.shares.size(); ++i)
    series.points.push_back({.x = s.log10_low + (s.log10_high - s.log10_low) *
                                                    (static_cast<double>(i) + 0.5) / HistogramShape::kBins,
                             .y = 100 * s.shares[i]});
  plot.series = {std::move(series)};
  return plot;
}

std::string file_stem(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

}  // namespace

std::vector<HistogramSource> natural_images(Laboratory& laboratory) {
  const OptimisationBench& bench = laboratory.optimisation_bench();
  std::vector<HistogramSource> sources;
  add_photographs(sources, bench);
  for (const char* id : kStandIns) {
    const LightField field = laboratory.light_field(id);
    const auto view = field.view(field.grid().columns / 2, field.grid().rows / 2);
    add_source(sources, id, false, of_equal_size(view->colour, bench));
  }
  return sources;
}

std::size_t photographs_in(const std::vector<HistogramSource>& images) {
  return static_cast<std::size_t>(
      std::count_if(images.begin(), images.end(), [](const HistogramSource& s) { return s.photograph; }));
}

Verdict decide_spikiness(const std::vector<HistogramSource>& games,
                         const std::vector<HistogramSource>& natural, double HistogramShape::*measure,
                         const std::string& quantity) {
  const auto summary = [&](const std::vector<HistogramSource>& images) {
    std::vector<double> values;
    for (const HistogramSource& source : images) values.push_back(source.shape.*measure);
    return summarise(values);
  };
  const Interval difference = welch_test(summary(games), summary(natural)).difference;
  const std::string measured = fmt::format("The difference of the means is {}.", interval_text(difference));
  if (photographs_in(natural) == 0)
    return undecidable(
        fmt::format("No photograph was at hand (PLENOLAB_OUTSIDE_DATA); rendered frames were "
                    "compared with rendered scenes. {}",
                    measured));
  Verdict verdict = decide_claim(
      difference, Comparison::kAbove, 0, quantity, "1",
      fmt::format("95 % Welch interval, {} game-like and {} other images", games.size(), natural.size()));
  verdict.scenes = {"game-like sequences", "natural images"};
  verdict.explanation = measured;
  return verdict;
}

std::vector<HistogramSource> game_images(Laboratory& laboratory) {
  OptimisationBench& bench = laboratory.optimisation_bench();
  std::vector<HistogramSource> sources;
  for (std::size_t s = 0; s < game_sequences().size(); ++s)
    add_source(sources, game_sequences()[s].title, false, bench.frame(s, kGameFrames / 2));
  return sources;
}

void add_histograms(ReproductionResult& result, const std::vector<HistogramSource>& images,
                    const std::string& name, const std::string& caption) {
  ReportTable table{
      caption,
      {"image", "fullest tenth of the bins [%]", "to move for a smooth histogram [%]", "range [log10]"},
      {},
      3};
  for (const HistogramSource& source : images) {
    const HistogramShape& s = source.shape;
    const double range = s.log10_high - s.log10_low;
    table.rows.push_back({source.name, 100 * s.concentration, 100 * s.jaggedness, range});
    const Columns columns{{"image", source.name}};
    result.rows.add({"histogram_concentration", s.concentration, "1", columns});
    result.rows.add({"histogram_jaggedness", s.jaggedness, "1", columns});
    result.rows.add({"range_log10", range, "log10", columns});
  }
  result.add_table(std::move(table));
  for (const HistogramSource& source : images) {
    result.add_comparison(fmt::format("{}-{}", name, file_stem(source.name)),
                          {source.name,
                           "The image, tone mapped by Reinhard's operator.",
                           {{"Reinhard 2002", by_reinhard(source.image)}}},
                          {source.image});
    result.add_plot(fmt::format("{}-histogram-{}", name, file_stem(source.name)),
                    {histogram_plot(source), fmt::format("Histogram of luminance, {}", source.name),
                     "Share of pixels over log luminance in 256 bins."});
  }
}

}  // namespace plenolab
