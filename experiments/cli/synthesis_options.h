#pragma once

#include <string>

#include "core/synthesis/options.h"

namespace CLI {
class App;
}

namespace plenolab {

/// Declares the options of a synthesis (--camera, --screen-depth, --search, --step, …) on a command, each
/// with the default of SynthesisOptions. `options` must live until the command has run.
void add_synthesis_options(CLI::App& app, SynthesisOptions& options);

/// Throws UsageError if options were given that do not go together. To be called before anything is computed.
void require_fitting(const SynthesisOptions& options);

}  // namespace plenolab
