#pragma once

#include <functional>

namespace plenolab {

/// Number of worker threads meant by an option value: 0 = all cores of the machine, otherwise the value
/// itself. Throws InputError for negative values.
int resolve_threads(int threads);

/// Calls body(begin, end) for disjoint ranges that cover [0, count), on at most `threads` threads (0 = all
/// cores). Ranges are at most `grain` long. The body must not depend on how the range is cut: outputs are
/// identical for any number of threads when each index writes only its own results. Exceptions of the body
/// reach the caller.
void parallel_for(int count, int grain, int threads, const std::function<void(int begin, int end)>& body);

}  // namespace plenolab
