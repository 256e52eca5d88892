#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lut/lut.h"

namespace plenolab {

struct GradeOptions {
  LutInterpolation interpolation = LutInterpolation::kTetrahedral;
  int threads = 0;  ///< 0 = all cores
};

struct GradedImage {
  DisplayImage image;
  std::int64_t cut = 0;  ///< channel values that left [0, 1] and were cut
};

/// A table prepared for fast use: nodes padded to four values, one more at the end of each axis.
class PreparedLut {
 public:
  /// Throws InputError if the table is not valid.
  explicit PreparedLut(const Lut& lut);
  /// Graded image, the same for any number of threads; agrees with sample_lut to rounding.
  GradedImage grade(const DisplayImage& image, const GradeOptions& options = {}) const;

 private:
  friend class RowGrader;
  Lut header_;                ///< without nodes
  std::vector<float> nodes_;  ///< four values each
};

/// Every pixel by the table of its own: tables[of_pixel], all valid indices. As fast as one table where
/// neighbours share theirs. Throws InputError for different sizes.
GradedImage grade_by_map(const DisplayImage& image, const Plane<int>& of_pixel,
                         std::span<const PreparedLut* const> tables, const GradeOptions& options = {});

}  // namespace plenolab
