#include "core/tonemap/map_rows.h"

namespace plenolab {

namespace {
constexpr int kRowGrain = 16;
}

ToneMapped map_rows(const SceneImage& view, int threads, const RowBody& body) {
  const RepairedView repaired(view, threads);
  const SceneImage& scene = repaired.image();
  ToneMapped mapped{DisplayImage(scene.width(), scene.height()), {}};
  std::vector<MappingCounts> counts(static_cast<std::size_t>(scene.height()));
  const std::size_t width = static_cast<std::size_t>(scene.width());
  parallel_for(scene.height(), kRowGrain, threads, [&](int begin, int end) {
    RowBuffers buffers;
    for (int y = begin; y < end; ++y)
      body(y, {scene.row(y), width}, {mapped.image.row(y), width}, buffers,
           counts[static_cast<std::size_t>(y)]);
  });
  for (const MappingCounts& row : counts) mapped.counts += row;
  mapped.counts.repairs = repaired.repairs();
  return mapped;
}

}  // namespace plenolab
