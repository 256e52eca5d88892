#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/optimisation/optimisation_bench.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// What the items on tone mapping tuned by metrics have in common.

/// "Zhao 2019, section …".
std::string tuning_thesis(const std::string& where);

using FrameValue = std::function<double(const TunedFrame&)>;

/// Mean over the frames of each sequence: the value of method `a` less that of `b`. With `lights` only of
/// sequences in these categories.
std::vector<double> sequence_differences(const std::vector<TunedSequence>& tuned, TuningMethod a,
                                         TuningMethod b, const FrameValue& value,
                                         const std::vector<GameLight>& lights = {});

/// Mean of values, one a sequence, with its interval; of unknown width for fewer than two.
Interval over_sequences(const std::vector<double>& values, std::uint64_t seed);

/// A verdict on such a mean, filed in the result.
struct SequenceClaim {
  Claim claim;
  Comparison comparison = Comparison::kBelow;
  double threshold = 0;
  std::string quantity, unit, explanation;
};
Outcome conclude_over_sequences(ReproductionResult& result, const SequenceClaim& claim,
                                const std::vector<double>& values, std::uint64_t seed);

/// The method with the smallest value; the first of equals.
TuningMethod lowest_of(const std::array<double, 3>& by_method);

}  // namespace plenolab
