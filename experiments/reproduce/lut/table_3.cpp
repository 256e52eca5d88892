// Table 3: what counting pixels costs, beside the mixed image and what comes after the counting.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/reproduce/lut/counting_steps.h"
#include "experiments/reproduce/lut/lut_tools.h"

namespace plenolab {

ReproductionResult reproduce_counting_times(Laboratory& laboratory);

namespace {

struct TimedStep {
  FrameStep step;
  double seconds = 0;
};

std::vector<TimedStep> time_steps(WalkBench& bench, const WalkFrame& frame) {
  std::vector<FrameStep> steps = counting_steps(bench, frame);
  std::ranges::move(other_steps(bench, frame), std::back_inserter(steps));
  std::vector<StagedWork> works;
  for (const FrameStep& step : steps) works.push_back(timed_work(step));
  const auto medians = medians_in_turn(works, {.runs = 5, .warm_up_runs = 1});
  std::vector<TimedStep> all;
  for (std::size_t i = 0; i < steps.size(); ++i) all.push_back({steps[i], medians[i].front()});
  return all;
}

/// Of a step whose method begins like this; on several threads if there is such a step.
double seconds_of(const std::vector<TimedStep>& times, const std::string& method, int divisor = 1) {
  double seconds = 0;
  for (const TimedStep& time : times)
    if (time.step.method.starts_with(method) && time.step.divisor == divisor) seconds = time.seconds;
  return seconds;
}

/// Largest differences of a weight between counting every n-th pixel and every pixel, over some frames of the
/// walk, for the divisors above 1.
struct WeightErrors {
  std::array<double, kDivisors.size() - 1> largest{};
  std::size_t frames = 0;
};

WeightErrors weight_errors(WalkBench& bench) {
  const std::vector<Volume>& volumes = bench.stage().volumes();
  WeightErrors errors;
  for (const WalkPose& pose : walk_path(0.34)) {
    const WalkFrame f = surfaces_of_timed_size(bench, pose);
    const auto counted = [&](int stride) {
      const CountOptions options{stride, bench.options().threads};
      return pixel_weights(count_pixels(f.depth_m, f.pose.camera, volumes, options), volumes);
    };
    const VolumeWeights all = counted(1);
    for (std::size_t i = 0; i < errors.largest.size(); ++i) {
      const VolumeWeights some = counted(kDivisors.at(i + 1));
      for (std::size_t v = 0; v < volumes.size(); ++v)
        errors.largest.at(i) = std::max(errors.largest.at(i), std::abs(all.volumes[v] - some.volumes[v]));
    }
    ++errors.frames;
  }
  return errors;
}

std::string size_text(const WalkFrame& frame) {
  return fmt::format("{} × {}", frame.depth_m.width(), frame.depth_m.height());
}

/// Whether times can be set beside the printed ones.
bool has_printed_size(const WalkFrame& frame) {
  return frame.depth_m.width() == kPrintedWidth && frame.depth_m.height() == kPrintedHeight;
}

std::string range_text(const PrintedTime& time) {
  return time.low_s == time.high_s ? fmt::format("{:g}", time.low_s)
                                   : fmt::format("{:g}–{:g}", time.low_s, time.high_s);
}

void add_time_rows(ReproductionResult& result, const WalkFrame& frame, const std::vector<TimedStep>& times) {
  ReportTable table{
      fmt::format("Seconds a frame of {}, ours (medians) beside the printed ones", size_text(frame)),
      {"step", "of", "down-scale", "ours [s]", "printed [s]", "printed over ours"},
      {},
      3};
  for (const auto& [step, seconds] : times) {
    const PrintedTime* print =
        has_printed_size(frame) ? printed_time(step.printed_as, step.divisor) : nullptr;
    table.rows.push_back({step.method, step.what,
                          step.divisor == 1 ? std::string("1") : fmt::format("1/{}", step.divisor), seconds,
                          print ? range_text(*print) : std::string("–"),
                          print ? Cell(print->middle_s() / seconds) : Cell(std::string("–"))});
    const Columns columns{{"step", step.method},
                          {"divisor", static_cast<long long>(step.divisor)},
                          {"frame_size", size_text(frame)}};
    result.rows.add({"seconds_median", seconds, "s", columns});
    if (print) result.rows.add({"printed_over_ours", print->middle_s() / seconds, "1", columns});
  }
  result.add_table(std::move(table));
}

Plot time_plot(const WalkFrame& frame, const std::vector<TimedStep>& times) {
  Plot plot;
  plot.x = {.title = "Pixels counted", .unit = "", .logarithmic = true, .minimum = 1e3, .maximum = 1e7};
  plot.y = {.title = "Time a frame", .unit = "ms", .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  for (const char* method : {"CPU", "GPU"}) {
    PlotSeries series{fmt::format("printed, {}", method), PlotSeries::Style::kLinesPoints, {}};
    for (const int divisor : kDivisors) {
      const PrintedTime print = *printed_time(method, divisor);
      series.points.push_back({1.0 * kPrintedWidth * kPrintedHeight / (divisor * divisor),
                               1000 * print.middle_s(), 1000 * print.low_s, 1000 * print.high_s});
    }
    plot.series.push_back(std::move(series));
  }
  std::vector<std::string> methods;
  for (const TimedStep& time : times)
    if (time.step.method.starts_with("counting") && std::ranges::count(methods, time.step.method) == 0)
      methods.push_back(time.step.method);
  for (const std::string& method : methods) {
    PlotSeries series{fmt::format("ours, {}", method), PlotSeries::Style::kLinesPoints, {}};
    for (const TimedStep& time : times)
      if (time.step.method == method)
        series.points.push_back(
            {static_cast<double>(frame.depth_m.size()) / (time.step.divisor * time.step.divisor),
             1000 * time.seconds});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// What down-scaling costs in weights and saves in time, in words; adds the rows of the weights.
std::string down_scaling_text(ReproductionResult& result, WalkBench& bench, const WalkFrame& frame,
                              double saved_s, double after_s) {
  const WeightErrors errors = weight_errors(bench);
  for (std::size_t i = 0; i < errors.largest.size(); ++i)
    result.rows.add(
        {"largest_weight_error",
         errors.largest.at(i),
         "1",
         {{"divisor", static_cast<long long>(kDivisors.at(i + 1))}, {"frame_size", size_text(frame)}}});
  return fmt::format(
      "Down-scaling from {} by ½, ¼ and ⅛ changes a weight by up to {:.2g}, {:.2g} and {:.2g} over {} frames "
      "of our walk, and saves {} than the blending and grading cost that follow anyway.",
      size_text(frame), errors.largest[0], errors.largest[1], errors.largest[2], errors.frames,
      saved_s < after_s ? "less" : "more");
}

}  // namespace

ReproductionResult reproduce_counting_times(Laboratory& laboratory) {
  ReproductionResult result;
  WalkBench& bench = laboratory.walk_bench();
  const WalkFrame frame = timed_frame(bench, true);
  const std::vector<TimedStep> times = time_steps(bench, frame);
  add_time_rows(result, frame, times);
  const double fast = seconds_of(times, "counting, vectorised"), mixed = seconds_of(times, "mixed image"),
               after = seconds_of(times, "blending") + seconds_of(times, "grading");
  result.paper_shows =
      "Table 3: counting pixels takes 0.2187 s on the CPU at 1920 × 1080, 0.0038 to 0.0067 s at an eighth "
      "of the resolution, 0.003 to 0.0062 s on the GPU at any; the mixed image takes 0.2087 to 0.2264 s.";
  result.ours_shows = fmt::format(
      "On the CPU, at {}: counting takes {:.1f} ms pixel by pixel on one thread and {:.2f} ms vectorised; "
      "counting, blending and grading together take {:.1f} ms, the mixed image with the same vectorised "
      "steps "
      "and threads {:.1f} ms, {:.1f} times as long.",
      size_text(frame), 1000 * seconds_of(times, kOneByOne), 1000 * fast, 1000 * (fast + after), 1000 * mixed,
      mixed / (fast + after));
  const std::string beside_printed =
      has_printed_size(frame)
          ? fmt::format(
                "Vectorised counting at full resolution {} than the printed times of the GPU, and the "
                "mixed image {} than the printed ones. ",
                fast < printed_time("GPU", 1)->low_s ? "is faster" : "is not faster",
                mixed < printed_time("mixed image", 1)->low_s ? "is faster" : "is not faster")
          : "Frames of this size have no printed times to be compared with. ";
  result.differs =
      "Machines and languages differ (a script of a game engine on a Core i7-4770K there), so that ratios "
      "count. " +
      beside_printed +
      down_scaling_text(result, bench, frame, fast - seconds_of(times, "counting, vectorised", 8), after);
  result.add_plot("time-over-pixels", {time_plot(frame, times), "Time of counting over the number of pixels",
                                       "Printed and own times over pixels on logarithmic axes."});
  return result;
}

}  // namespace plenolab
