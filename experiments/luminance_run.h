#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/luminance_field.h"
#include "experiments/score.h"

namespace plenolab {

/// One run of `plenolab luminance`: estimates by several methods, what observers see of a display that is
/// tone mapped with each, and the rows and files made of that.

/// An observer that is looked through, and how files and rows name it.
struct NamedObserver {
  std::string name;  ///< "left", "2.5m"
  ObserverPosition position;
};

/// What is asked for.
struct LuminancePlan {
  std::string source;  ///< as the user named it
  std::vector<LuminanceOptions> methods;
  std::vector<NamedObserver> observers;
  ObserverSamples samples;
  LogAverageOptions average;
  RayReinhardOptions reinhard;
  bool display_images = false;  ///< also write the images of a projector display
  int threads = 0;
};

/// Rows of results, the samples along the line apart, and sentences on what the numbers do not say.
/// Quantities of luminance end in the unit of the field (luminance_unit).
struct LuminanceResults {
  ResultTable rows, samples;
  std::vector<std::string> notes;  ///< also among the rows
};

/// Estimates, maps and looks; writes views, plot and samples.csv into the folder unless it is empty.
/// Observers whom no ray of the display reaches get no luminance, comparison or picture, but a note.
LuminanceResults run_luminance_plan(const ShownField& field, const LuminancePlan& plan,
                                    const std::filesystem::path& folder);

/// The tables for people.
std::string luminance_tables(const ShownField& field, const LuminanceResults& results);

}  // namespace plenolab
