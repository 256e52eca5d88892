#include "experiments/reproduce/optimisation/optimisation_bench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/parallel.h"
#include "core/tonemap/content_adaptive.h"
#include "experiments/optimise/tone_optimiser.h"
#include "experiments/score.h"
#include "metrics/brisque.h"

namespace plenolab {

namespace {

constexpr int kSearchShrink = 2;

/// Fills in what is measured of the tone mapped image.
void judge(TunedFrame& tuned, const SceneImage& frame, const ComparisonConditions& conditions) {
  const DrimMaps maps = drim_maps(tuned.image, frame, conditions);
  const std::vector<Measurement> drim = drim_measurements(maps);
  tuned.loss = value_of(drim, "drim_mean_loss");
  tuned.amplification = value_of(drim, "drim_mean_amplification");
  tuned.reversal = value_of(drim, "drim_mean_reversal");
  tuned.marked = 100 * value_of(drim, "drim_share_any");
  tuned.distortions = drim_false_colour(maps, tuned.image);
  tuned.score = value_of(brisque_plenolab(tuned.image, conditions), "brisque_plenolab");
}

}  // namespace

DisplayImage content_adaptive_image(const SceneImage& frame) {
  const Plane<float> luminances = scene_luminance(frame, 1);
  const float largest = *std::max_element(luminances.pixels().begin(), luminances.pixels().end());
  const PqHistogram histogram = measure_pq_histogram(luminances, static_cast<double>(largest), 1);
  return apply(fit(ContentAdaptiveOptions{}, histogram), frame, 1).image;
}

const char* name_of(TuningMethod method) {
  switch (method) {
    case TuningMethod::kContentAdaptive:
      return "content adaptive";
    case TuningMethod::kGao:
      return "Gao";
    case TuningMethod::kZhao:
      return "Zhao";
  }
  return "";
}

double TunedSequence::mean_of(TuningMethod method,
                              const std::function<double(const TunedFrame&)>& value) const {
  const std::vector<TunedFrame>& frames = by_method[static_cast<std::size_t>(method)];
  double sum = 0;
  for (const TunedFrame& frame : frames) sum += value(frame);
  return sum / static_cast<double>(frames.size());
}

std::vector<int> OptimisationBench::judged_frames() const {
  switch (options_.effort) {
    case Effort::kTiny:
      return {4};
    case Effort::kQuick:
      return {0, 4, 8};
    case Effort::kPaper:
      break;
  }
  return {0, 1, 2, 3, 4, 5, 6, 7, 8};
}

int OptimisationBench::width() const {
  return options_.effort == Effort::kTiny ? 64 : options_.effort == Effort::kQuick ? 192 : 640;
}

int OptimisationBench::height() const {
  return width() * 9 / 16;
}

int OptimisationBench::most_iterations() const {
  return options_.effort == Effort::kTiny ? 2 : options_.effort == Effort::kQuick ? 25 : 200;
}

std::string OptimisationBench::setting_text() const {
  const std::vector<int> frames = judged_frames();
  return fmt::format("frame{} {} at {} × {} px, searched at {} × {} px for at most {} iterations",
                     frames.size() == 1 ? "" : "s", fmt::join(frames, ", "), width(), height(),
                     width() / kSearchShrink, height() / kSearchShrink, most_iterations());
}

const SceneImage& OptimisationBench::frame(std::size_t sequence, int frame) {
  const auto found = frames_.find({sequence, frame});
  if (found != frames_.end()) return found->second;
  auto renderer = renderers_.find(sequence);
  if (renderer == renderers_.end())
    renderer = renderers_.emplace(sequence, GameRenderer(game_sequences()[sequence].build())).first;
  return frames_
      .emplace(std::pair{sequence, frame}, renderer->second.frame(frame, width(), height(), options_.threads))
      .first->second;
}

TunedFrame OptimisationBench::tune(const SceneImage& frame, TuningMethod method, std::uint64_t seed,
                                   int threads) const {
  ComparisonConditions conditions;
  conditions.threads = threads;
  TunedFrame tuned;
  if (method == TuningMethod::kContentAdaptive) {
    tuned.image = content_adaptive_image(frame);
  } else {
    ToneOptimisationOptions search;
    search.quantity = method == TuningMethod::kGao ? "feature_photographic" : "feature_content_adaptive";
    search.shrink = kSearchShrink;
    search.evolution.most_iterations = most_iterations();
    search.evolution.seed = seed;
    ToneOptimisation found = optimise_tones(frame, conditions, search);
    tuned.image = std::move(found.image);
    tuned.parameters = found.best;
    tuned.evaluations = found.evolution.trace.back().evaluations;
  }
  judge(tuned, frame, conditions);
  return tuned;
}

const std::vector<TunedSequence>& OptimisationBench::tuned() {
  if (!tuned_.empty()) return tuned_;
  const std::size_t sequences = game_sequences().size();
  const std::vector<int> frames = judged_frames();
  for (std::size_t s = 0; s < sequences; ++s)
    for (const int f : frames) frame(s, f);
  std::vector<TunedSequence> tuned(sequences);
  for (std::size_t s = 0; s < sequences; ++s) {
    tuned[s].sequence = &game_sequences()[s];
    for (auto& by_frame : tuned[s].by_method) by_frame.resize(frames.size());
  }
  // One piece of work is a frame by one method: searches of different frames run side by side.
  const std::size_t per_sequence = frames.size() * kTuningMethods.size();
  parallel_for(static_cast<int>(sequences * per_sequence), 1, options_.threads, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const std::size_t s = i / per_sequence, f = i % per_sequence / kTuningMethods.size(),
                        m = i % kTuningMethods.size();
      tuned[s].by_method[m][f] = tune(frames_.at({s, frames[f]}), kTuningMethods[m],
                                      options_.seed + 1000 * s + static_cast<std::uint64_t>(frames[f]), 1);
    }
  });
  tuned_ = std::move(tuned);
  return tuned_;
}

}  // namespace plenolab
