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

/// Sum of the numerators over that of the denominators, bootstrapped over scenes; equal lengths, ≥ 1. A
/// denominator of 0 counts as the smallest that can be told from 0 (1e-12).
Interval ratio_over_scenes(const std::vector<double>& numerators, const std::vector<double>& denominators,
                           std::uint64_t seed);

/// Mean |a − b| over all channels and pixels, values as they are.
double mean_absolute(const DisplayImage& a, const DisplayImage& b);

/// |a − b|, mean of the channels, pixel by pixel.
Plane<float> absolute_difference(const DisplayImage& a, const DisplayImage& b);

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
