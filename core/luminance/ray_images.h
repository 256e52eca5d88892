#pragma once

#include <vector>

#include "core/base/huge_pages.h"
#include "core/image/image.h"
#include "core/image/repair.h"
#include "core/luminance/ray_display.h"

namespace plenolab {

/// One value for each ray of a display. Columns are contiguous, since all rays of a column of a display with
/// horizontal parallax have the same observer position.
template <class T>
class RayValues {
 public:
  RayValues() = default;
  explicit RayValues(RayCount size, T fill = T{}) : size_(size), values_(size.total(), fill) {}

  const RayCount& size() const { return size_; }
  bool empty() const { return values_.empty(); }
  T* column(int image, int u) { return values_.data() + offset(image, u); }
  const T* column(int image, int u) const { return values_.data() + offset(image, u); }
  T& at(const Ray& ray) { return column(ray.image, ray.u)[ray.v]; }
  const T& at(const Ray& ray) const { return column(ray.image, ray.u)[ray.v]; }
  friend bool operator==(const RayValues&, const RayValues&) = default;

 private:
  std::size_t offset(int image, int u) const {
    return (static_cast<std::size_t>(image) * static_cast<std::size_t>(size_.width) +
            static_cast<std::size_t>(u)) *
           static_cast<std::size_t>(size_.height);
  }
  RayCount size_{0, 0, 0};
  std::vector<T, HugePageAllocator<T>> values_;
};

/// Light that a display emits, linear, 1 = its white; what tone mapping per ray yields. Encode it
/// (gamma_encode) for a DisplayImage.
struct DisplayLight {};
using DisplayLightImage = RgbImage<DisplayLight>;

/// The images of a display in colour, of a stated meaning.
template <class Referral>
class RayImages : public RayValues<Rgb> {
 public:
  using RayValues<Rgb>::RayValues;
};
/// Scene radiance in cd/m², linear BT.709.
using SceneRays = RayImages<SceneReferred>;
using DisplayRays = RayImages<DisplayLight>;

/// Replaces NaN, infinite and negative channel values as core/image/repair.h does, and says how many.
PixelRepairs repair(SceneRays& rays);

/// Luminance of all rays in cd/m² (Lum3D in the paper). Rays must be finite and ≥ 0: repair those from
/// outside first.
RayValues<float> luminance_of(const SceneRays& rays, int threads = 0);

/// Image k as a picture with rows, and back. Sizes must agree.
SceneImage image_of(const SceneRays& rays, int k);
void set_image(SceneRays& rays, int k, const SceneImage& image);

}  // namespace plenolab
