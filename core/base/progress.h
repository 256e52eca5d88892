#pragma once

#include <functional>

namespace plenolab {

/// Called from long work with the share done in [0, 1], never from two threads at once. Empty = nobody
/// listens.
using Progress = std::function<void(double share_done)>;

}  // namespace plenolab
