#include "core/tonemap/input_policy.h"

#include <atomic>
#include <cstddef>

#include "core/base/parallel.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 32;

}  // namespace

bool has_defects(const SceneImage& view, int threads) {
  std::atomic<bool> found = false;
  parallel_for(view.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      if (!all_usable({view.row(y), static_cast<std::size_t>(view.width())})) found = true;
  });
  return found;
}

RepairedView::RepairedView(const SceneImage& view, int threads) : original_(&view) {
  if (!has_defects(view, threads)) return;
  copy_ = view;
  repairs_ = repair(*copy_);
}

}  // namespace plenolab
