#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/lut/volumes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/lut/count_pixels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLENOLAB_LUT_COUNT_PIXELS_TYPES
#define PLENOLAB_LUT_COUNT_PIXELS_TYPES
namespace plenolab {

/// A box in the order of precedence.
struct CountBox {
  float min[3], max[3];
};

/// World positions of a row: position + depth·(start + i·step).
struct CountRow {
  float position[3], start[3], step[3];
};

}  // namespace plenolab
#endif

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Lanes = hn::Vec<Floats>;

/// Adds one vector of depths, those of pixels i, i + 1, …; depths of 0 count nowhere.
HWY_INLINE void CountLanes(Lanes z, std::size_t i, const CountRow& row, const CountBox* boxes,
                           std::size_t box_count, std::int64_t* counts) {
  const Floats d;
  // Comparisons with NaN are false.
  auto open = hn::And(hn::Gt(z, hn::Zero(d)), hn::Le(z, hn::Set(d, std::numeric_limits<float>::max())));
  if (hn::AllFalse(d, open)) return;
  const Lanes index = hn::Iota(d, static_cast<float>(i));
  const auto along = [&](int k) {
    const Lanes ray = hn::MulAdd(index, hn::Set(d, row.step[k]), hn::Set(d, row.start[k]));
    return hn::MulAdd(z, ray, hn::Set(d, row.position[k]));
  };
  const Lanes x = along(0), y = along(1), w = along(2);
  for (std::size_t b = 0; b < box_count; ++b) {
    const CountBox& box = boxes[b];
    const auto between = [&](Lanes v, int k) {
      return hn::And(hn::Ge(v, hn::Set(d, box.min[k])), hn::Le(v, hn::Set(d, box.max[k])));
    };
    const auto inside = hn::And(open, hn::And(between(x, 0), hn::And(between(y, 1), between(w, 2))));
    if (hn::AllFalse(d, inside)) continue;
    counts[b] += static_cast<std::int64_t>(hn::CountTrue(d, inside));
    open = hn::AndNot(inside, open);
    if (hn::AllFalse(d, open)) return;
  }
}

/// Depths lie side by side, whatever the stride of their pixels. Adds to counts[b] the pixels of box b that
/// are in no box before.
void CountRowPixels(const float* depth, std::size_t count, const CountRow& row, const CountBox* boxes,
                    std::size_t box_count, std::int64_t* counts) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    CountLanes(hn::LoadU(d, depth + i), i, row, boxes, box_count, counts);
  if (i == count) return;
  HWY_ALIGN float rest[hn::MaxLanes(d)] = {};
  std::copy(depth + i, depth + count, rest);
  CountLanes(hn::Load(d, rest), i, row, boxes, box_count, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(CountRowPixels);

constexpr int kRowGrain = 16;

std::vector<CountBox> boxes_of(std::span<const Volume> volumes, const std::vector<int>& order) {
  std::vector<CountBox> boxes;
  for (const int i : order) {
    const Volume& volume = volumes[static_cast<std::size_t>(i)];
    CountBox& box = boxes.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      box.min[k] = static_cast<float>(volume.min[k]);
      box.max[k] = static_cast<float>(volume.max[k]);
    }
  }
  return boxes;
}

CountRow row_of(const DepthCamera& camera, int y, int width, int height, int stride) {
  CountRow row;
  const Point3 first = camera.world_of(0, y, width, height, 1);
  const Point3 next = camera.world_of(stride, y, width, height, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    row.position[k] = static_cast<float>(camera.position_m[k]);
    row.start[k] = static_cast<float>(first[k] - camera.position_m[k]);
    row.step[k] = static_cast<float>(next[k] - first[k]);
  }
  return row;
}

}  // namespace

VolumeCounts count_pixels(const Plane<float>& depth_m, const DepthCamera& camera,
                          std::span<const Volume> volumes, const CountOptions& options) {
  camera.validate();
  for (const Volume& volume : volumes) volume.validate();
  if (options.stride < 1) throw InputError("every stride-th pixel is counted: the stride must be ≥ 1");
  const std::vector<int> order = innermost_first(volumes);
  const std::vector<CountBox> boxes = boxes_of(volumes, order);
  const auto step = static_cast<std::size_t>(options.stride);
  const int columns = (depth_m.width() + options.stride - 1) / options.stride;
  const int rows = (depth_m.height() + options.stride - 1) / options.stride;
  const std::size_t per_row = volumes.size();
  std::vector<std::int64_t> counts(per_row * static_cast<std::size_t>(rows));
  parallel_for(rows, kRowGrain, options.threads, [&](int begin, int end) {
    std::vector<float> sampled(step > 1 ? static_cast<std::size_t>(columns) : 0);
    for (int j = begin; j < end; ++j) {
      const int y = j * options.stride;
      const float* depth = depth_m.row(y);
      if (step > 1) {
        for (std::size_t i = 0; i < sampled.size(); ++i) sampled[i] = depth[i * step];
        depth = sampled.data();
      }
      HWY_DYNAMIC_DISPATCH(CountRowPixels)
      (depth, static_cast<std::size_t>(columns),
       row_of(camera, y, depth_m.width(), depth_m.height(), options.stride), boxes.data(), boxes.size(),
       counts.data() + per_row * static_cast<std::size_t>(j));
    }
  });
  VolumeCounts total{std::vector<std::int64_t>(per_row), 0};
  for (std::size_t k = 0; k < counts.size(); ++k)
    total.volumes[static_cast<std::size_t>(order[k % per_row])] += counts[k];
  total.background = static_cast<std::int64_t>(columns) * rows;
  for (const std::int64_t volume : total.volumes) total.background -= volume;
  return total;
}

}  // namespace plenolab
#endif  // HWY_ONCE
