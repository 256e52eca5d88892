// D-4: what the estimates cost, and how that grows with samples and projectors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/timing.h"
#include "core/base/random.h"
#include "experiments/reproduce/luminance/luminance_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_d4(Laboratory& laboratory);

namespace {

constexpr double kFrame_s = 1.0 / 25;
constexpr double kFarMore = 10;  // times as long

/// Run times do not depend on what is shown: hashed luminances over six decades.
RayValues<float> any_luminance(const RayDisplay& display) {
  RayValues<float> values(display.size());
  const std::size_t count = display.size().total();
  float* v = values.column(0, 0);
  for (std::size_t i = 0; i < count; ++i) v[i] = 1e-2f + 1e4f * unit_float(mix64(i)) * unit_float(mix64(~i));
  return values;
}

struct Measured {
  std::string method;
  int samples = 0, projectors = 0;
  TimingSummary timing;
};

class Stop {
 public:
  Stop(LuminanceBench& bench, int runs) : bench_(bench), runs_(runs) {}

  Measured measure(LuminanceMethod method, const RayDisplay& display, const RayValues<float>& luminance,
                   int samples) {
    const LuminanceOptions options{.method = method, .threads = bench_.options().threads};
    return {
        name_of(method), samples, display.size().images,
        time_repeated([&] { estimate_luminance(display, luminance, samples_of(display, samples), options); },
                      {.runs = runs_})};
  }

 private:
  LuminanceBench& bench_;
  int runs_;
};

ProjectorDisplayOptions timed_display(LuminanceBench& bench, int divisor) {
  ProjectorDisplayOptions options = bench.options().effort == Effort::kTiny
                                        ? bench.display_options()
                                        : projector_display_options(DisplayPreset::kFull);
  options.projectors = std::max(1, options.projectors / divisor);
  return options;
}

std::vector<Measured> measure_all(LuminanceBench& bench) {
  std::vector<Measured> all;
  Stop stop(bench, 3);
  for (const int divisor : {4, 2, 1}) {
    const ProjectorDisplay display(timed_display(bench, divisor));
    const RayValues<float> luminance = any_luminance(display);
    for (const LuminanceMethod method :
         {LuminanceMethod::kBruteForce, LuminanceMethod::kAccumulative, LuminanceMethod::kSpread}) {
      if (divisor == 1)
        for (const int samples : {10, 100}) all.push_back(stop.measure(method, display, luminance, samples));
      all.push_back(stop.measure(method, display, luminance, 1000));
    }
  }
  return all;
}

/// Seconds of brute force with pinhole images of the display's own resolution.
double finest_brute_force_s(LuminanceBench& bench) {
  const ProjectorDisplay display(timed_display(bench, 1));
  const RayValues<float> luminance = any_luminance(display);
  const LuminanceOptions options{.method = LuminanceMethod::kBruteForce,
                                 .pinhole = display.resolution(),
                                 .threads = bench.options().threads};
  return time_repeated([&] { estimate_luminance(display, luminance, samples_of(display, 1000), options); },
                       {.runs = 1, .warm_up_runs = 0})
      .median_s;
}

/// Seconds of one sample by the letter: every projector asked for every pixel.
double literal_sample_s(LuminanceBench& bench) {
  const ProjectorDisplay display(timed_display(bench, 1));
  const RayValues<float> luminance = any_luminance(display);
  const LuminanceOptions options{.method = LuminanceMethod::kBruteForce};
  return time_repeated(
             [&] { estimate_luminance_literally(display, luminance, samples_of(display, 1), options); },
             {.runs = 1, .warm_up_runs = 0})
      .median_s;
}

const Measured& at(const std::vector<Measured>& all, LuminanceMethod method, int samples, int projectors) {
  return *std::find_if(all.begin(), all.end(), [&](const Measured& m) {
    return m.method == name_of(method) && m.samples == samples && m.projectors == projectors;
  });
}

ReportPlot time_plot(const std::vector<Measured>& all, int projectors) {
  Plot plot;
  plot.x = {.title = "Samples on the observers' line", .logarithmic = true};
  plot.y = {.title = "Time of an estimate", .unit = "s", .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  for (const LuminanceMethod method :
       {LuminanceMethod::kBruteForce, LuminanceMethod::kAccumulative, LuminanceMethod::kSpread}) {
    PlotSeries series{paper_name(method), PlotSeries::Style::kLinesPoints, {}};
    for (const Measured& m : all)
      if (m.method == name_of(method) && m.projectors == projectors)
        series.points.push_back(
            {static_cast<double>(m.samples), m.timing.median_s, m.timing.min_s, m.timing.max_s});
    plot.series.push_back(std::move(series));
  }
  return {plot, fmt::format("Time of an estimate over the number of samples, {} projectors", projectors),
          "BruteForce grows with the samples, Accumulative stays level."};
}

void add_times(ReproductionResult& result, const std::vector<Measured>& all) {
  ReportTable table{"Time of an estimate from luminances to samples, median of three runs",
                    {"method", "projectors", "samples", "seconds", "fastest", "slowest"},
                    {},
                    3};
  for (const Measured& m : all) {
    table.rows.push_back({m.method, static_cast<long long>(m.projectors), static_cast<long long>(m.samples),
                          m.timing.median_s, m.timing.min_s, m.timing.max_s});
    add_timing_rows(result.rows, m.timing,
                    {{"method", m.method},
                     {"projectors", static_cast<long long>(m.projectors)},
                     {"samples", static_cast<long long>(m.samples)}});
  }
  result.add_table(std::move(table));
}

}  // namespace

ReproductionResult reproduce_claim_d4(Laboratory& laboratory) {
  ReproductionResult result;
  LuminanceBench& bench = laboratory.luminance_bench();
  const std::vector<Measured> all = measure_all(bench);
  const int projectors = timed_display(bench, 1).projectors;
  result.add_plot("time-over-samples", time_plot(all, projectors));
  add_times(result, all);
  const TimingSummary& accumulated = at(all, LuminanceMethod::kAccumulative, 1000, projectors).timing;
  const TimingSummary& brute = at(all, LuminanceMethod::kBruteForce, 1000, projectors).timing;
  const TimingSummary& spread = at(all, LuminanceMethod::kSpread, 1000, projectors).timing;
  const double literal = 1000 * literal_sample_s(bench) / accumulated.median_s,
               finest = finest_brute_force_s(bench) / accumulated.median_s;
  const Interval seconds{accumulated.median_s, accumulated.min_s, accumulated.max_s},
      ratio{brute.median_s / accumulated.median_s, brute.min_s / accumulated.max_s,
            brute.max_s / accumulated.min_s};
  result.rows.add({"brute_force_over_accumulative", ratio.estimate, "1", {}});
  result.rows.add({"finest_brute_force_over_accumulative", finest, "1", {}});
  result.rows.add({"literal_brute_force_over_accumulative", literal, "1", {}});
  constexpr const char* kExtremes = "fastest and slowest of three runs each";
  Verdict real_time =
      decide_claim(seconds, Comparison::kBelow, kFrame_s, "seconds_accumulative", "s", kExtremes);
  Verdict far_more =
      decide_claim(ratio, Comparison::kAbove, kFarMore, "brute_force_over_accumulative", "1", kExtremes);
  result.paper_shows =
      "Sections 5 and 8: accumulation is light-weight and runs in real time on a GPU; brute force forms an "
      "image for each of 1000 samples. No times are printed.";
  const auto growth = [&](LuminanceMethod method, const TimingSummary& most) {
    return most.median_s / at(all, method, 100, projectors).timing.median_s;
  };
  result.ours_shows = fmt::format(
      "{} projectors of {} × {} px and 1000 samples on this CPU: Accumulative {:.3g} s, Spread {:.3g} s, "
      "BruteForce {:.3g} s with pinhole images of 256 × 144 px, {} times as long as Accumulative, and {:.1f} "
      "times with images of the display's own resolution. By the letter, every projector asked for every "
      "pixel, it takes {:.0f} times as long. From 100 to 1000 samples BruteForce takes {:.1f} times as long, "
      "Accumulative {:.1f} times.",
      projectors, timed_display(bench, 1).width, timed_display(bench, 1).height, accumulated.median_s,
      spread.median_s, brute.median_s, interval_text(ratio), finest, literal,
      growth(LuminanceMethod::kBruteForce, brute), growth(LuminanceMethod::kAccumulative, accumulated));
  result.differs = fmt::format(
      "Real time (25 frames a second): {}. Brute force at least {:g} times as long: {}. Ours asks only the "
      "projectors that reach an observer and takes no logarithm of single pixels, which brings brute force "
      "near the reading of all rays that accumulation cannot do without.",
      outcome_name(real_time.outcome), kFarMore, outcome_name(far_more.outcome));
  conclude_on(result, {}, {"D-4a", display_paper("section 8"), "Accumulation runs in real time."},
              std::move(real_time), result.ours_shows);
  conclude_on(result, {},
              {"D-4b", display_paper("sections 4 and 5"), "Brute force costs far more than accumulation."},
              std::move(far_more), result.ours_shows);
  return result;
}

}  // namespace plenolab
