#pragma once

#include <map>
#include <vector>

#include "experiments/batch/input.h"
#include "experiments/cli/operator_options.h"

namespace plenolab {

/// Views after key-view adjustment with its default options; counts are those of the mapping before it.
using AdjustedViews = std::map<BatchView, ToneMapped>;

/// Maps a light field and draws its views together as `tonemap-lf` does it; keeps the views wanted. Throws
/// InputError for single images.
AdjustedViews adjusted_views(const OperatorChoice& choice, const LoadedInput& input,
                             const std::vector<BatchView>& wanted, int threads);

}  // namespace plenolab
