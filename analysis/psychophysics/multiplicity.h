#pragma once

#include <span>
#include <vector>

namespace plenolab {

/// p values adjusted for being one of several, in the order given; each in [0, 1].

/// Holm 1979: below alpha for any true hypothesis with probability alpha at most.
std::vector<double> holm(std::span<const double> p_values);
/// Benjamini & Hochberg 1995: of those below q, a share of q at most is expected to be false.
std::vector<double> benjamini_hochberg(std::span<const double> p_values);

}  // namespace plenolab
