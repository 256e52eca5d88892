#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/image.h"
#include "core/tonemap/tone_mapped.h"

namespace plenolab {

/// Row buffers of one thread; each body sizes those it uses.
struct RowBuffers {
  std::vector<float> a, b;
};

/// Calls body(y, scene row, display row, buffers, counts) for every row of the repaired view and adds the
/// counts up. Bodies may not
/// depend on other rows; they see values that are finite and ≥ 0, and are called anew for rows of a view that
/// turns out to have defects.
using RowBody = std::function<void(int y, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers,
                                   MappingCounts& counts)>;

ToneMapped map_rows(const SceneImage& view, int threads, const RowBody& body);

}  // namespace plenolab
