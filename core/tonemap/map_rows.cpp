#include "core/tonemap/map_rows.h"

#include <atomic>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;

/// Maps a scene without defects; stops early and returns false if it has some, which are found on the way.
bool map_usable_rows(const SceneImage& scene, int threads, const RowBody& body, ToneMapped& mapped) {
  std::vector<MappingCounts> counts(static_cast<std::size_t>(scene.height()));
  const std::size_t width = static_cast<std::size_t>(scene.width());
  std::atomic<bool> usable = true;
  parallel_for(scene.height(), kRowGrain, threads, [&](int begin, int end) {
    RowBuffers buffers;
    for (int y = begin; y < end && usable; ++y) {
      const std::span<const Rgb> row(scene.row(y), width);
      if (!all_usable(row))
        usable = false;
      else
        body(y, row, {mapped.image.row(y), width}, buffers, counts[static_cast<std::size_t>(y)]);
    }
  });
  if (!usable) return false;
  for (const MappingCounts& row : counts) mapped.counts += row;
  return true;
}

}  // namespace

ToneMapped map_rows(const SceneImage& view, int threads, const RowBody& body) {
  ToneMapped mapped{DisplayImage(view.width(), view.height()), {}};
  if (map_usable_rows(view, threads, body, mapped)) return mapped;
  SceneImage copy = view;
  mapped.counts.repairs = repair(copy);
  PLENOLAB_CHECK(map_usable_rows(copy, threads, body, mapped), "a repaired view has no defects");
  return mapped;
}

}  // namespace plenolab
