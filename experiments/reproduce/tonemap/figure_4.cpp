// Figure 4 (section 2.1.2): histogram equalisation through the cumulative distribution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/tonemap/suitability.h"

namespace plenolab {

ReproductionResult reproduce_equalisation(Laboratory& laboratory);

namespace {

constexpr int kBins = 64;

/// Shares of values in even bins over [low, high]; what lies outside counts in the first and last.
std::vector<double> shares_of(const Plane<float>& values, double low, double high) {
  std::vector<double> shares(kBins, 0.0);
  const double width = std::max(high - low, 1e-9) / kBins;
  for (const float v : values.pixels())
    shares[static_cast<std::size_t>(std::clamp(static_cast<int>((v - low) / width), 0, kBins - 1))] +=
        1 / static_cast<double>(values.size());
  return shares;
}

/// Cumulative distribution at the upper ends of the bins.
std::vector<double> cumulated(std::vector<double> shares) {
  for (std::size_t i = 1; i < shares.size(); ++i) shares[i] += shares[i - 1];
  return shares;
}

/// The cumulative distribution of the histogram as a curve, linear inside a bin: from log luminance to luma.
Plane<float> equalised(const Plane<float>& log_luminance, const std::vector<double>& cumulative, double low,
                       double high) {
  Plane<float> luma(log_luminance.width(), log_luminance.height());
  const double width = std::max(high - low, 1e-9) / kBins;
  for (std::size_t i = 0; i < luma.size(); ++i) {
    const double place = std::clamp((log_luminance.pixels()[i] - low) / width, 0.0, kBins - 1e-6);
    const auto bin = static_cast<std::size_t>(place);
    const double before = bin == 0 ? 0 : cumulative[bin - 1];
    luma.pixels()[i] = static_cast<float>(before + (place - std::floor(place)) * (cumulative[bin] - before));
  }
  return luma;
}

/// Largest distance of a cumulative distribution from that of an even one.
double unevenness(const std::vector<double>& cumulative) {
  double largest = 0;
  for (std::size_t i = 0; i < cumulative.size(); ++i)
    largest = std::max(largest, std::abs(cumulative[i] - static_cast<double>(i + 1) / kBins));
  return largest;
}

DisplayImage coloured(const SceneImage& scene, const Plane<float>& luma) {
  DisplayImage image(scene.width(), scene.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb colour = scene.pixels()[i];
    const float scale = 1 / std::max(luminance(colour), 1e-30f);
    const auto encoded = [&](float channel) {
      return std::clamp(std::pow(std::max(0.0f, channel * scale), 1 / 2.2f) * luma.pixels()[i], 0.0f, 1.0f);
    };
    image.pixels()[i] = {encoded(colour.r), encoded(colour.g), encoded(colour.b)};
  }
  return image;
}

/// A view before and after.
struct Equalisation {
  std::vector<double> before, after;  ///< shares by bin
  double uneven_before = 0, uneven_after = 0;
  DisplayImage image;
};

Equalisation equalise(const SectionView& view) {
  const auto [low, high] =
      std::minmax_element(view.log_luminance.pixels().begin(), view.log_luminance.pixels().end());
  Equalisation e;
  e.before = shares_of(view.log_luminance, *low, *high);
  const std::vector<double> cumulative = cumulated(e.before);
  const Plane<float> luma = equalised(view.log_luminance, cumulative, *low, *high);
  e.after = shares_of(luma, 0, 1);
  e.uneven_before = unevenness(cumulative);
  e.uneven_after = unevenness(cumulated(e.after));
  e.image = coloured(*view.data.colour, luma);
  return e;
}

PlotSeries series_of(const std::string& title, const std::vector<double>& values, double scale) {
  PlotSeries series{.title = title, .style = PlotSeries::Style::kLines, .points = {}};
  for (std::size_t i = 0; i < values.size(); ++i)
    series.points.push_back({.x = (static_cast<double>(i) + 0.5) / kBins, .y = scale * values[i]});
  return series;
}

ReportPlot plot_of(const std::string& what, const std::vector<double>& shares, const std::string& axis) {
  Plot plot;
  plot.x = {.title = axis, .minimum = 0, .maximum = 1};
  plot.y = {.title = "Share", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  plot.series = {
      series_of("Pixels, largest bin = 1", shares, 1 / *std::max_element(shares.begin(), shares.end())),
      series_of("Cumulative", cumulated(shares), 1)};
  return {plot, what, "Histogram and cumulative distribution"};
}

}  // namespace

ReproductionResult reproduce_equalisation(Laboratory& laboratory) {
  const SectionScene scene(laboratory, "cellar");
  const SectionView view = scene.view(scene.middle());
  Equalisation e = equalise(view);
  ReproductionResult result;
  result.paper_shows =
      "Figure 4: an image before and after histogram equalisation, with histograms and cumulative "
      "distributions: "
      "afterwards the latter is nearly a straight line.";
  result.ours_shows = fmt::format(
      "{}, key view {}: the cumulative distribution of log luminance leaves the straight line by up to "
      "{:.2f}; "
      "with itself as the curve by up to {:.3f} ({} bins).",
      scene.title(), view.name, e.uneven_before, e.uneven_after, kBins);
  result.differs =
      e.uneven_after < e.uneven_before / 4
          ? "They agree. What it does to contrast is why histogram adjustment bounds the slope (figure 5)."
          : "They differ: too many pixels of this view are alike to be spread evenly.";
  const Columns columns{{"scene", scene.id()}};
  result.rows.add({"unevenness_before", e.uneven_before, "1", columns});
  result.rows.add({"unevenness_after", e.uneven_after, "1", columns});
  result.add_plot("before", plot_of("Before equalisation", e.before, "Log luminance, least to largest"));
  result.add_plot("after", plot_of("After equalisation", e.after, "Luma"));
  ImageComparison comparison{
      fmt::format("{}, key view {}", scene.title(), view.name), "A view mapped linearly and equalised", {}};
  comparison.images = {{"Linear, 99th percentile at white",
                        expose(*view.data.colour, static_cast<float>(std::pow(10, -view.log_p99)))},
                       {"Equalised", std::move(e.image)}};
  result.add_comparison("views", std::move(comparison));
  return result;
}

}  // namespace plenolab
