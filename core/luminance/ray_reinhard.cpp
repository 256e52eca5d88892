#include "core/luminance/ray_reinhard.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/luminance/ray_reinhard.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

/// out = c/(m + L) with m = L̄/α, cut to 1; returns how many values were cut. That is c·s/(1 + s·L) with
/// s = 1/m, but neither a product nor a sum leaves float's range: all is taken times `by`, m too.
std::int64_t MapPixels(const Rgb* from, Rgb* to, std::size_t count, float middle, float by) {
  const Floats d;
  const Vec one = C(1.0f), scale = C(by);
  std::size_t cut = 0;
  VisitPixels(from, count, [&](Vec r, Vec g, Vec b, std::size_t i, LaneMask) {
    r = hn::Mul(r, scale), g = hn::Mul(g, scale), b = hn::Mul(b, scale);
    const Vec ratio = hn::Div(one, hn::Add(C(middle), Luminance(r, g, b)));
    const Vec red = hn::Mul(r, ratio), green = hn::Mul(g, ratio), blue = hn::Mul(b, ratio);
    cut += hn::CountTrue(d, hn::Gt(red, one)) + hn::CountTrue(d, hn::Gt(green, one)) +
           hn::CountTrue(d, hn::Gt(blue, one));
    StorePixels(hn::Min(red, one), hn::Min(green, one), hn::Min(blue, one), to, i, count);
  });
  return static_cast<std::int64_t>(cut);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {

HWY_EXPORT(MapPixels);

/// A power of two, so that the brightest float fits beside m.
constexpr float kScale = 1.0f / 16;

std::int64_t map_pixels(const Rgb* from, Rgb* to, int count, double key, double ln_luminance) {
  // Its inverse, too, must be within float's range, whatever L̄ is.
  const double middle = std::clamp(static_cast<double>(kScale) * std::exp(ln_luminance) / key, 3e-39, 3e38);
  return HWY_DYNAMIC_DISPATCH(MapPixels)(from, to, static_cast<std::size_t>(count),
                                         static_cast<float>(middle), kScale);
}

}  // namespace

void RayReinhardOptions::validate() const {
  if (!(key > 0 && key <= 4))
    throw InputError(fmt::format("the key must be above 0 and at most 4, not {:g}", key));
}

LightMapped<DisplayRays> map_rays(const RayDisplay& display, const SceneRays& rays,
                                  const GlobalLuminance& luminance, const RayReinhardOptions& options,
                                  int threads) {
  options.validate();
  const RayCount size = rays.size();
  if (!(size == display.size())) throw InputError("the rays to be tone mapped are not those of the display");
  LightMapped<DisplayRays> result{DisplayRays(size)};
  if (!luminance.known()) {
    result.undefined = static_cast<std::int64_t>(size.total());
    return result;
  }
  const bool whole_columns = display.in_columns();
  std::atomic<std::int64_t> clipped = 0;
  parallel_for(size.images * size.width, 64, threads, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      const int image = c / size.width, u = c % size.width, step = whole_columns ? size.height : 1;
      for (int v = 0; v < size.height; v += step)
        clipped += map_pixels(rays.column(image, u) + v, result.light.column(image, u) + v, step, options.key,
                              *luminance.ln_at(display.position({image, u, v})));
    }
  });
  result.clipped = clipped;
  return result;
}

LightMapped<DisplayLightImage> map_picture(const SceneImage& picture, std::optional<double> ln_luminance,
                                           const RayReinhardOptions& options, int threads) {
  options.validate();
  LightMapped<DisplayLightImage> result{DisplayLightImage(picture.width(), picture.height())};
  if (!ln_luminance) {
    result.undefined = static_cast<std::int64_t>(picture.size());
    return result;
  }
  std::atomic<std::int64_t> clipped = 0;
  parallel_for(picture.height(), 16, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      clipped += map_pixels(picture.row(y), result.light.row(y), picture.width(), options.key, *ln_luminance);
  });
  result.clipped = clipped;
  return result;
}

DisplayImage encoded(const DisplayLightImage& light) {
  DisplayImage image(light.width(), light.height());
  std::transform(light.pixels().begin(), light.pixels().end(), image.pixels().begin(),
                 [](Rgb c) { return gamma_encode(c); });
  return image;
}

}  // namespace plenolab
#endif
