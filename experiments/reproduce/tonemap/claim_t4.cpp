// A-T4, thesis section 5.1.5: naive Reinhard 2005 differs strongly between neighbouring key views where the
// sun is hidden in one of them or outliers decide the extremes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/claim_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_t4(Laboratory& laboratory);

namespace {

/// What "strongly" means: five steps of an 8-bit display, for the mean over all surfaces under the same
/// light.
constexpr double kStrong = 5 * kSmallestStep;

constexpr const char* kScenes[] = {"cellar", "desk", "dominoes", "dunes"};

struct SceneSpread {
  std::string title;
  std::vector<PairChange> pairs;
  double contrast_range = 0;                ///< of m over the key views
  double lower_range = 0, upper_range = 0;  ///< of the limits of luma over the key views
};

double range_of_value(const std::vector<FitSummary>& fits, const std::string& name) {
  double low = 1e300, high = -1e300;
  for (const FitSummary& fit : fits)
    for (const FittedValue& value : fit.values)
      if (value.name == name) {
        low = std::min(low, value.value);
        high = std::max(high, value.value);
      }
  return high >= low ? high - low : 0;
}

SceneSpread measure_spread(MappingBench& bench, const std::string& scene) {
  const auto mapped = bench.key_views(scene, mapping_for(bench, scene, Shown::kReinhardNaive));
  const LightField field = bench.laboratory().light_field(scene);
  return {bench.laboratory().scene(scene).title,
          pair_changes(field, mapped->field, Neighbours::kBoth, bench.threads()),
          range_of_value(mapped->fits, "contrast"), range_of_value(mapped->fits, "luma_min"),
          range_of_value(mapped->fits, "luma_max")};
}

/// Those between which a light source appears or is hidden, or the others.
std::vector<PairChange> pairs_with_source(const std::vector<PairChange>& pairs, bool with) {
  std::vector<PairChange> chosen;
  for (const PairChange& pair : pairs)
    if ((std::abs(pair.log_peak_step) > kLightSourceStep_log10) == with) chosen.push_back(pair);
  return chosen;
}

}  // namespace

ReproductionResult reproduce_claim_t4(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  const std::uint64_t seed = laboratory.options().seed;
  std::vector<MeasuredNumber> numbers;
  ReportTable spreads{"Ranges of what naive Reinhard 2005 takes from each key view, largest less smallest",
                      {"scene", "contrast m", "lower limit [luma]", "upper limit [luma]"},
                      {},
                      3};
  std::vector<double> with_source;
  std::size_t desk_pairs = 0;
  for (const char* scene : kScenes) {
    const SceneSpread spread = measure_spread(bench, scene);
    for (const bool source : {true, false}) {
      const std::vector<PairChange> pairs = pairs_with_source(spread.pairs, source);
      if (pairs.empty()) continue;
      const std::vector<double> changes = brightness_changes(pairs);
      if (!source && std::string_view(scene) == "desk") desk_pairs = pairs.size();
      if (source) with_source.insert(with_source.end(), changes.begin(), changes.end());
      numbers.push_back({fmt::format("{}, {} pairs, {}", spread.title, pairs.size(),
                                     source ? "a light source appears or is hidden" : "same light sources"),
                         mean_interval(changes, seed)});
    }
    result.rows.add({"contrast_range", spread.contrast_range, "1", {{"scene", std::string(scene)}}});
    result.rows.add({"luma_min_range", spread.lower_range, "luma", {{"scene", std::string(scene)}}});
    result.rows.add({"luma_max_range", spread.upper_range, "luma", {{"scene", std::string(scene)}}});
    spreads.rows.push_back({spread.title, spread.contrast_range, spread.lower_range, spread.upper_range});
  }
  const auto find = [&](const std::string& start, const std::string& end) -> std::optional<Interval> {
    for (const MeasuredNumber& number : numbers)
      if (number.what.starts_with(start) && number.what.ends_with(end)) return number.interval;
    return std::nullopt;
  };
  const auto hidden = mean_interval(with_source, seed), desk = find("Desk", "sources");
  result.paper_shows =
      "Section 5.1.5 and figure 28: mapped one by one, neighbouring key views differ noticeably, where the "
      "sun is hidden in one of them, and also where no light changes but outliers decide the extremes.";
  result.ours_shows = fmt::format(
      "Mean change of luma of surfaces under the same light from one key view to its neighbour: {} where "
      "the sun appears or is hidden between them (strong: more than {:.4f}), {} on the Desk, whose brightest "
      "highlights differ from view to view (noticeable: more than {:.4f}). Means over all such pairs; figure "
      "28 "
      "shows the pairs that change most.",
      text_of(hidden), kStrong, text_of(desk), kSmallestStep);
  add_measured(result, "Change of brightness between neighbouring key views, naive Reinhard 2005",
               "neighbour_luma_change", "luma", numbers);
  result.add_table(std::move(spreads));
  add_claim(result,
            {"A-T4a", "Altmeier 2018, section 5.1.5",
             "Naive Reinhard 2005 differs strongly between key views between which the sun is hidden."},
            {hidden,
             Comparison::kAbove,
             kStrong,
             "neighbour_luma_change",
             "luma",
             uncertainty_over(with_source.size(), "pairs of neighbouring key views, which share two suns"),
             {"cellar", "dunes"},
             "Mean over the surfaces that both views show under the same light; strong means more than five "
             "steps of an 8-bit display. Pairs of the Dunes were added after a first look."});
  add_claim(
      result,
      {"A-T4b", "Altmeier 2018, section 5.1.5",
       "Naive Reinhard 2005 differs noticeably between key views whose outliers differ."},
      {desk,
       Comparison::kAbove,
       kSmallestStep,
       "neighbour_luma_change",
       "luma",
       uncertainty_over(desk_pairs, "pairs of neighbouring key views"),
       {"desk"},
       "The same on the Desk, between views with the same light sources; noticeable means more than one "
       "step of an 8-bit display."});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
