#pragma once

#include <string>
#include <vector>

#include "analysis/statistics.h"
#include "experiments/reproduce/display/near_eye_bench.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// What the items on the near-eye display have in common.

/// "Hansen & Klein 2016, section …".
std::string thesis(const std::string& where);

/// Mean of shares over scenes, its interval within [0, 1]; ≥ 2 scenes.
Interval share_over_scenes(const std::vector<double>& shares, std::uint64_t seed);

/// Sum of the numerators over that of the denominators, bootstrapped over scenes; equal lengths, ≥ 1. A
/// denominator of 0 counts as the smallest that can be told from 0 (1e-12).
Interval ratio_over_scenes(const std::vector<double>& numerators, const std::vector<double>& denominators,
                           std::uint64_t seed);

/// Differences are taken between codes of 8 bits, as in tables 5.2 to 5.4.

/// Mean |a − b| over all channels and pixels, on [0, 1].
double mean_absolute(const DisplayImage& a, const DisplayImage& b);

/// |a − b|, mean of the channels, pixel by pixel, on [0, 1].
Plane<float> absolute_difference(const DisplayImage& a, const DisplayImage& b);

/// Share of the pixels with a channel that differs by more than so many codes of 255.
double share_beyond_codes(const DisplayImage& a, const DisplayImage& b, int codes);

/// The centre subimage [4, 8] of a light-field image, enlarged for looking.
DisplayImage centre_enlarged(const DisplayImage& light_field, const SubimageLayout& layout, int factor);

/// A verdict on all five scenes by the ledger's rule, filed with its row.
void conclude_on_scenes(ReproductionResult& result, NearEyeBench& bench, Claim claim, Verdict verdict,
                        std::string explanation);

/// Seconds of a light field of each scene, see NearEyeBench::timing.
struct NearEyeTimes {
  std::vector<double> direct, reprojected;
};
NearEyeTimes times_of(NearEyeBench& bench, const NearEyeBench::Recipe& recipe);

inline constexpr const char* kOverScenes = "95 % Student interval over the five scenes";

}  // namespace plenolab
