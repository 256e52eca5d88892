#pragma once

namespace plenolab::brisque_weights {

inline constexpr double kMean[36] = {};
inline constexpr double kDeviation[36] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
                                          1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
inline constexpr double kWeights[72] = {};
inline constexpr double kIntercept = 0;

}  // namespace plenolab::brisque_weights
