#pragma once

#include <map>
#include <vector>

#include "core/tonemap/adjustment/key_view_adjustment.h"
#include "experiments/batch/input.h"
#include "experiments/cli/operator_options.h"

namespace plenolab {

/// A light field after key-view adjustment with its default options.
struct AdjustedField {
  std::map<BatchView, ToneMapped> views;  ///< those wanted; counts are those of the mapping before it
  KeyViewAdjustmentCounts counts;         ///< of the adjustment, over all views
};

/// Maps a light field and draws its views together as `tonemap-lf` does it; keeps the views wanted. Throws
/// InputError for single images.
AdjustedField adjusted_field(const OperatorChoice& choice, const LoadedInput& input,
                             const std::vector<BatchView>& wanted, int threads);

}  // namespace plenolab
