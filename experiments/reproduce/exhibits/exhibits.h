#pragma once

#include <span>
#include <string>

namespace plenolab {

/// What became of a figure or table of a paper.
enum class ExhibitStatus {
  kRecomputed,       ///< determined by what the paper prints: the same numbers, computed here
  kRerun,            ///< the same experiment on our stimuli
  kDiagram,          ///< a drawing: measured or drawn in its place where that teaches something
  kNotReproducible,  ///< a photograph, another paper's picture, or data that nobody has
};

/// "recomputed", "re-run on our stimuli", "diagram", "not reproducible".
const char* name_of(ExhibitStatus status);
/// What the status means, in a few words.
const char* meaning_of(ExhibitStatus status);

/// A figure or table of one of the papers.
struct Exhibit {
  const char* name;   ///< "Figure 31", "Table 5.1"
  const char* shows;  ///< in a few words
  ExhibitStatus status;
  const char* item;  ///< id of the reproduction that has it, or what stands for a diagram; else empty
  const char* note;  ///< why it is not reproducible, what stands in its place or what a diagram is of; may be
                     ///< empty otherwise
};

struct Paper {
  const char* name;  ///< "Altmeier 2018"
  const char* title;
  std::span<const Exhibit> exhibits;  ///< every one, in the order of the paper
};

/// An exhibit that an id like "zhao-fig-13" or "hansen-table-5.1" is meant to name, if there is one.
struct NamedExhibit {
  const Paper* paper = nullptr;  ///< none
  const Exhibit* exhibit = nullptr;
};
NamedExhibit exhibit_called(const std::string& id);

/// The five papers with each of their figures and tables.
std::span<const Paper> papers();

}  // namespace plenolab
