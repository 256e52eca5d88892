#pragma once

#include <memory>
#include <vector>

#include "core/lightfield/light_field.h"
#include "core/synthesis/novel_view.h"
#include "core/synthesis/options.h"
#include "core/synthesis/prepared_view.h"

namespace plenolab {

/// Everything one synthesis reads.
template <class Referral>
struct SynthesisInput {
  ViewGrid grid;
  CameraPosition position;
  float d_max_px = 0;           ///< at least the largest disparity of the prepared views
  std::vector<UsedView> views;  ///< at most kMaxViews, as select_key_views gives them
  std::vector<std::shared_ptr<const PreparedView>> prepared;  ///< of the same order and of the grid's size
  std::shared_ptr<const KeyView<Referral>>
      exact;  ///< the key view itself where the position is one, else null
};

/// Synthesises one view (section 4) from prepared key views; the work behind BasicSynthesizer::synthesize.
/// Options must be valid. Does not set SynthesisTimings::prepare_s.
template <class Referral>
NovelView<Referral> run_synthesis(const SynthesisInput<Referral>& input, const SynthesisOptions& options);

}  // namespace plenolab
