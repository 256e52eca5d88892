// A-T4, thesis section 5.1.5: naive Reinhard 2005 differs strongly between neighbouring key views where the
// sun is hidden in one of them or outliers decide the extremes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  for (const char* scene : kScenes) {
    const SceneSpread spread = measure_spread(bench, scene);
    for (const bool source : {true, false}) {
      const std::vector<PairChange> pairs = pairs_with_source(spread.pairs, source);
      if (pairs.empty()) continue;
      numbers.push_back({fmt::format("{}, {} pairs, {}", spread.title, pairs.size(),
                                     source ? "a light source appears or is hidden" : "same light sources"),
                         mean_interval(brightness_changes(pairs), seed)});
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
  const auto cellar = find("Cellar", "hidden"), desk = find("Desk", "sources");
  result.paper_shows =
      "Section 5.1.5 and figure 28: mapped one by one, neighbouring key views differ noticeably, where the "
      "sun is hidden in one of them, and also where no light changes but outliers decide the extremes.";
  result.ours_shows = fmt::format(
      "Mean change of luma of surfaces under the same light from one key view to its neighbour: {} in the "
      "Cellar where the sun appears or is hidden between them, {} on the Desk, whose brightest highlights "
      "differ from view to view.",
      text_of(cellar), text_of(desk));
  add_measured(result, "Change of brightness between neighbouring key views, naive Reinhard 2005",
               "neighbour_luma_change", "luma", numbers);
  result.add_table(std::move(spreads));
  const std::string uncertainty = "95 % interval over pairs of neighbouring key views, which share their sun";
  add_claim(result,
            {"A-T4a", "Altmeier 2018, section 5.1.5",
             "Naive Reinhard 2005 differs strongly between key views between which the sun is hidden."},
            {cellar,
             Comparison::kAbove,
             kStrong,
             "neighbour_luma_change",
             "luma",
             uncertainty,
             {"cellar"},
             "Mean over the surfaces that both views show under the same light; strong means more than five "
             "steps of an 8-bit display."});
  add_claim(
      result,
      {"A-T4b", "Altmeier 2018, section 5.1.5",
       "Naive Reinhard 2005 differs noticeably between key views whose outliers differ."},
      {desk,
       Comparison::kAbove,
       kSmallestStep,
       "neighbour_luma_change",
       "luma",
       uncertainty,
       {"desk"},
       "The same on the Desk, between views with the same light sources; noticeable means more than one "
       "step of an 8-bit display."});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
