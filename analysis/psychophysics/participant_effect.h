#pragma once

#include <optional>
#include <vector>

#include "analysis/psychophysics/study_data.h"

namespace plenolab {

/// Whether some participants take the test image for the reference more often than others, over all images.
/// Images have rates of their own, and sums over images with unequal rates vary less than binomial ones,
/// which would hide participants who differ. Everything here is therefore conditional on the image.
struct ParticipantEffect {
  /// Correlation of two trials of one participant, each measured from the rate of its image on its display in
  /// units of its standard deviation: the mean product over all pairs of trials of one participant (moment
  /// estimate of an exchangeable correlation, Liang & Zeger 1986). 0 = participants are alike; below 0 by
  /// chance only. The interval is a percentile bootstrap over participants.
  Interval correlation;
  /// One-sided: how often the correlation is as large if the answers to each image are dealt out anew among
  /// its trials, which makes participants alike and keeps the counts of images (permutation test).
  double p_value = 1;
};

struct ParticipantEffectOptions {
  double confidence = 0.95;  ///< in (0, 1)
  int resamples = 1999;      ///< of the bootstrap and the permutation test, ≥ 100
  std::uint64_t seed = 1;

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// Catch trials are left out. Empty where the data cannot tell: fewer than two participants, or none with two
/// trials of images to which both answers were given.
std::optional<ParticipantEffect> participant_effect(const std::vector<StudyTrial>& trials,
                                                    const ParticipantEffectOptions& options = {});

}  // namespace plenolab
