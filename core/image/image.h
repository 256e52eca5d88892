#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace plenolab {

/// One colour, linear or encoded as its owner says; BT.709 primaries throughout.
struct Rgb {
  float r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr Rgb operator+(Rgb a, Rgb b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Rgb operator-(Rgb a, Rgb b) {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr Rgb operator*(Rgb a, Rgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
constexpr Rgb operator*(Rgb a, float k) {
  return {a.r * k, a.g * k, a.b * k};
}
constexpr Rgb operator*(float k, Rgb a) {
  return a * k;
}
constexpr Rgb& operator+=(Rgb& a, Rgb b) {
  return a = a + b;
}

/// A rectangular array of values, row by row, row 0 at the top. Pixel (x, y) covers [x, x+1) × [y, y+1): its
/// centre is at (x + 0.5, y + 0.5) in image coordinates.
template <class T, class Allocator = std::allocator<T>>
class Plane {
 public:
  Plane() = default;
  Plane(int width, int height, T fill = T{})
      : width_(width),
        height_(height),
        data_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return data_.size(); }
  bool empty() const { return data_.empty(); }
  T& at(int x, int y) { return data_[index(x, y)]; }
  const T& at(int x, int y) const { return data_[index(x, y)]; }
  T* row(int y) { return data_.data() + index(0, y); }
  const T* row(int y) const { return data_.data() + index(0, y); }
  std::span<T> pixels() { return data_; }
  std::span<const T> pixels() const { return data_; }
  friend bool operator==(const Plane&, const Plane&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_ = 0;
  int height_ = 0;
  std::vector<T, Allocator> data_;
};

/// What the numbers of an image mean. Scene-referred: linear radiance (cd/m² or relative, see its owner),
/// unbounded. Display-referred: encoded code values in [0, 1] as sent to a display. The two do not convert
/// into each other implicitly: wiring one into the other does not compile.
struct SceneReferred {};
struct DisplayReferred {};

/// A colour image of a stated meaning.
template <class Referral>
class RgbImage : public Plane<Rgb> {
 public:
  using Plane<Rgb>::Plane;
};

using SceneImage = RgbImage<SceneReferred>;
using DisplayImage = RgbImage<DisplayReferred>;

/// Disparity in pixels of the image for a displacement of one column spacing, ≥ 0 (0 = infinitely far).
using DisparityMap = Plane<float>;

/// A yes/no value per pixel.
using Mask = Plane<unsigned char>;

}  // namespace plenolab
