#include "experiments/colour_error.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace plenolab {

Plane<CieLab> lab_of(const DisplayImage& picture, int threads) {
  Plane<CieLab> lab(picture.width(), picture.height());
  parallel_for(picture.height(), 4, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < picture.width(); ++x) lab.at(x, y) = lab_of_display(picture.at(x, y));
  });
  return lab;
}

ColourError colour_error(const Plane<CieLab>& test, const Plane<CieLab>& reference) {
  PLENOLAB_CHECK(test.width() == reference.width() && test.height() == reference.height() && !test.empty(),
                 "pictures of equal sizes");
  ColourError error;
  for (std::size_t i = 0; i < test.size(); ++i) {
    const double e = delta_e(test.pixels()[i], reference.pixels()[i]);
    error.mean += e / static_cast<double>(test.size());
    error.largest = std::max(error.largest, e);
  }
  return error;
}

ColourError colour_error(const DisplayImage& test, const DisplayImage& reference, int threads) {
  return colour_error(lab_of(test, threads), lab_of(reference, threads));
}

}  // namespace plenolab
