#include "core/luminance/ray_images.h"

#include <fmt/format.h>

#include <limits>
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

}  // namespace

PixelRepairs repair(SceneRays& rays) {
  PixelRepairs repairs;
  const float largest = largest_of(rays);
  Rgb* values = rays.column(0, 0);
  for (std::size_t i = 0; i < rays.size().total(); ++i)
    for (float* v : {&values[i].r, &values[i].g, &values[i].b}) {
      count_defect(*v, repairs);
      *v = repaired_value(*v, largest);
    }
  return repairs;
}

RayValues<float> luminance_of(const SceneRays& rays, int threads) {
  const RayCount size = rays.size();
  RayValues<float> luminance(size);
  parallel_for(size.images * size.width, kColumns, threads, [&](int begin, int end) {
    const auto columns = columns_of(rays, begin, end);
    luminance_row(columns, {luminance.column(0, begin), columns.size()});
  });
  return luminance;
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
