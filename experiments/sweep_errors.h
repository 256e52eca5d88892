#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/error.h"
#include "core/image/image.h"

namespace plenolab {

/// Root mean square and largest absolute difference, collected plane by plane.
class DifferenceSum {
 public:
  void add(const Plane<float>& a, const Plane<float>& b) {
    PLENOLAB_CHECK(a.size() == b.size(), "planes differ in size");
    for (std::size_t i = 0; i < a.size(); ++i) add(a.pixels()[i] - b.pixels()[i]);
  }
  void add(const DisplayImage& a, const DisplayImage& b) {
    PLENOLAB_CHECK(a.size() == b.size(), "images differ in size");
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Rgb d = a.pixels()[i] - b.pixels()[i];
      add(d.r);
      add(d.g);
      add(d.b);
    }
  }
  double rms() const { return count_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(count_)); }
  double largest() const { return largest_; }

 private:
  void add(float difference) {
    const double d = static_cast<double>(difference);
    squares_ += d * d;
    largest_ = std::max(largest_, std::abs(d));
    ++count_;
  }
  double squares_ = 0, largest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace plenolab
