#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/luminance/luminance_bench.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// What the items on the luminance of a projector display have in common.

/// "Doronin & Barsi 2018, section …".
std::string display_paper(const std::string& where);

/// The methods as the paper writes them: All, BruteForce, Accumulative; and Spread.
std::string paper_name(LuminanceMethod method);

/// Indices into LuminanceBench::methods().
inline constexpr std::size_t kOfAll = 0, kOfBruteForce = 1, kOfAccumulative = 2, kOfSpread = 3;

/// Neighbouring positions of the observers' line see almost the same: so many of them are drawn together.
inline constexpr int kPositionsTogether = 5;

/// A verdict with its scenes and words, filed in the result.
void conclude_on(ReproductionResult& result, std::vector<std::string> scenes, Claim claim, Verdict verdict,
                 std::string explanation);

/// The scores of both references, one after the other.
const std::vector<std::vector<double>>& scores_against(const LuminanceBench::Scores& scores,
                                                       bool ground_truth);

/// "falls from 0.8 to 0.5" if every value is below the one before, "grows …" if above, else "goes over …".
std::string trend_text(const std::vector<double>& values);

/// a − b; nothing where one of them is not defined.
std::optional<double> difference(std::optional<double> a, std::optional<double> b);

/// Root mean square of the values that are defined; nothing if none is.
std::optional<double> rms_of_defined(const std::vector<std::optional<double>>& values);

/// a − b, element by element.
std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace plenolab
