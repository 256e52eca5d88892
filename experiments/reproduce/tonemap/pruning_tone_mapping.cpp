#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/tonemap/bilateral.h"
#include "core/tonemap/histogram_adjustment.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/reproduce/pruning_outcome.h"
#include "experiments/score.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

ReproductionResult reproduce_pruning_tone_mapping(Laboratory& laboratory);

namespace {

constexpr int kRuns = 5;

/// A view to map, and whether it was made up here because no scene is like it.
struct Stimulus {
  std::string name;
  OperatorView view;
};

/// Blocks of 8 × 8 px whose log luminance is spread evenly over `decades` below 1000, with fine texture.
/// Disparity is 6 px everywhere.
Stimulus made_up(const std::string& name, int width, double decades, bool colourless) {
  const int height = width * 9 / 16;
  SceneImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint64_t block = static_cast<std::uint64_t>(y / 8 * width + x / 8);
      const std::uint64_t pixel = static_cast<std::uint64_t>(y * width + x);
      const double log = 3 - decades * (0.95 * unit_double(random_u64(5, 1, block)) +
                                        0.05 * unit_double(random_u64(5, 2, pixel)));
      const float level = static_cast<float>(std::pow(10.0, log));
      image.at(x, y) = colourless ? Rgb{level, level, level} : Rgb{level, level * 0.9f, level * 0.7f};
    }
  return {name + " (made up)",
          {std::make_shared<const SceneImage>(std::move(image)),
           std::make_shared<const DisparityMap>(width, height, 6.0f)}};
}

/// The enhanced bilateral operator, its parameters fitted beforehand.
PruningOutcome prune_bilateral(const Stimulus& s, int threads) {
  BilateralToneOptions options{.enhanced = true};
  const double floor = log_floor(measure_view(*s.view.colour, threads));
  const BaseHistogram bases =
      measure_base(bilateral_layers(options, *s.view.colour, s.view.disparity.get(), floor, threads));
  BilateralToneParameters p = fit(options, range_of(bases, options.outliers), floor);
  PruningOutcome outcome{.part = "bilateral, enhanced", .stimulus = s.name, .stages = {}};
  const auto [pruned, full] = time_by_turns(
      outcome,
      [&](bool prune) {
        p.options.prune = prune;
        return apply(p, *s.view.colour, s.view.disparity.get(), threads);
      },
      kRuns);
  outcome.equal = pruned.image == full.image && pruned.counts == full.counts;
  const auto [near, far] =
      std::minmax_element(s.view.disparity->pixels().begin(), s.view.disparity->pixels().end());
  if (p.compression == 1 && p.foreground_scale == 0)
    outcome.stages = {{"base layer", "compression 1: base and detail add up to the luminance"}};
  else if (*near == *far)
    outcome.stages = {
        {"depth weights and foreground layer",
         fmt::format("every disparity is {:g} px: no depth edges", static_cast<double>(*near))}};
  return outcome;
}

/// Histogram adjustment of one view: as the table of operators does it, and measuring the histogram in any
/// case.
PruningOutcome prune_histogram(const Stimulus& s, int threads) {
  PruningOutcome outcome{.part = "histogram adjustment", .stimulus = s.name, .stages = {}};
  const FitScope scope = scope_of_image(s.view, threads);
  const double log_min = scope.statistics.log_min, log_max = scope.statistics.log_max;
  const HistogramOptions options;
  const auto [pruned, full] = time_by_turns(
      outcome,
      [&](bool prune) {
        if (prune) return find_operator("histogram").fit("naive", {}, scope).apply(s.view, threads);
        const LogHistogram histogram =
            measure_histogram(*s.view.colour, scope.floor, log_min, log_max, options.bins, threads);
        return apply(fit(options, histogram, scope.floor), *s.view.colour, threads);
      },
      kRuns);
  outcome.equal = pruned.image == full.image && pruned.counts == full.counts;
  if (fits_display(options, log_min, log_max))
    outcome.stages = {
        {"histogram", fmt::format("a range of {:.2f} log10 units fits the display", log_max - log_min)}};
  return outcome;
}

/// Whether all pixels have equal channels.
bool is_colourless(const SceneImage& image) {
  return std::all_of(image.pixels().begin(), image.pixels().end(),
                     [](Rgb c) { return c.r == c.g && c.g == c.b; });
}

/// The colour ratio alone, on a luma of one half.
PruningOutcome prune_colour(const Stimulus& s) {
  PruningOutcome outcome{.part = "colour ratio", .stimulus = s.name, .stages = {}};
  const SceneImage& image = *s.view.colour;
  const std::vector<float> luma(image.size(), 0.5f);
  const auto [pruned, full] = time_by_turns(
      outcome,
      [&](bool prune) {
        std::vector<Rgb> out(image.size());
        apply_colour_ratio({image.row(0), image.size()}, luma, kColourExponent, out, prune);
        return out;
      },
      kRuns);
  outcome.equal = pruned == full;
  if (is_colourless(image))
    outcome.stages = {{"two of three powers", "every pixel has equal channels: one is evaluated for all"}};
  return outcome;
}

/// What scenes hold, so that it can be seen that they need every stage.
void add_need(ReportTable& table, ResultTable& rows, const std::string& id, const Stimulus& s, int threads) {
  const FitScope scope = scope_of_image(s.view, threads);
  const auto [far, near] =
      std::minmax_element(s.view.disparity->pixels().begin(), s.view.disparity->pixels().end());
  const auto& pixels = s.view.colour->pixels();
  const double grey = static_cast<double>(std::count_if(pixels.begin(), pixels.end(),
                                                        [](Rgb c) { return c.r == c.g && c.g == c.b; })) /
                      static_cast<double>(pixels.size());
  const double range = scope.statistics.log_max - scope.statistics.log_min;
  const double disparity_range = static_cast<double>(*near - *far);
  table.rows.push_back({id, disparity_range, range, 100 * grey});
  const Columns columns{{"scene", id}};
  rows.add({"disparity_range", disparity_range, "px", columns});
  rows.add({"luminance_range", range, "log10", columns});
  rows.add({"colourless_share", grey, "1", columns});
}

/// Operators whose joint variant maps four equal key views exactly as the naive one.
std::string equal_views_sentence(const Stimulus& s, ResultTable& rows, int threads) {
  const ViewGrid grid{2, 2, 0.1, 0.1, s.view.colour->width(), s.view.colour->height(), 60};
  const LightField field =
      LightField::from_views(grid, RadianceUnit::kCdM2, "equal views",
                             {4, KeyView<SceneReferred>{*s.view.colour, *s.view.disparity}});
  const LightFieldStatistics statistics = measure_light_field(field, threads);
  std::vector<std::string> equal, different;
  for (const char* id : {"histogram", "reinhard05", "reinhard02", "robust"}) {
    const auto mapped = [&](const char* variant) {
      std::vector<DisplayImage> views;
      map_light_field(
          find_operator(id), variant, {}, field, statistics,
          [&](int, int, const ToneMapped& m, const FittedOperator&) { views.push_back(m.image); }, threads);
      return views;
    };
    const bool same = mapped("joint") == mapped("naive");
    (same ? equal : different).push_back(id);
    rows.add({"joint_equals_naive", same ? 1.0 : 0.0, "1", {{"operator", std::string(id)}}});
  }
  const auto list = [](const std::vector<std::string>& ids) {
    return ids.empty() ? std::string("none") : fmt::format("{}", fmt::join(ids, ", "));
  };
  return fmt::format(
      "Where all key views are equal, the joint variant maps them bit by bit as the naive one for: {}; not "
      "for: {} (sums over more pixels round differently). Nothing is left out for it: equal statistics do "
      "not "
      "prove equal views.",
      list(equal), list(different));
}

std::vector<Stimulus> scene_stimuli(Laboratory& laboratory) {
  std::vector<Stimulus> stimuli;
  for (const SceneEntry& entry : scenes()) {
    const std::string id = entry.id;
    const LightField field = laboratory.light_field(id);
    stimuli.push_back({id, operator_view(field, field.grid().columns / 2, field.grid().rows / 2)});
  }
  return stimuli;
}

}  // namespace

ReproductionResult reproduce_pruning_tone_mapping(Laboratory& laboratory) {
  const int threads = laboratory.options().threads;
  const int width = laboratory.scaled({1, 1, 1, 1, 480, 270, 60}).width;
  ReproductionResult result;
  std::vector<PruningOutcome> outcomes;
  const Stimulus flat = made_up("plane without depth edges, 5 decades", width, 5, false);
  outcomes.push_back(prune_bilateral(flat, threads));
  outcomes.push_back(prune_bilateral(made_up("plane, 0.6 decades", width, 0.6, false), threads));
  outcomes.push_back(prune_histogram(made_up("plane, 2 decades", width, 2, false), threads));
  outcomes.push_back(prune_colour(made_up("colourless plane, 5 decades", width, 5, true)));
  ReportTable needs{
      "What the middle key views of the scenes hold: depth edges, more range than the display's 3 "
      "log10 units, and colour, so that they need every stage",
      {"scene", "range of disparity [px]", "range of luminance [log10]", "colourless pixels [%]"},
      {}};
  needs.digits = 3;
  for (const Stimulus& s : scene_stimuli(laboratory)) {
    add_need(needs, result.rows, s.name, s, threads);
    outcomes.push_back(prune_histogram(s, threads));
    outcomes.push_back(prune_colour(s));
  }
  for (const PruningOutcome& o : outcomes) add_outcome_rows(result.rows, o);
  const auto equal =
      std::count_if(outcomes.begin(), outcomes.end(), [](const PruningOutcome& o) { return o.equal; });
  const auto left_out = std::count_if(outcomes.begin(), outcomes.end(),
                                      [](const PruningOutcome& o) { return !o.stages.empty(); });
  result.ours_shows = fmt::format(
      "Tone mapping leaves out what cannot change its result: {} of {} results had something left out, and "
      "{} are "
      "equal bit by bit with and without. {}",
      left_out, outcomes.size(), equal, equal_views_sentence(flat, result.rows, threads));
  result.add_table(savings_table(outcomes));
  result.add_table(reasons_table(outcomes));
  result.add_table(std::move(needs));
  return result;
}

}  // namespace plenolab
