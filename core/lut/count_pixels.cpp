#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// A box in the order of precedence, from the camera's position: world coordinates may be millions of metres
/// (a map's northing), of which 32 bits keep half a metre.
struct CountBox {
  float min[3], max[3];
  std::int32_t volume;  ///< its index
};

/// Positions of a row from the camera's: depth·(start + i·step).
struct CountRow {
  float start[3], step[3];
};

}  // namespace plenolab
#endif

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Lanes = hn::Vec<Floats>;

/// Calls take(box, inside) for the boxes that hold some of the surfaces at depths `z` of pixels i, i + 1, …;
/// each surface is inside the first box only, and depths that are none (NaN, ≤ 0, ∞) inside no box.
template <class Take>
HWY_INLINE void FindBoxes(Lanes z, std::size_t i, const CountRow& row, const CountBox* boxes,
                          std::size_t box_count, const Take& take) {
  const Floats d;
  // Comparisons with NaN are false.
  auto open = hn::And(hn::Gt(z, hn::Zero(d)), hn::Le(z, hn::Set(d, std::numeric_limits<float>::max())));
  if (hn::AllFalse(d, open)) return;
  const Lanes index = hn::Iota(d, static_cast<float>(i));
  const auto along = [&](int k) {
    return hn::Mul(z, hn::MulAdd(index, hn::Set(d, row.step[k]), hn::Set(d, row.start[k])));
  };
  const Lanes x = along(0), y = along(1), w = along(2);
  for (std::size_t b = 0; b < box_count; ++b) {
    const CountBox& box = boxes[b];
    const auto between = [&](Lanes v, int k) {
      return hn::And(hn::Ge(v, hn::Set(d, box.min[k])), hn::Le(v, hn::Set(d, box.max[k])));
    };
    const auto inside = hn::And(open, hn::And(between(x, 0), hn::And(between(y, 1), between(w, 2))));
    if (hn::AllFalse(d, inside)) continue;
    take(b, inside);
    open = hn::AndNot(inside, open);
    if (hn::AllFalse(d, open)) return;
  }
}

/// Calls work(depths, i) for vectors of depths from i on; those past the end are 0.
template <class Work>
HWY_INLINE void ForEachVector(const float* depth, std::size_t count, const Work& work) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) work(hn::LoadU(d, depth + i), i);
  if (i == count) return;
  HWY_ALIGN float rest[hn::MaxLanes(d)] = {};
  std::copy(depth + i, depth + count, rest);
  work(hn::Load(d, rest), i);
}

/// Depths lie side by side, whatever the stride of their pixels. Adds to counts[b] the pixels of box b that
/// are in no box before.
void CountRowPixels(const float* depth, std::size_t count, const CountRow& row, const CountBox* boxes,
                    std::size_t box_count, std::int64_t* counts) {
  ForEachVector(depth, count, [&](Lanes z, std::size_t i) HWY_ATTR {
    FindBoxes(z, i, row, boxes, box_count, [&](std::size_t b, auto inside) HWY_ATTR {
      counts[b] += static_cast<std::int64_t>(hn::CountTrue(Floats(), inside));
    });
  });
}

/// Writes the volume of each pixel, −1 for none. `volume` has room for a vector more.
void MapRowPixels(const float* depth, std::size_t count, const CountRow& row, const CountBox* boxes,
                  std::size_t box_count, std::int32_t* volume) {
  const hn::RebindToSigned<Floats> di;
  ForEachVector(depth, count, [&](Lanes z, std::size_t i) HWY_ATTR {
    auto found = hn::Set(di, -1);
    FindBoxes(z, i, row, boxes, box_count, [&](std::size_t b, auto inside) HWY_ATTR {
      found = hn::IfThenElse(hn::RebindMask(di, inside), hn::Set(di, boxes[b].volume), found);
    });
    hn::StoreU(found, di, volume + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(CountRowPixels);
HWY_EXPORT(MapRowPixels);

constexpr int kRowGrain = 16;
/// No vector of any target has more floats.
constexpr std::size_t kMostLanes = 64;

float rounded(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  if (std::abs(value) > kMost)
    return static_cast<float>(std::copysign(std::numeric_limits<double>::infinity(), value));
  return static_cast<float>(value);
}

/// In the order of precedence.
std::vector<CountBox> boxes_of(std::span<const Volume> volumes, const Point3& camera_m) {
  std::vector<CountBox> boxes;
  for (const int i : innermost_first(volumes)) {
    const Volume& volume = volumes[static_cast<std::size_t>(i)];
    CountBox& box = boxes.emplace_back();
    box.volume = i;
    for (std::size_t k = 0; k < 3; ++k) {
      box.min[k] = rounded(volume.min[k] - camera_m[k]);
      box.max[k] = rounded(volume.max[k] - camera_m[k]);
    }
  }
  return boxes;
}

CountRow row_of(DepthCamera camera, int y, int width, int height, int stride) {
  camera.position_m = {};
  CountRow row;
  const Point3 first = camera.world_of(0, y, width, height, 1);
  const Point3 next = camera.world_of(stride, y, width, height, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    row.start[k] = static_cast<float>(first[k]);
    row.step[k] = static_cast<float>(next[k] - first[k]);
  }
  return row;
}

void check_scene(const DepthCamera& camera, std::span<const Volume> volumes) {
  camera.validate();
  for (const Volume& volume : volumes) volume.validate();
}

}  // namespace

Plane<int> map_pixels(const Plane<float>& depth_m, const DepthCamera& camera, std::span<const Volume> volumes,
                      int threads) {
  check_scene(camera, volumes);
  const std::vector<CountBox> boxes = boxes_of(volumes, camera.position_m);
  const int width = depth_m.width(), height = depth_m.height();
  const auto columns = static_cast<std::size_t>(width);
  Plane<int> map(width, height);
  parallel_for(height, kRowGrain, threads, [&](int begin, int end) {
    std::vector<std::int32_t> row(columns + kMostLanes);
    for (int y = begin; y < end; ++y) {
      HWY_DYNAMIC_DISPATCH(MapRowPixels)
      (depth_m.row(y), columns, row_of(camera, y, width, height, 1), boxes.data(), boxes.size(), row.data());
      std::copy_n(row.begin(), columns, map.row(y));
    }
  });
  return map;
}

VolumeCounts count_pixels(const Plane<float>& depth_m, const DepthCamera& camera,
                          std::span<const Volume> volumes, const CountOptions& options) {
  check_scene(camera, volumes);
  if (options.stride < 1) throw InputError("every stride-th pixel is counted: the stride must be ≥ 1");
  const std::vector<CountBox> boxes = boxes_of(volumes, camera.position_m);
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
    total.volumes[static_cast<std::size_t>(boxes[k % per_row].volume)] += counts[k];
  total.background = static_cast<std::int64_t>(columns) * rows;
  for (const std::int64_t volume : total.volumes) total.background -= volume;
  return total;
}

}  // namespace plenolab
#endif  // HWY_ONCE
