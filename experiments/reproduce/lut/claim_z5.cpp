// Z-5: how the cost of counting pixels grows with their number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/lut/counting_steps.h"
#include "experiments/reproduce/lut/lut_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_z5(Laboratory& laboratory);

namespace {

/// Exponent p of time ∝ pixels^p by least squares over the divisors.
double exponent(const std::vector<double>& seconds) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(seconds.size());
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const double x = -2 * std::log(kDivisors.at(i)), y = std::log(std::max(1e-12, seconds[i]));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double printed_exponent(const std::string& method) {
  std::vector<double> seconds;
  for (const int divisor : kDivisors) seconds.push_back(printed_time(method, divisor)->middle_s());
  return exponent(seconds);
}

/// Exponents of repeated rounds, by method.
struct Exponents {
  std::vector<double> one_by_one, vectorised;
};

Exponents measure(WalkBench& bench, const WalkFrame& frame) {
  constexpr int kRounds = 9;
  const std::vector<FrameStep> steps = counting_steps(bench, frame);
  Exponents all;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> one_by_one, vectorised;
    for (const FrameStep& step : steps) {
      const double seconds = timed_work(step)().front();
      if (step.method == kOneByOne) one_by_one.push_back(seconds);
      if (step.method == kVectorised) vectorised.push_back(seconds);
    }
    if (round == 0) continue;  // the caches are cold
    all.one_by_one.push_back(exponent(one_by_one));
    all.vectorised.push_back(exponent(vectorised));
  }
  return all;
}

}  // namespace

ReproductionResult reproduce_claim_z5(Laboratory& laboratory) {
  ReproductionResult result;
  WalkBench& bench = laboratory.walk_bench();
  const WalkFrame frame = timed_frame(bench, false);
  const double cpu = printed_exponent("CPU"), gpu = printed_exponent("GPU"), threshold = 0.5 * (cpu + gpu);
  const Exponents measured = measure(bench, frame);
  const auto interval = [&](const std::vector<double>& exponents) {
    return mean_interval(exponents, laboratory.options().seed).value_or(Interval{mean(exponents), -1e9, 1e9});
  };
  const Interval p = interval(measured.one_by_one), q = interval(measured.vectorised);
  for (const auto& [method, value] :
       {std::pair("one by one", p.estimate), std::pair("vectorised", q.estimate)})
    result.rows.add({"time_exponent", value, "1", {{"method", std::string(method)}}});
  for (const auto& [method, value] : {std::pair("CPU", cpu), std::pair("GPU", gpu)})
    result.rows.add({"time_exponent_printed", value, "1", {{"method", std::string(method)}}});
  Verdict verdict = decide_claim(p, Comparison::kAbove, threshold, "time_exponent", "1",
                                 uncertainty_over(measured.one_by_one.size(), "rounds"));
  verdict.scenes = {"walk"};
  verdict.explanation = fmt::format(
      "Time of counting pixel by pixel grows as pixels to the power of {}; the threshold lies half-way "
      "between the exponents of the printed times of CPU ({:.2f}) and GPU ({:.2f}).",
      interval_text(p), cpu, gpu);
  result.paper_shows =
      "Table 3 and its text: in the GPU method resolution is no bottleneck, in the CPU method it is.";
  result.ours_shows = fmt::format(
      "With time ∝ pixels^p over resolutions from {} × {} to ⅛ of it: p = {} pixel by pixel on one thread, "
      "{} "
      "vectorised; the printed times have {:.2f} (CPU) and {:.2f} (GPU).",
      frame.depth_m.width(), frame.depth_m.height(), interval_text(p), interval_text(q), cpu, gpu);
  result.differs =
      fmt::format("{} Pixels are not counted on a GPU here, so that the claim on it stays undecided.",
                  verdict.outcome == Outcome::kConfirmed
                      ? "The claim on the CPU is confirmed: its cost depends on the resolution."
                      : "The claim on the CPU is not confirmed.");
  conclude(result, {"Z-5a", lut_paper("table 3"), "The cost of counting pixels on the CPU grows with them."},
           std::move(verdict));
  conclude(result,
           {"Z-5b", lut_paper("table 3"), "The cost of counting pixels on the GPU hardly grows with them."},
           undecidable("Pixels are counted on the CPU here; there is no implementation for a GPU to time."));
  return result;
}

}  // namespace plenolab
