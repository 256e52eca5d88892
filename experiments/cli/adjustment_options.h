#pragma once

#include "core/tonemap/adjustment/key_view_adjustment.h"

namespace CLI {
class App;
}

namespace plenolab {

/// Declares the options of key-view adjustment (--sigma-views, --support, --sigma-d, …), each with the
/// default of KeyViewAdjustmentOptions. `options` must live until the command has run.
void add_adjustment_options(CLI::App& app, KeyViewAdjustmentOptions& options);

/// Whether any of them was given.
bool adjustment_options_given(const CLI::App& app);

}  // namespace plenolab
