#pragma once

#include "experiments/reproduce/exhibits/exhibits.h"

namespace plenolab {

/// Figures and tables of each paper; papers() puts them together.
std::span<const Exhibit> altmeier_exhibits();
std::span<const Exhibit> doronin_exhibits();
std::span<const Exhibit> hansen_thesis_exhibits();
std::span<const Exhibit> hansen_paper_exhibits();
std::span<const Exhibit> zhao_exhibits();

}  // namespace plenolab
