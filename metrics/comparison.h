#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "metrics/viewing_conditions.h"

namespace plenolab {

/// Under which conditions two images are compared, kept apart from the metrics so that every metric of a
/// report sees the same ones. Take the exposure from the ground truth (exposure_from) and use it for all
/// images compared with it.
struct ComparisonConditions {
  float exposure = 1;  ///< scale before gamma encoding, > 0; display images are encoded already
  double cd_m2_per_unit =
      1;  ///< luminance of a scene value of 1, > 0, for metrics of absolute luminance (PQ, DRIM)
  ViewingConditions viewing;           ///< for metrics of what a viewer sees
  double difference_threshold = 0.02;  ///< encoded differences above it are counted as visible, in [0, 1]
  const Mask* valid = nullptr;         ///< pixels to compare (non-zero), of the images' size; null = all
  int threads = 0;                     ///< 0 = all cores; results do not depend on it

  /// Throws InputError naming the first value out of range.
  void validate() const;
};

/// One measured number. `value` is never NaN; it may be infinite where that is the true result (the PSNR of
/// equal images), which writers of tables must not print as a number.
struct Measurement {
  std::string quantity;  ///< stable name, e.g. "psnr_gamma_db"
  double value = 0;
  std::string unit;  ///< "dB", "1" …

  bool infinite() const {
    return value > std::numeric_limits<double>::max() || value < std::numeric_limits<double>::lowest();
  }
};

/// Checks that two images can be compared: not empty, equal in size, finite, the mask of the same size and
/// not all zero. Throws InputError that names the sizes, or the image and its number of non-finite pixels.
void check_comparable(const SceneImage& test, const SceneImage& reference,
                      const ComparisonConditions& conditions);
void check_comparable(const DisplayImage& test, const DisplayImage& reference,
                      const ComparisonConditions& conditions);
void check_comparable(const DisplayImage& test, const SceneImage& reference,
                      const ComparisonConditions& conditions);

/// Whether the pixel at `index` (row by row) takes part in the comparison.
/// 1 where all channels are finite, else 0: for images that hold NaN or infinity.
Mask mask_of_finite(const Plane<Rgb>& image);

inline bool is_valid(const Mask* mask, std::size_t index) {
  return mask == nullptr || mask->pixels()[index] != 0;
}

}  // namespace plenolab
