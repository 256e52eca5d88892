#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/base/pruned_stage.h"
#include "core/synthesis/epipolar_path.h"
#include "core/synthesis/patch_blend.h"
#include "core/synthesis/search.h"
#include "core/synthesis/thin_structures.h"

namespace plenolab {

/// What all patches of one synthesis share. Arrays are in the order of the used views.
struct SynthesisPlan {
  std::vector<EpipolarPath> paths;
  std::array<TileOccupancy, kMaxViews> occupancies;           ///< empty for the linear search
  std::array<std::unique_ptr<ThinSplats>, kMaxViews> splats;  ///< null without keep_thin
  BlendSetup blend;
  std::vector<PrunedStage> pruned;  ///< stages that cannot change the result, with the reason
};

/// Plans a synthesis from its key views, their prepared forms and their paths; `d_max_px` is where the search
/// starts. Options must be valid. Leaves out what cannot change the result if options.prune.
SynthesisPlan make_plan(std::span<const UsedView> views,
                        std::span<const std::shared_ptr<const PreparedView>> prepared,
                        std::vector<EpipolarPath> paths, float d_max_px, const SynthesisOptions& options);

}  // namespace plenolab
