// A-T7, thesis section 5.2: mapping the synthesised view is free of inconsistency inside the view;
// interpolating statistics instead of results changes little for Reinhard 2005.
#include <fmt/format.h>

#include <cmath>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/claim_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_t7(Laboratory& laboratory);

namespace {

constexpr const char* kScenes[] = {"cellar", "dunes", "dominoes", "desk"};

/// What "changes little" means: five steps of an 8-bit display, mean over the view.
constexpr double kLittle = 5 * kSmallestStep;

/// Without adaptation in time, so that only the interpolation differs.
Mapping at_once(Mapping mapping) {
  mapping.adaptation.time_constant_s = 0;
  return mapping;
}

std::vector<DisplayImage> frames_of(MappingBench& bench, const std::string& scene, Shown shown) {
  return bench.frames(scene, at_once(mapping_for(bench, scene, shown)), bench.views_in_cells(scene));
}

double mean_difference(const DisplayImage& a, const DisplayImage& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const Rgb &p = a.pixels()[n], &q = b.pixels()[n];
    sum += static_cast<double>(std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b)) / 3;
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace

ReproductionResult reproduce_claim_t7(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  const std::uint64_t seed = laboratory.options().seed;
  std::vector<double> differences, steps;
  std::vector<MeasuredNumber> by_scene;
  for (const char* scene : kScenes) {
    const auto statistics = frames_of(bench, scene, Shown::kReinhardStatistics),
               results = frames_of(bench, scene, Shown::kReinhardResults);
    std::vector<double> own;
    for (std::size_t i = 0; i < statistics.size(); ++i)
      own.push_back(mean_difference(statistics[i], results[i]));
    by_scene.push_back({laboratory.scene(scene).title, mean_interval(own, seed, kViewsInCell)});
    differences.insert(differences.end(), own.begin(), own.end());
    const auto inconsistencies =
        frame_inconsistencies(bench, scene, at_once(mapping_for(bench, scene, Shown::kReinhardStatistics)),
                              mapping_for(bench, scene, Shown::kReinhardJoint), bench.views_in_cells(scene));
    for (const double step : border_steps(inconsistencies)) steps.push_back(step);
  }
  const auto difference = mean_interval(differences, seed, kViewsInCell),
             step = mean_interval(steps, seed, kViewsInCell);
  result.paper_shows =
      "Section 5.2: mapped as a whole, a synthesised view is consistent in itself whatever the operator; for "
      "Reinhard 2005 interpolating the statistics of the key views instead of the results differs little "
      "enough to be used instead.";
  result.ours_shows = fmt::format(
      "Steps of luma across borders of visibility in views of four scenes mapped after synthesis: {}. Mean "
      "difference of interpolated statistics from interpolated results: {}.",
      text_of(step), text_of(difference));
  add_measured(result, "Interpolated statistics against interpolated results, without adaptation in time",
               "mean_difference", "encoded", by_scene);
  const std::vector<std::string> scenes(std::begin(kScenes), std::end(kScenes));
  const std::string uncertainty =
      uncertainty_over(steps.size(), "views within the cells of all scenes", kViewsInCell);
  add_claim(result,
            {"A-T7a", "Altmeier 2018, section 5.2",
             "Views mapped after synthesis are free of inconsistency inside the view."},
            {step, Comparison::kBelow, kSmallestStep, "border_step", "luma", uncertainty, scenes,
             "Beyond the same operator with one fit for all key views, applied to the same frame. Holds by "
             "construction for an operator whose curve is one for the whole frame, as here: it checks that "
             "nothing else adds steps."});
  add_claim(
      result,
      {"A-T7b", "Altmeier 2018, section 5.2.2",
       "Interpolating statistics instead of results changes little for Reinhard 2005."},
      {difference, Comparison::kBelow, kLittle, "mean_difference", "encoded", uncertainty, scenes,
       "Mean absolute difference of the encoded channels; little means less than five steps of an 8-bit "
       "display, as the brightness of a whole view is hard to compare. In still views within the cells; in "
       "motion the "
       "two differ more where light appears, see figures 43 and 44."});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
