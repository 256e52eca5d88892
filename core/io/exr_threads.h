#pragma once

namespace plenolab {

/// Number of threads for OpenEXR's own pool, which is started at the first call with one thread a core. What
/// is read and written does not depend on it.
int exr_threads();

}  // namespace plenolab
