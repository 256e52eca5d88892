#include "core/base/parallel.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>

#include "core/base/error.h"

namespace plenolab {

int resolve_threads(int threads) {
  if (threads < 0)
    throw InputError(fmt::format("the number of threads must be 0 (all) or more, not {}", threads));
  return threads == 0 ? tbb::this_task_arena::max_concurrency() : threads;
}

void parallel_for(int count, int grain, int threads, const std::function<void(int, int)>& body) {
  PLENOLAB_CHECK(grain > 0, fmt::format("grain {}", grain));
  if (count <= 0) return;
  const int workers = resolve_threads(threads);
  if (workers == 1 || count <= grain) {
    for (int begin = 0; begin < count; begin += grain) body(begin, std::min(count, begin + grain));
    return;
  }
  // More threads than cores are allowed when asked for: TBB wants to be told.
  std::optional<tbb::global_control> more_than_cores;
  if (workers > tbb::this_task_arena::max_concurrency())
    more_than_cores.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(workers));
  tbb::task_arena arena(workers);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, count, static_cast<std::size_t>(grain)),
        [&](const tbb::blocked_range<int>& range) { body(range.begin(), range.end()); },
        tbb::simple_partitioner());
  });
}

}  // namespace plenolab
