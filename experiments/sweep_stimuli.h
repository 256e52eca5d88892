#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/cli/wide_table.h"
#include "experiments/sweep_synthesis.h"
#include "experiments/sweep_tonemap.h"

namespace plenolab {

/// Where rendered truth comes from.
struct SceneStimulusOptions {
  std::filesystem::path cache;
  std::uint64_t seed = 1;
  int threads = 0;
  int width = 0;                       ///< of the largest image; 0 = the scene's quick preset
  int paths_per_pixel = 0;             ///< 0 = the scene's quick preset
  std::vector<int> divisors{1, 2, 4};  ///< of the width: one stimulus each
};

/// The middle cell of a scene's quick grid (2×2 key views) with rendered truth at three positions inside, at
/// the full image width, a half and a quarter of it.
std::vector<SweepStimulus> stimuli_from_scene(const std::string& scene_id,
                                              const SceneStimulusOptions& options);

/// Every other view of a captured light field as key view, and up to three of the others, spread over the
/// grid, as truth. Throws InputError if no view is left as truth.
SweepStimulus stimulus_from_captured(const LightField& captured);

/// An image file (.exr with its channel disparity, if there, .hdr, .pfm).
SweepImage image_from_file(const std::filesystem::path& path);
/// The middle view of a scene's quick grid, with disparity.
SweepImage image_from_scene(const std::string& scene_id, const SceneStimulusOptions& options);
/// All key views of a scene's quick grid.
LightField field_from_scene(const std::string& scene_id, const SceneStimulusOptions& options);

/// The columns in which a sweep is shown to people.
std::vector<WideColumn> sweep_columns();

}  // namespace plenolab
