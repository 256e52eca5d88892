#pragma once

#include <optional>
#include <vector>

#include "analysis/psychophysics/study_data.h"

namespace plenolab {

/// How observers behave whatever the images are: which side they prefer, and how often they do not attend.

/// A rate with its exact interval (Clopper-Pearson).
struct ObservedRate {
  Proportion count;
  Interval interval;
};

struct PositionBias {
  ObservedRate left;   ///< how often the image under the left trigger was chosen; 0.5 without bias
  double p_value = 1;  ///< two-sided exact test of 0.5
};

/// Over all trials given, catch trials included: there is a right answer in each, but it lies left as often
/// as right only on average, so a bias of the drawn sides is part of it. Empty without trials.
std::optional<PositionBias> position_bias(const std::vector<StudyTrial>& trials, double confidence = 0.95);

struct LapseEstimate {
  ObservedRate wrong;  ///< of the catch trials, in which an attentive observer is never wrong
  /// Share of trials in which observers only guess: who guesses is wrong every second time, so twice the rate
  /// above and its ends, at most 1.
  Interval lapse;
};

/// Empty where there were no catch trials.
std::optional<LapseEstimate> lapse_rate(const std::vector<StudyTrial>& trials, double confidence = 0.95);

}  // namespace plenolab
