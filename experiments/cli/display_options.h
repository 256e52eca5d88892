#pragma once

#include <memory>
#include <string>

#include "core/luminance/ray_display.h"
#include "experiments/luminance_field.h"

namespace CLI {
class App;
}

namespace plenolab {

/// Which display a command simulates, and where its luminance is sampled.
struct DisplayOptions {
  std::string kind = "projectors";  ///< projectors, multi-view, lenticular, barrier, full-parallax
  std::string preset;         ///< quick, small, full, paper: projectors and pixels; empty = small, of scenes
  double cd_m2_per_unit = 0;  ///< of a folder's images; 0 = as they say
  int samples = 0;            ///< along the observers' line; 0 = as many as suit the display
};

/// Declares --display, --preset, --samples and --cd-m2-per-unit.
void add_display_options(CLI::App& app, DisplayOptions& options);

std::shared_ptr<const RayDisplay> make_display(const DisplayOptions& options);

/// Samples asked for, or: for projectors 1000 (the paper's) where images have 400 columns or more, else 200;
/// for other displays one for each position that its pixels have.
ObserverSamples observer_samples(const RayDisplay& display, const DisplayOptions& options);

/// Throws UsageError unless the source is a scene for displays or a folder, and the options fit it: before
/// anything is computed.
void require_field_source(const std::string& source, const DisplayOptions& options);

/// Whether the source is a scene, which is rendered for the display of the options.
bool is_display_scene(const std::string& source);

/// What a display shows: a scene of display_scenes() rendered for the display of the options; a folder with
/// display.json (core/luminance/display_folder.h); or any other light field, the cameras of whose middle row
/// become the views of a multi-view display. Its unit is that of the folder, or cd/m² where the options give
/// the scale.
ShownField open_field(const std::string& source, const DisplayOptions& options,
                      const RayRendering& rendering);

}  // namespace plenolab
