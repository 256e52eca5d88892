#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/tonemap/generic.h"
#include "experiments/reproduce/laboratory.h"
#include "metrics/drim.h"
#include "stimuli/direct/game_sequences.h"

namespace plenolab {

/// The three ways of tone mapping that Zhao 2019 compares.
enum class TuningMethod {
  kContentAdaptive,  ///< content adaptive operator with its defaults
  kGao,              ///< generic operator optimised by the feature metric with photographic photographs
  kZhao,             ///< … with content adaptive photographs: the thesis' method
};
inline constexpr std::array kTuningMethods{TuningMethod::kContentAdaptive, TuningMethod::kGao,
                                           TuningMethod::kZhao};
/// "content adaptive", "Gao", "Zhao".
const char* name_of(TuningMethod method);

/// A frame tone mapped by one method, and what DRIM and the no-reference score say of it.
struct TunedFrame {
  DisplayImage image, distortions;                   ///< distortions: drim_false_colour
  double loss = 0, amplification = 0, reversal = 0;  ///< mean probability, %
  double marked = 0;                                 ///< share of pixels where any is 0.5 or more, %
  double score = 0;                                  ///< brisque_plenolab
  std::optional<GenericOptions> parameters;          ///< of the methods that search
  int evaluations = 0;

  double total() const { return loss + amplification + reversal; }
};

/// The content adaptive operator with its defaults, fitted to the frame (cd/m²).
DisplayImage content_adaptive_image(const SceneImage& frame);

/// One game-like sequence by all methods: frames[f] of method m is by_method[m][f].
struct TunedSequence {
  const GameSequence* sequence = nullptr;
  std::array<std::vector<TunedFrame>, 3> by_method;

  /// Mean over the frames.
  double mean_of(TuningMethod method, const std::function<double(const TunedFrame&)>& value) const;
};

/// What the items on tone mapping tuned by metrics share during one run: frames of the game-like sequences
/// and their optimisation, computed when first asked for and kept. References stay valid.
///
/// A quick run judges frames 0, 4 and 8 of each sequence at 192×108 and searches, for at most 25 iterations,
/// on frames averaged down to half of that; a tiny one frame 4 at 64×36 for 2 iterations; a paper run all
/// nine frames at 640×360, searching at half size until nothing changes as in the thesis.
class OptimisationBench {
 public:
  explicit OptimisationBench(LaboratoryOptions options) : options_(std::move(options)) {}

  std::vector<int> judged_frames() const;
  int width() const;
  int height() const;
  /// In cd/m². `sequence` indexes game_sequences().
  const SceneImage& frame(std::size_t sequence, int frame);
  /// One for each of game_sequences().
  const std::vector<TunedSequence>& tuned();
  /// "frames 0, 4 and 8 at 192 × 108 px, searched at 96 × 54 px for at most 25 iterations".
  std::string setting_text() const;

  const LaboratoryOptions& options() const { return options_; }

 private:
  int most_iterations() const;
  TunedFrame tune(const SceneImage& frame, TuningMethod method, std::uint64_t seed, int threads) const;

  LaboratoryOptions options_;
  std::map<std::size_t, GameRenderer> renderers_;
  std::map<std::pair<std::size_t, int>, SceneImage> frames_;
  std::vector<TunedSequence> tuned_;
};

}  // namespace plenolab
