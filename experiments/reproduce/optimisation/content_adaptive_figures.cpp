#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/tonemap/content_adaptive.h"
#include "core/tonemap/pq_operator.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/tonemap/suitability.h"
#include "experiments/score.h"
#include "metrics/table.h"

namespace plenolab {

ReproductionResult reproduce_linear_and_designed(Laboratory& laboratory);
ReproductionResult reproduce_adapted_slopes(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "cellar";  // dark, with a beam of light: the hardest range of ours
constexpr int kBins = PqHistogram::kBins;

Plane<float> luminance_plane(const SectionView& view) {
  const SceneImage& colour = *view.data.colour;
  Plane<float> plane(colour.width(), colour.height());
  for (std::size_t i = 0; i < colour.size(); ++i)
    plane.pixels()[i] = std::max(0.0f, luminance(colour.pixels()[i]));
  return plane;
}

PqHistogram histogram_of(const Plane<float>& luminance_cd_m2, int threads) {
  const float largest = *std::max_element(luminance_cd_m2.pixels().begin(), luminance_cd_m2.pixels().end());
  return measure_pq_histogram(luminance_cd_m2, largest, threads);
}

/// A way to bring the view to the display.
struct Mapping {
  std::string label;
  DisplayImage image;
  double white_share = 0, tmqi = 0, lost = 0, invented = 0;
};

/// Share of the pixels with a channel at the top of the display's range.
double share_at_white(const DisplayImage& image) {
  const auto white = std::count_if(image.pixels().begin(), image.pixels().end(), [](const Rgb& c) {
    return std::max({c.r, c.g, c.b}) >= 1;
  });
  return static_cast<double>(white) / static_cast<double>(image.size());
}

void judge(Mapping& mapping, const SceneImage& scene, int threads) {
  ComparisonConditions conditions;
  conditions.threads = threads;
  const auto measured =
      measure(mapping.image, scene, select_metrics(std::vector<std::string>{"drim", "tmqi"}), conditions);
  mapping.white_share = share_at_white(mapping.image);
  mapping.tmqi = value_of(measured, "tmqi");
  mapping.lost = value_of(measured, "drim_share_loss");
  mapping.invented = value_of(measured, "drim_share_amplification");
}

std::vector<Mapping> mappings_of(const SectionView& view, int threads) {
  const SceneImage& scene = *view.data.colour;
  const PqHistogram histogram = histogram_of(luminance_plane(view), threads);
  const auto scaled = [&](double white) {
    return expose(scene, static_cast<float>(1 / std::max(white, 1e-30)));
  };
  std::vector<Mapping> mappings{
      {"Linear, log average at 0.18", scaled(std::pow(10, histogram.log_average()) / 0.18)},
      {"Linear, 99th percentile at white", scaled(std::pow(10, view.log_p99))},
      {"Content adaptive", apply(fit(ContentAdaptiveOptions{}, histogram), scene, threads).image}};
  for (Mapping& mapping : mappings) judge(mapping, scene, threads);
  return mappings;
}

void add_mapping_rows(ReproductionResult& result, const std::vector<Mapping>& mappings) {
  ReportTable table{
      "What each mapping leaves: share of pixels at white, TMQI (1 is best), and shares of pixels where DRIM "
      "finds visible "
      "contrast lost or invisible contrast amplified",
      {"mapping", "at white", "TMQI", "lost", "amplified"},
      {}};
  table.digits = 3;
  for (const Mapping& m : mappings) {
    const Columns columns{{"scene", std::string(kScene)}, {"mapping", m.label}};
    result.rows.add({"share_at_white", m.white_share, "1", columns});
    result.rows.add({"tmqi", m.tmqi, "1", columns});
    result.rows.add({"drim_share_loss", m.lost, "1", columns});
    result.rows.add({"drim_share_amplification", m.invented, "1", columns});
    table.rows.push_back({m.label, m.white_share, m.tmqi, m.lost, m.invented});
  }
  result.add_table(std::move(table));
}

std::string compared(const std::vector<Mapping>& mappings) {
  const Mapping& designed = mappings.back();
  const bool best = std::all_of(mappings.begin(), mappings.end() - 1,
                                [&](const Mapping& m) { return m.tmqi < designed.tmqi; });
  const bool keeps = std::all_of(mappings.begin(), mappings.end() - 1,
                                 [&](const Mapping& m) { return m.lost > designed.lost; });
  if (best && keeps)
    return "They agree: the designed mapping has the higher quality and loses less contrast.";
  if (best || keeps)
    return fmt::format("They agree in part: the designed mapping {} than both linear ones, but {}.",
                       best ? "has the higher TMQI" : "loses less visible contrast",
                       best ? "one of them loses less visible contrast" : "one of them has the higher TMQI");
  return "They differ: by these measures a linear mapping is no worse on our scene.";
}

/// Slope of the curve of luma over the signal, by bin; the rise over one unit of the signal.
std::vector<double> slopes_of(const std::vector<double>& luma, double signal_max) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i + 1 < luma.size(); ++i)
    slopes.push_back((luma[i + 1] - luma[i]) * kBins / signal_max);
  return slopes;
}

/// The photographic curve at the ends of the bins, scaled to the range of `adapted`.
std::vector<double> photographic_curve(const ContentAdaptiveOptions& options, const PqHistogram& histogram,
                                       double top) {
  std::vector<double> luma;
  for (int i = 0; i <= kBins; ++i) {
    const double scaled =
        options.key * pq_luminance(histogram.signal_max * i / kBins) / std::pow(10, histogram.log_average());
    luma.push_back(std::pow(scaled / (1 + scaled), 1 / 2.2));
  }
  const double scale = top / luma.back();
  for (double& v : luma) v *= scale;
  return luma;
}

PlotSeries series_of(const std::string& title, const std::vector<double>& values, double signal_max,
                     int last) {
  PlotSeries series{.title = title, .style = PlotSeries::Style::kLines, .points = {}};
  constexpr int kJoined = 8;  // bins a point: a figure has no more pixels
  for (int i = 0; i + kJoined <= last; i += kJoined) {
    double sum = 0;
    for (int k = i; k < i + kJoined; ++k) sum += values[static_cast<std::size_t>(k)];
    series.points.push_back({.x = signal_max * (i + kJoined / 2.0) / kBins, .y = sum / kJoined});
  }
  return series;
}

int last_used_bin(const PqHistogram& histogram) {
  int last = kBins;
  while (last > 8 && histogram.counts[static_cast<std::size_t>(last - 1)] == 0) --last;
  return last;
}

struct Slopes {
  PqHistogram histogram;
  ContentAdaptiveCurve curve;
  std::vector<double> before, after;      ///< photographic and adapted, by bin
  double pixels = 0, in_heavy = 0;        ///< share of the pixels in heavy bins
  int lowered = 0, raised = 0;            ///< bins
  int heavy_lowered = 0, low_raised = 0;  ///< bins against the figure
};

Slopes slopes_in(const SectionView& view, int threads) {
  const ContentAdaptiveOptions options;
  Slopes s{.histogram = histogram_of(luminance_plane(view), threads), .curve = {}, .before = {}, .after = {}};
  s.curve = fit_curve(options, s.histogram);
  const std::vector<double> adapted(s.curve.luma.begin(), s.curve.luma.end());
  s.after = slopes_of(adapted, s.curve.signal_max);
  s.before = slopes_of(photographic_curve(options, s.histogram, adapted.back()), s.curve.signal_max);
  s.pixels = static_cast<double>(view.data.colour->size());
  const BinSplit split = split_by_entropy(s.histogram.counts);
  constexpr double kEqual = 1e-3;  // the curve is stored in single precision
  for (std::size_t i = 0; i < s.after.size(); ++i) {
    s.in_heavy += split.heavy[i] ? static_cast<double>(s.histogram.counts[i]) / s.pixels : 0;
    s.lowered += s.after[i] < s.before[i] * (1 - kEqual) ? 1 : 0;
    s.raised += s.after[i] > s.before[i] * (1 + kEqual) ? 1 : 0;
    s.heavy_lowered += split.heavy[i] && s.after[i] < s.before[i] * (1 - kEqual) ? 1 : 0;
    s.low_raised += !split.heavy[i] && s.after[i] > s.before[i] * (1 + kEqual) ? 1 : 0;
  }
  return s;
}

std::string differs_of(const Slopes& s) {
  if (!s.curve.plain.empty())
    return fmt::format("Nothing is redistributed in this view, which keeps the photographic curve: {}.",
                       s.curve.plain);
  if (s.heavy_lowered + s.low_raised > 0)
    return fmt::format("Against the figure, {} bins of many pixels have less slope and {} of few have more.",
                       s.heavy_lowered, s.low_raised);
  return "The figure is a sketch on other images; what it says of slopes holds here in every bin.";
}

void add_slope_rows(ResultTable& rows, const Slopes& s) {
  const Columns columns{{"scene", std::string(kScene)}};
  rows.add({"heavy_bins", static_cast<double>(s.curve.heavy_bins), "bins", columns});
  rows.add({"share_in_heavy_bins", s.in_heavy, "1", columns});
  rows.add({"bins_lowered", static_cast<double>(s.lowered), "bins", columns});
  rows.add({"bins_raised", static_cast<double>(s.raised), "bins", columns});
  rows.add({"largest_rise", s.curve.largest_rise, "1", columns});
}

void add_slope_plots(ReproductionResult& result, const Slopes& s) {
  const int last = last_used_bin(s.histogram);
  Plot slopes;
  slopes.x = {.title = "PQ signal of luminance", .minimum = 0};
  slopes.y = {.title = "Slope of luma", .minimum = 0};
  slopes.key = KeyPosition::kOutside;
  slopes.width_px = 860;
  slopes.series = {series_of("Photographic", s.before, s.curve.signal_max, last),
                   series_of("Content adaptive", s.after, s.curve.signal_max, last)};
  result.add_plot("slopes", {slopes, "Slopes before and after redistribution, means of eight bins",
                             "Slopes of the photographic and of the adapted curve over the signal"});
  std::vector<double> shares;
  for (const std::int64_t count : s.histogram.counts)
    shares.push_back(100 * static_cast<double>(count) / s.pixels);
  Plot population;
  population.x = slopes.x;
  population.y = {.title = "Pixels", .unit = "% a bin", .minimum = 0};
  population.key = KeyPosition::kNone;
  population.series = {series_of("Pixels", shares, s.curve.signal_max, last)};
  result.add_plot("population", {population, "Population of the bins, means of eight",
                                 "Share of the pixels over the signal"});
}

}  // namespace

ReproductionResult reproduce_linear_and_designed(Laboratory& laboratory) {
  const SectionScene scene(laboratory, kScene);
  const SectionView view = scene.view(scene.middle());
  std::vector<Mapping> mappings = mappings_of(view, laboratory.options().threads);
  ReproductionResult result;
  result.paper_shows =
      "Figure 1: a rendered frame of a game, mapped linearly and by a designed tone mapping, which shows "
      "more of "
      "dark and bright parts.";
  result.ours_shows = fmt::format(
      "{}, key view {}. A linear mapping that puts the log average at 0.18 leaves {} of the pixels at white "
      "(TMQI {:.3f}), one that puts the "
      "99th percentile there {} ({:.3f}); the content adaptive operator leaves {} ({:.3f}). Visible contrast "
      "is lost on {}, {} and {} of the "
      "pixels.",
      scene.title(), view.name, percent(mappings[0].white_share), mappings[0].tmqi,
      percent(mappings[1].white_share), mappings[1].tmqi, percent(mappings[2].white_share), mappings[2].tmqi,
      percent(mappings[0].lost), percent(mappings[1].lost), percent(mappings[2].lost));
  result.differs = compared(mappings);
  add_mapping_rows(result, mappings);
  ImageComparison comparison{fmt::format("{}, key view {}", scene.title(), view.name),
                             "A view mapped linearly twice and by the content adaptive operator",
                             {}};
  for (Mapping& m : mappings) comparison.images.push_back({m.label, std::move(m.image)});
  result.add_comparison("mappings", std::move(comparison));
  return result;
}

ReproductionResult reproduce_adapted_slopes(Laboratory& laboratory) {
  const SectionScene scene(laboratory, kScene);
  const SectionView view = scene.view(scene.middle());
  const Slopes s = slopes_in(view, laboratory.options().threads);
  ReproductionResult result;
  result.paper_shows =
      "Figure 3: slopes of the curve are lowered where bins hold few pixels (range detaining), and what that "
      "frees "
      "is given to bins that hold many (range redistribution).";
  result.ours_shows = fmt::format(
      "{}, key view {}: {} of {} bins are heavy and hold {} of the pixels. {} bins have less slope than the "
      "photographic curve, {} more, at most {:.1f} times as much; the rise of the whole curve stays.",
      scene.title(), view.name, s.curve.heavy_bins, kBins, percent(s.in_heavy), s.lowered, s.raised,
      s.curve.largest_rise);
  result.differs = differs_of(s);
  add_slope_rows(result.rows, s);
  add_slope_plots(result, s);
  return result;
}

}  // namespace plenolab
