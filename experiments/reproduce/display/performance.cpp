// Performance test 5.1 and claims H-11 and H-12: run time of reprojection against rendering every
// camera.
#include <fmt/format.h>

#include "analysis/timing.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/display/near_eye_tools.h"
#include "experiments/reproduce/figure_pictures.h"

namespace plenolab {

ReproductionResult reproduce_performance_test(Laboratory& laboratory);
ReproductionResult reproduce_claim_h11(Laboratory& laboratory);
ReproductionResult reproduce_claim_h12(Laboratory& laboratory);

namespace {

// Section 5.1, seconds a frame.
constexpr double kPrintedDirect_s = 0.0184, kPrintedSupersampled_s = 0.1870, kPrintedPlain_s = 0.1794;

using Recipe = NearEyeBench::Recipe;

std::string seconds_text(const std::vector<double>& seconds) {
  return fmt::format("{:.3f} s ({:.3f} to {:.3f})", median(seconds), quantile(seconds, 0),
                     quantile(seconds, 1));
}

/// Time of one step over that of two, each run of one beside a run of the other: medians.
struct StepTimes {
  double one_s = 0, two_s = 0;
};

StepTimes time_steps(NearEyeBench& bench, const std::string& id) {
  const CameraArray array = bench.array(id);
  const std::vector<RenderedCamera>& cameras = bench.cameras(id, 4);
  DisplayImage buffer;
  const auto seconds_of = [&](ReprojectionMethod method) {
    ReprojectionResult r =
        reproject(array, cameras, {.method = method, .threads = bench.threads()}, std::move(buffer));
    buffer = std::move(r.light_field);
    return std::vector{r.seconds};
  };
  const auto medians = medians_in_turn({[&] { return seconds_of(ReprojectionMethod::kOneStep); },
                                        [&] { return seconds_of(ReprojectionMethod::kTwoStep); }});
  return {medians[0][0], medians[1][0]};
}

}  // namespace

ReproductionResult reproduce_performance_test(Laboratory& laboratory) {
  ReproductionResult result;
  NearEyeBench& bench = laboratory.near_eye_bench();
  const NearEyeTimes times = times_side_by_side(bench);
  const auto& [super, plain] = times.reprojected;
  ReportTable table{"Seconds a light field of one eye: printed means, and ours (median of the five scenes)",
                    {"method", "printed", "ours", "ours, frames a second"},
                    {},
                    3};
  const auto add = [&](const std::string& method, double printed, const std::vector<double>& seconds) {
    table.rows.push_back({method, printed, median(seconds), 1 / median(seconds)});
    result.rows.add({"seconds_median", median(seconds), "s", {{"method", method}}});
    result.rows.add({"seconds_printed", printed, "s", {{"method", method}}});
  };
  add("reprojected, supersampled", kPrintedSupersampled_s, super);
  add("reprojected", kPrintedPlain_s, plain);
  add("every camera rendered, supersampled", kPrintedDirect_s, times.direct_supersampled);
  add("every camera rendered", kPrintedDirect_s, times.direct_plain);
  std::vector<double> reprojection;
  for (const std::string& id : bench.scene_ids())
    reprojection.push_back(bench.timing(id).supersampled.reprojection_s);
  result.rows.add({"seconds_reprojection_alone", median(reprojection), "s", {}});
  const double speed_up = median(times.direct_supersampled) / median(super);
  result.paper_shows =
      "Section 5.1: 0.187 s a frame with reprojection and supersampling, 0.179 s without, 0.0184 s with all "
      "120 cameras rendered (laptop GPU of 2011): reprojection loses by a factor of ten.";
  result.ours_shows = fmt::format(
      "On this machine's CPU, supersampled: {} reprojected, cameras and down-sampling included, against {} "
      "rendered, {:.1f} times as long. Without supersampling {} against {}. Reprojection alone takes {} "
      "({:.0f} light fields a second).",
      seconds_text(super), seconds_text(times.direct_supersampled), speed_up, seconds_text(plain),
      seconds_text(times.direct_plain), seconds_text(reprojection), 1 / median(reprojection));
  result.differs =
      speed_up > 1
          ? "They differ in who wins: here a ray tracer renders, whose pixels cost more than a rasteriser's, "
            "and pixels are sent to where they land instead of searched for along lines."
          : "They agree: reprojection loses.";
  result.add_table(std::move(table));
  result.key_figures.push_back(
      {"Reprojecting a light field for the near-eye display", format_number(1000 * median(reprojection), 3),
       "ms",
       fmt::format("{:.1f} times as fast as rendering every camera, rendering of the corners included",
                   speed_up)});
  return result;
}

ReproductionResult reproduce_claim_h11(Laboratory& laboratory) {
  ReproductionResult result;
  NearEyeBench& bench = laboratory.near_eye_bench();
  // Of pixels with a channel that differs by more than one code: what could still be called the same result.
  constexpr double kSame = 0.01;
  std::vector<double> differing, one_s, two_s, error_one, error_two;
  ReportTable table{"One step and two",
                    {"scene", "pixels that differ", "mean |VC − IC|, one step", "two steps",
                     "seconds, one step", "two steps"},
                    {},
                    3};
  const Recipe one{.method = ReprojectionMethod::kOneStep}, two{};
  for (const std::string& id : bench.scene_ids()) {
    const DisplayImage a = bench.image(id, one), b = bench.image(id, two);
    differing.push_back(share_beyond_codes(a, b, 1));
    error_one.push_back(mean_absolute(bench.truth(id), a)),
        error_two.push_back(mean_absolute(bench.truth(id), b));
    const StepTimes times = time_steps(bench, id);
    one_s.push_back(times.one_s), two_s.push_back(times.two_s);
    table.rows.push_back({bench.scene(id).scene.scene().title, percent(differing.back()), error_one.back(),
                          error_two.back(), one_s.back(), two_s.back()});
    result.rows.add({"share_differing", differing.back(), "1", {{"scene", id}}});
    for (const bool is_one : {true, false}) {
      const Columns columns{{"scene", id}, {"method", std::string(is_one ? "one-step" : "two-step")}};
      result.rows.add({"mean_difference", is_one ? error_one.back() : error_two.back(), "1", columns});
      result.rows.add({"seconds_reprojection", is_one ? one_s.back() : two_s.back(), "s", columns});
    }
  }
  const std::uint64_t seed = laboratory.options().seed;
  const Interval same = share_over_scenes(differing, seed), time = ratio_over_scenes(one_s, two_s, seed),
                 error = ratio_over_scenes(error_one, error_two, seed);
  Verdict equal = decide_claim(same, Comparison::kBelow, kSame, "share_differing", "1", kShareOverScenes);
  Verdict faster =
      decide_claim(time, Comparison::kBelow, 1, "time_one_over_two_steps", "1", kRatioOverScenes);
  result.paper_shows =
      "The paper on pixel reprojection: searching in one step along slanted lines gives what two steps give, "
      "and saves a pass.";
  result.ours_shows = fmt::format(
      "A share of {} of the pixels has a channel that differs by more than one code; one step has {} times "
      "the difference from the truth of two, and takes {} times as long.",
      interval_text(same), interval_text(error), interval_text(time));
  result.differs = outcome_text(equal.outcome) +
                   (faster.outcome == Outcome::kRefuted
                        ? " One step has four sources for every subimage where two steps have two."
                    : faster.outcome == Outcome::kConfirmed ? " One step saves time here."
                                                            : " The times do not tell them apart.");
  result.add_table(std::move(table));
  conclude_on_scenes(
      result, bench,
      {"H-11a", thesis("section 3.2") + "; Hansen, Klein & Kraus", "One step gives the result of two."},
      std::move(equal), result.ours_shows);
  conclude_on_scenes(
      result, bench,
      {"H-11b", thesis("section 3.2") + "; Hansen, Klein & Kraus", "One step takes less time than two."},
      std::move(faster), result.ours_shows);
  return result;
}

ReproductionResult reproduce_claim_h12(Laboratory& laboratory) {
  ReproductionResult result;
  NearEyeBench& bench = laboratory.near_eye_bench();
  // "Hardly": a tenth; printed are 4 %.
  constexpr double kHardly = 1.1;
  const auto [super, plain] = reprojected_times(bench);
  for (std::size_t s = 0; s < super.size(); ++s) {
    const Columns columns{{"scene", bench.scene_ids()[s]}};
    result.rows.add({"seconds_supersampled", super[s], "s", columns});
    result.rows.add({"seconds_plain", plain[s], "s", columns});
  }
  const Interval ratio = ratio_over_scenes(super, plain, laboratory.options().seed);
  Verdict verdict =
      decide_claim(ratio, Comparison::kBelow, kHardly, "time_supersampled_over_plain", "1", kRatioOverScenes);
  result.paper_shows = fmt::format(
      "Section 5.1: {:.4f} s a frame with supersampling against {:.4f} s without, a ratio of {:.3f}.",
      kPrintedSupersampled_s, kPrintedPlain_s, kPrintedSupersampled_s / kPrintedPlain_s);
  result.ours_shows = fmt::format(
      "With supersampling our light fields take {} times as long ({} against {}; medians of {} "
      "runs of each in turn, scene by scene).",
      interval_text(ratio), seconds_text(super), seconds_text(plain), NearEyeBench::kTimedRuns);
  result.differs = outcome_text(verdict.outcome) +
                   " Supersampling means four times the pixels; where time follows pixels, it costs time. "
                   "Equal times mean that something else than pixels took it.";
  result.rows.add({"time_supersampled_over_plain", ratio.estimate, "1", {}});
  conclude_on_scenes(result, bench, {"H-12", thesis("section 5.1"), "Supersampling hardly costs time."},
                     std::move(verdict), result.ours_shows);
  return result;
}

}  // namespace plenolab
