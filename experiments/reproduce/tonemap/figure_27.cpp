// Figure 27 (section 5.1.4): histogram adjustment with several numbers of trimming passes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/image/colour.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/trimming_consistency.h"
#include "experiments/score.h"

namespace plenolab {

ReproductionResult reproduce_numbers_of_trimmings(Laboratory& laboratory);

namespace {

constexpr std::array kCeilings{HistogramCeiling::kPerceptual, HistogramCeiling::kAsPrinted};
constexpr std::array kFixedPasses{1, 2, 4, 8};

/// A view mapped with a number of passes.
struct TrimmedView {
  std::optional<int> fixed;  ///< number asked for; absent: automatic
  std::size_t passes = 0;    ///< that were made
  bool linear = false;
  DisplayImage image;
  double mean = 0, deviation = 0;  ///< of luma
};

TrimmedView map_view(HistogramOptions options, const ToneScene& scene, std::size_t index, int threads) {
  const LogHistogram histogram = histogram_of_view(scene, index, options.bins, threads);
  const HistogramParameters p = fit(options, histogram, scene.statistics.floor);
  TrimmedView view{.fixed = options.fixed_passes,
                   .passes = p.passes.size(),
                   .linear = p.linear,
                   .image = apply(p, *scene.view(index).colour, threads).image};
  double sum = 0, squares = 0;
  for (const Rgb& c : view.image.pixels()) {
    const auto luma = static_cast<double>(luminance(c));
    sum += luma, squares += luma * luma;
  }
  const auto n = static_cast<double>(view.image.size());
  view.mean = sum / n;
  view.deviation = std::sqrt(std::max(0.0, squares / n - view.mean * view.mean));
  return view;
}

std::vector<TrimmedView> map_views(HistogramCeiling ceiling, const ToneScene& scene, int threads) {
  const std::size_t middle = middle_view(scene.field.grid());
  std::vector<TrimmedView> views;
  HistogramOptions options{.ceiling = ceiling};
  for (const int passes : kFixedPasses) {
    options.fixed_passes = passes;
    views.push_back(map_view(options, scene, middle, threads));
  }
  options.fixed_passes = std::nullopt;
  views.push_back(map_view(options, scene, middle, threads));
  return views;
}

std::string label_of(const TrimmedView& view) {
  if (!view.fixed) return "automatic";
  return fmt::format("{} {}", *view.fixed, *view.fixed == 1 ? "pass" : "passes");
}

void add_views(ReproductionResult& result, const ToneScene& scene, const std::string& ceiling,
               const std::vector<TrimmedView>& views, ReportTable& table) {
  ImageComparison comparison{
      fmt::format("{}, key view {}: ceiling {}", scene.title,
                  view_name(scene.field.grid(), middle_view(scene.field.grid())), ceiling),
      "The same view after several numbers of trimming passes",
      {}};
  for (const TrimmedView& view : views) {
    comparison.images.push_back({label_of(view), view.image});
    const Columns columns{{"ceiling", ceiling}, {"passes", label_of(view)}};
    result.rows.add({"passes_made", static_cast<double>(view.passes), "passes", columns});
    result.rows.add({"linear", view.linear ? 1.0 : 0.0, "1", columns});
    result.rows.add({"mean_luma", view.mean, "luma", columns});
    result.rows.add({"luma_standard_deviation", view.deviation, "luma", columns});
    table.rows.push_back({ceiling, label_of(view), static_cast<long long>(view.passes),
                          std::string(view.linear ? "linear" : "histogram"), view.mean, view.deviation});
  }
  std::string name = "cellar-" + ceiling;
  std::replace(name.begin(), name.end(), ' ', '-');
  result.add_comparison(name, std::move(comparison));
}

/// "mean luma goes from 0.50 after 1 pass to 0.40 after 8 …"
std::string change_text(const std::string& ceiling, const std::vector<TrimmedView>& views) {
  const TrimmedView &first = views.front(), &last = views[kFixedPasses.size() - 1], &automatic = views.back();
  const std::string end = fmt::format("after {}{}", last.passes, last.linear ? ", by then linear" : "");
  return fmt::format(
      "Ceiling {}: mean luma goes from {:.3f} after 1 pass to {:.3f} {}, its standard deviation from {:.3f} "
      "to "
      "{:.3f}; the rule stops after {} ({:.3f}{}). ",
      ceiling, first.mean, last.mean, end, first.deviation, last.deviation, automatic.passes, automatic.mean,
      automatic.linear ? ", linear" : "");
}

/// Largest difference of mean luma between consecutive numbers of passes of the list.
double largest_step(const std::vector<TrimmedView>& views) {
  double largest = 0;
  for (std::size_t i = 1; i < kFixedPasses.size(); ++i)
    largest = std::max(largest, std::abs(views[i].mean - views[i - 1].mean));
  return largest;
}

}  // namespace

ReproductionResult reproduce_numbers_of_trimmings(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 27 shows a key view of the Cellar after different numbers of trimmings, with noticeable "
      "differences between them.";
  const ToneScene scene = tone_scene(laboratory, "cellar");
  ReportTable table{"Luma of the key view",
                    {"ceiling", "passes", "made", "mapping", "mean luma", "standard deviation"},
                    {},
                    3};
  std::array<double, kCeilings.size()> steps{};
  std::optional<double> printed_linear;  // mean luma
  for (std::size_t i = 0; i < kCeilings.size(); ++i) {
    const auto views = map_views(kCeilings[i], scene, laboratory.options().threads);
    const std::string ceiling = name_of(kCeilings[i]);
    add_views(result, scene, ceiling, views, table);
    result.ours_shows += change_text(ceiling, views);
    steps[i] = largest_step(views);
    if (kCeilings[i] == HistogramCeiling::kAsPrinted && views.back().linear)
      printed_linear = views.back().mean;
  }
  const double visible = visible_luma_change();
  const auto verdict = [&](double step) { return step > visible ? "are noticeable" : "are hardly seen"; };
  result.differs = fmt::format(
      "With the ceiling that limits visible contrast to the scene's, differences between 1, 2, 4 and 8 "
      "passes {} "
      "(largest step of mean luma {:.3f}; {:.3f} is just visible); with the ratio as printed they {} "
      "({:.3f}).",
      verdict(steps[0]), steps[0], visible, verdict(steps[1]), steps[1]);
  if (printed_linear)
    result.differs += fmt::format(
        " As printed the view ends linear, with a mean luma of {:.3f}, while section 6.3 finds the Cellar's "
        "interior much too bright with this operator: the thesis' program can hardly have used the printed "
        "ratio.",
        *printed_linear);
  result.add_table(std::move(table));
  return result;
}

}  // namespace plenolab
