#include "core/tonemap/input_policy.h"

#include <atomic>
#include <limits>

#include "core/base/parallel.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 32;

/// NaN fails both comparisons.
unsigned defective(float v) {
  return static_cast<unsigned>(!(v >= 0 && v <= std::numeric_limits<float>::max()));
}

bool row_has_defects(const Rgb* row, int width) {
  unsigned any = 0;
  for (int x = 0; x < width; ++x) any |= defective(row[x].r) | defective(row[x].g) | defective(row[x].b);
  return any != 0;
}

}  // namespace

bool has_defects(const SceneImage& view, int threads) {
  std::atomic<bool> found = false;
  parallel_for(view.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      if (row_has_defects(view.row(y), view.width())) found = true;
  });
  return found;
}

RepairedView::RepairedView(const SceneImage& view, int threads) : original_(&view) {
  if (!has_defects(view, threads)) return;
  copy_ = view;
  repairs_ = repair(*copy_);
}

}  // namespace plenolab
