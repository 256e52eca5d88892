#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "core/image/image.h"
#include "metrics/table.h"

namespace plenolab {

/// Two images of either meaning that metrics compare.
using ComparedImage = std::variant<SceneImage, DisplayImage>;

/// Measures, and writes what metrics have to show into `folder`, where there is one (else nothing):
///   drim.png                                             false colours over the test image in grey
///   drim-loss.png, drim-amplification.png, drim-reversal.png       probabilities, black 0, white 1
///   difference.png    largest encoded difference of the channels; for images of one kind
///   ssim.png          similarity of windows, black 0 and below, white 1; for images of one kind
/// Metrics that do not take this pair are left out. A tone mapped image is `test`, its scene the reference:
/// throws InputError the other way round.
std::vector<Measurement> measure_with_maps(const ComparedImage& test, const ComparedImage& reference,
                                           const std::vector<const Metric*>& chosen,
                                           const ComparisonConditions& conditions,
                                           const std::filesystem::path& folder = {});

}  // namespace plenolab
