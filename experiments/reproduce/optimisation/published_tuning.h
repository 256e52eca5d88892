#pragma once

#include <array>
#include <span>
#include <string>

#include "experiments/reproduce/optimisation/optimisation_bench.h"

namespace plenolab {

/// Numbers as printed by Zhao 2019, slips included. Methods in the order of kTuningMethods.

struct PrintedDistortion {
  double loss = 0, amplification = 0, reversal = 0, total = 0;  ///< %
};

/// Table 2: DRIM, mean of nine frames.
struct PrintedSequence {
  const char* name;
  std::array<PrintedDistortion, 3> by_method;
};
std::span<const PrintedSequence> printed_table_2();

/// Figure 15: one frame of each sequence; share of marked pixels in % and BRISQUE.
struct PrintedScene {
  const char* name;
  std::array<double, 3> marked, brisque;
};
std::span<const PrintedScene> printed_figure_15();

/// Sequences that the caption of table 2 speaks of.
inline constexpr int kPrintedSequences = 6;
/// Scenes in which the text has content adaptive mapping ahead of the thesis' method (the bright ones of low
/// contrast).
inline constexpr std::array kPrintedExceptions{"Vehicle Game", "Living Room"};

/// The printed sequence that a game-like one ("after Sun Temple") is named after; figure 15 spells one of
/// them differently.
const PrintedSequence& printed_namesake(const GameSequence& sequence);
const PrintedScene& printed_scene_namesake(const GameSequence& sequence);

}  // namespace plenolab
