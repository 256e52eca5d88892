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

/// Geometric mean over scenes of numerator over denominator, both ≥ 0 and of equal number, with Student's
/// interval of the logarithms: every scene weighs the same, half and double are as far from 1, and no end is
/// negative. (A ratio of sums would be that of the scene of extreme occlusion alone.) Scenes where both are 0
/// say nothing and are left out; a single 0 counts as 1e-12. Fewer than two scenes have an interval without
/// ends.
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

/// Seconds of a light field, scene by scene (NearEyeBench::timing): with few cameras rendered, run by run
/// with supersampling and without …
struct ReprojectedTimes {
  std::vector<double> supersampled, plain;
};
ReprojectedTimes reprojected_times(NearEyeBench& bench);
/// … and beside every camera rendered.
struct NearEyeTimes {
  ReprojectedTimes reprojected;
  std::vector<double> direct_supersampled, direct_plain;
};
NearEyeTimes times_side_by_side(NearEyeBench& bench);

/// What the intervals of ratio_over_scenes and share_over_scenes cover.
inline constexpr const char* kRatioOverScenes =
    "95 % Student interval of the logarithms over the five scenes";

inline constexpr const char* kShareOverScenes = "95 % Student interval over the five scenes";

}  // namespace plenolab
