#include "experiments/sweep_lut.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "core/lut/grade.h"
#include "experiments/colour_error.h"
#include "experiments/grade_chain.h"
#include "experiments/walk.h"

namespace plenolab {

namespace {

constexpr std::array kSizes{8, 12, 16, 24, 32, 48, 64};
constexpr std::array kDivisors{1, 2, 4, 8, 16, 32};
constexpr int kCandleLight = 1;  // the look that is transferred

struct ColourChain {
  std::string name;
  std::function<Rgb(Rgb)> exact;
};

const char* name_of(LutInterpolation interpolation) {
  return interpolation == LutInterpolation::kTrilinear ? "trilinear" : "tetrahedral";
}

SweepOutcome run_table(const DisplayImage& picture, const DisplayImage& truth, const Lut& lut,
                       LutInterpolation interpolation, const SweepRun& run) {
  SweepOutcome outcome{.setting = {{"interpolation", std::string(name_of(interpolation))},
                                   {"size", static_cast<long long>(lut.size)}}};
  const PreparedLut prepared(lut);
  DisplayImage graded;
  time_setting(
      outcome,
      [&] {
        graded = prepared.grade(picture, {interpolation, run.threads}).image;
      },
      run.runs);
  const ColourError error = colour_error(graded, truth, run.threads);
  outcome.error = error.mean;
  outcome.values = {{"mean_delta_e", error.mean, "1"}, {"largest_delta_e", error.largest, "1"}};
  return outcome;
}

SweepOutcome run_exactly(const DisplayImage& picture, const ColourChain& chain, DisplayImage& truth,
                         const SweepRun& run) {
  SweepOutcome outcome{.setting = {{"interpolation", std::string("none")}, {"size", 0LL}}};
  time_setting(
      outcome, [&] { truth = evaluate_chain(picture, chain.exact, run.threads); }, run.runs);
  outcome.values = {{"mean_delta_e", 0, "1"}, {"largest_delta_e", 0, "1"}};
  return outcome;
}

/// A frame to count in, and a smaller picture of it to see what errors of the weights do.
struct CountedFrame {
  DepthCamera camera;
  Plane<float> depth_m;
  DisplayImage picture;
  DisplayImage graded;  ///< with all pixels counted
};

std::vector<CountedFrame> counted_frames(const WalkStage& stage, int threads) {
  const std::vector<WalkPose> path = walk_path();
  std::vector<CountedFrame> frames;
  for (std::size_t i = 4; i < path.size(); i += path.size() / 5)
    frames.push_back({path[i].camera,
                      stage.surfaces(path[i], 1920, 1080, threads).depth_m,
                      stage.frame(path[i], 480, 270, threads).picture,
                      {}});
  return frames;
}

/// Tables of the walk's places, made from the frames that show most of each; the background's last.
std::vector<Lut> tables_for(const WalkStage& stage, const std::vector<CountedFrame>& frames, int threads) {
  std::vector<VolumeCounts> counts;
  for (const CountedFrame& frame : frames)
    counts.push_back(count_pixels(frame.depth_m, frame.camera, stage.volumes(), {1, threads}));
  std::vector<Lut> tables;
  for (const WalkLook& look : make_walk_looks(counts, [&](std::size_t i) { return frames[i].picture; }))
    tables.push_back(look.transfer.lut);
  return tables;
}

/// Times a frame of the work for all of them.
void divide_times(TimingSummary& t, double count) {
  for (double* seconds : {&t.median_s, &t.lower_quartile_s, &t.upper_quartile_s, &t.min_s, &t.max_s})
    *seconds /= count;
}

double largest_difference(const VolumeWeights& a, const VolumeWeights& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.volumes.size(); ++v)
    largest = std::max(largest, std::abs(a.volumes[v] - b.volumes[v]));
  return largest;
}

SweepOutcome run_counting(const WalkStage& stage, std::vector<CountedFrame>& frames,
                          const std::vector<Lut>& tables, int divisor, const SweepRun& run) {
  SweepOutcome outcome{.setting = {{"divisor", static_cast<long long>(divisor)}}};
  std::vector<VolumeCounts> counts(frames.size());
  const auto count_all = [&] {
    for (std::size_t i = 0; i < frames.size(); ++i)
      counts[i] = count_pixels(frames[i].depth_m, frames[i].camera, stage.volumes(), {divisor, run.threads});
  };
  time_setting(outcome, count_all, run.runs);
  const auto count = static_cast<double>(frames.size());
  divide_times(outcome.timing, count);
  double largest = 0, weight_error = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CountedFrame& frame = frames[i];
    const VolumeCounts every = count_pixels(frame.depth_m, frame.camera, stage.volumes(), {1, run.threads});
    const VolumeWeights weights = pixel_weights(counts[i], stage.volumes());
    weight_error = std::max(weight_error, largest_difference(weights, pixel_weights(every, stage.volumes())));
    const PreparedLut lut(blend_volumes(weights, std::span(tables).first(tables.size() - 1), tables.back()));
    const DisplayImage graded = lut.grade(frame.picture, {.threads = run.threads}).image;
    if (frame.graded.empty()) frame.graded = graded;
    const double error = colour_error(graded, frame.graded, run.threads).mean;
    outcome.error += error / count;
    largest = std::max(largest, error);
  }
  outcome.values = {{"mean_delta_e", outcome.error, "1"},
                    {"largest_delta_e", largest, "1"},
                    {"largest_weight_error", weight_error, "1"}};
  return outcome;
}

}  // namespace

ResultTable sweep_lut(const std::string& name, const DisplayImage& picture, const SweepRun& run) {
  const std::vector<ColourChain> chains{{"correction", grade_chain},
                                        {"transfer", make_walk_look(kCandleLight, picture).transfer.exact}};
  ResultTable table;
  double done = 0;
  const auto step = [&] {
    if (run.progress) run.progress(++done / (static_cast<double>(chains.size()) * (1 + 2 * kSizes.size())));
  };
  for (const ColourChain& chain : chains) {
    DisplayImage truth;
    std::vector<SweepOutcome> outcomes{run_exactly(picture, chain, truth, run)};
    step();
    std::vector<Lut> tables;
    for (const int size : kSizes) tables.push_back(bake_lut(size, chain.exact));
    for (const auto interpolation : {LutInterpolation::kTrilinear, LutInterpolation::kTetrahedral})
      for (const Lut& lut : tables) {
        outcomes.push_back(run_table(picture, truth, lut, interpolation, run));
        step();
      }
    add_outcome_rows(table, {{"picture", name}, {"chain", chain.name}}, outcomes);
  }
  return table;
}

Plot plot_lut_sweep(const ResultTable& rows) {
  std::map<std::string, PlotSeries> series;
  for (const ResultRow& row : rows.rows()) {
    if (row.quantity != "mean_delta_e" || row.columns.size() != 4 || row.value <= 0) continue;
    const auto text = [&](std::size_t column) { return std::get<std::string>(row.columns[column].second); };
    const std::string title = fmt::format("{}, {}", text(1), text(2));
    series[title].title = title;
    series[title].points.push_back(
        {static_cast<double>(std::get<long long>(row.columns[3].second)), row.value});
  }
  Plot plot;
  plot.x = {.title = "Nodes along each axis", .logarithmic = true, .minimum = 7, .maximum = 72};
  plot.y = {.title = "Mean ΔE*ab", .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  for (auto& [title, shown] : series) plot.series.push_back(std::move(shown));
  return plot;
}

ResultTable sweep_pixel_counting(const SweepRun& run) {
  const WalkStage stage;
  std::vector<CountedFrame> frames = counted_frames(stage, run.threads);
  const std::vector<Lut> tables = tables_for(stage, frames, run.threads);
  std::vector<SweepOutcome> outcomes;
  for (const int divisor : kDivisors) {
    outcomes.push_back(run_counting(stage, frames, tables, divisor, run));
    if (run.progress) run.progress(static_cast<double>(outcomes.size()) / kDivisors.size());
  }
  ResultTable table;
  add_outcome_rows(table, {{"picture", std::string("walk")}, {"chain", std::string("pixel counting")}},
                   outcomes);
  return table;
}

SweepPlotDesign pixel_counting_sweep_plot() {
  return {"mean_delta_e", "Mean ΔE*ab", "1", {"chain"}, "divisor"};
}

}  // namespace plenolab
