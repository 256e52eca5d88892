#pragma once

#include <filesystem>
#include <vector>

#include "analysis/result_table.h"
#include "experiments/tonemap_video.h"

namespace plenolab {

/// Makes a tone mapped video with a progress bar: writes frame_0000.png, … and frames.csv (numbers of each
/// frame) below `folder`, which exists. Returns what holds for all frames: fits, counts, times of the three
/// stages and, with `consistency`, the summary of ConsistencyMeter.
ResultTable write_mapped_frames(const LightField& field, const std::vector<CameraPosition>& positions,
                                const MappedVideoOptions& mapping, bool consistency,
                                const std::filesystem::path& folder);

}  // namespace plenolab
