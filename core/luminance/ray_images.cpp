#include "core/luminance/ray_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kColumns = 64;  // at a time

std::span<const Rgb> columns_of(const RayValues<Rgb>& rays, int begin, int end) {
  return {rays.column(0, begin),
          static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(rays.size().height)};
}

/// What +Inf becomes: the largest finite value of all rays.
float largest_of(const SceneRays& rays) {
  float largest = 0;
  const RayCount size = rays.size();
  for (const Rgb& c : columns_of(rays, 0, size.images * size.width))
    for (const float v : {c.r, c.g, c.b})
      if (v > largest && v <= std::numeric_limits<float>::max()) largest = v;
  return largest;
}

void count_defect(float v, PixelRepairs& repairs) {
  if (v != v)
    ++repairs.nan;
  else if (v < 0)
    ++repairs.negative;
  else if (v > std::numeric_limits<float>::max())
    ++repairs.positive_infinity;
}

/// As luminance_row after repair; slow, for rays with defects.
PixelRepairs repair_into(const SceneRays& rays, RayValues<float>& out) {
  const RayCount size = rays.size();
  const float largest = largest_of(rays);
  PixelRepairs repairs;
  const auto from = columns_of(rays, 0, size.images * size.width);
  std::vector<Rgb> repaired(from.begin(), from.end());
  for (Rgb& c : repaired)
    for (float* v : {&c.r, &c.g, &c.b}) count_defect(*v, repairs), *v = repaired_value(*v, largest);
  luminance_row(repaired, {out.column(0, 0), repaired.size()});
  return repairs;
}

}  // namespace

RayLuminance luminance_of(const SceneRays& rays, int threads) {
  const RayCount size = rays.size();
  RayLuminance result{RayValues<float>(size), {}};
  const int columns = size.images * size.width;
  std::vector<unsigned char> usable(static_cast<std::size_t>(columns / kColumns + 1), 1);
  parallel_for(columns, kColumns, threads, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      const auto column = columns_of(rays, c, c + 1);
      if (!all_usable(column)) usable[static_cast<std::size_t>(begin / kColumns)] = 0;
      luminance_row(column, {result.values.column(0, c), column.size()});
    }
  });
  if (std::find(usable.begin(), usable.end(), 0) != usable.end())
    result.repairs = repair_into(rays, result.values);
  return result;
}

SceneImage image_of(const SceneRays& rays, int k) {
  const RayCount size = rays.size();
  SceneImage image(size.width, size.height);
  for (int u = 0; u < size.width; ++u)
    for (int v = 0; v < size.height; ++v) image.at(u, v) = rays.at({k, u, v});
  return image;
}

void set_image(SceneRays& rays, int k, const SceneImage& image) {
  const RayCount size = rays.size();
  if (image.width() != size.width || image.height() != size.height)
    throw InputError(fmt::format("image {} of the display has {} × {} pixels instead of {} × {}", k,
                                 image.width(), image.height(), size.width, size.height));
  for (int u = 0; u < size.width; ++u)
    for (int v = 0; v < size.height; ++v) rays.at({k, u, v}) = image.at(u, v);
}

}  // namespace plenolab
