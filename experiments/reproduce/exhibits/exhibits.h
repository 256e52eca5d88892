#pragma once

#include <span>

namespace plenolab {

/// What became of a figure or table of a paper.
enum class ExhibitStatus {
  kRecomputed,       ///< determined by what the paper prints: the same numbers, computed here
  kRerun,            ///< the same experiment on our stimuli
  kNotReproducible,  ///< a photograph, a diagram, or data that nobody has
};

/// "recomputed", "re-run on our stimuli", "not reproducible".
const char* name_of(ExhibitStatus status);

/// A figure or table of one of the papers.
struct Exhibit {
  const char* name;   ///< "Figure 31", "Table 5.1"
  const char* shows;  ///< in a few words
  ExhibitStatus status;
  const char* item;  ///< id of the reproduction that has it; empty if it is not reproducible
  const char* note;  ///< why it is not reproducible, or what stands in its place; may be empty otherwise
};

struct Paper {
  const char* name;  ///< "Altmeier 2018"
  const char* title;
  std::span<const Exhibit> exhibits;  ///< every one, in the order of the paper
};

/// The five papers with each of their figures and tables.
std::span<const Paper> papers();

}  // namespace plenolab
