// A-T14, thesis section 5.2.2: under fast motion interpolating statistics with adaptation in time is more
// consistent than interpolating results.
#include <fmt/format.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/claim_tools.h"
#include "experiments/reproduce/tonemap/motion_measures.h"

namespace plenolab {

ReproductionResult reproduce_claim_t14(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "cellar";
constexpr int kSpeeds[] = {1, 2, 4, 8};

std::vector<double> steps_at(MappingBench& bench, const Mapping& mapping, int speed) {
  std::vector<double> steps;
  for (int line = 0; line < kMotionLines; ++line)
    steps.push_back(largest_step(bench.show(kScene, faster(bench.recording(kScene, line), speed), mapping)));
  return steps;
}

}  // namespace

ReproductionResult reproduce_claim_t14(Laboratory& laboratory) {
  ReproductionResult result;
  MappingBench& bench = laboratory.mapping_bench();
  const std::uint64_t seed = laboratory.options().seed;
  const Mapping statistics = mapping_for(bench, kScene, Shown::kReinhardStatistics),
                results = mapping_for(bench, kScene, Shown::kReinhardResults);
  PlotSeries series[] = {{.title = results.label, .points = {}}, {.title = statistics.label, .points = {}}};
  std::optional<Interval> fastest, slowest;
  for (const int speed : kSpeeds) {
    const auto of_results = steps_at(bench, results, speed),
               of_statistics = steps_at(bench, statistics, speed);
    fastest = mean_ratio(of_statistics, of_results, seed);
    if (!slowest) slowest = fastest;
    for (const auto& [steps, line] : {std::pair{&of_results, &series[0]}, {&of_statistics, &series[1]}}) {
      const Interval interval = *mean_interval(*steps, seed);
      line->points.push_back(plot_point(speed, interval));
      result.rows.add({"largest_frame_step",
                       interval.estimate,
                       "luma",
                       {{"mapping", line->title}, {"speed", static_cast<long long>(speed)}}});
    }
  }
  result.paper_shows =
      "Section 5.2.2: interpolating statistics and adapting them in time improves the behaviour for rapid "
      "camera "
      "motion over interpolating the results of the key views' mappings.";
  result.ours_shows = fmt::format(
      "Largest change of brightness from one frame to the next over the Cellar, statistics interpolated over "
      "results "
      "interpolated: {} at three spacings a second, {} at eight times that speed.",
      text_of(slowest), text_of(fastest));
  Plot plot;
  plot.x = {.title = "Speed", .unit = "times three spacings a second", .logarithmic = true};
  plot.y = {.title = "Largest change between frames", .unit = "luma", .minimum = 0};
  plot.key = KeyPosition::kTopLeft;
  plot.series = {series[0], series[1]};
  result.add_plot("step-by-speed", {plot,
                                    "Largest change of brightness between frames against the speed of the "
                                    "camera. Bars: 95 % intervals over the lines of motion",
                                    "Change of brightness of two ways to interpolate against camera speed"});
  add_claim(
      result,
      {"A-T14", "Altmeier 2018, section 5.2.2",
       "Under fast motion interpolating statistics with adaptation in time is more consistent than "
       "interpolating "
       "results."},
      {fastest,
       Comparison::kBelow,
       1,
       "largest_frame_step_ratio",
       "1",
       uncertainty_over(kMotionLines, "lines of motion"),
       {kScene},
       "Largest change of brightness between frames at 24 spacings a second (30 frames a second), statistics "
       "interpolated over results interpolated."});
  result.differs = outcome_words(result);
  return result;
}

}  // namespace plenolab
