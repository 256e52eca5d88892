#pragma once

#include <array>

#include "core/lightfield/self_check.h"
#include "core/lightfield/self_check_pair.h"

namespace plenolab {

/// Errors of the pairs along one axis, summed.
struct AxisErrors {
  int pairs = 0;
  std::array<double, kDisplacements> error{};
  std::array<double, kScales> scale_error{};

  void add(const PairErrors& pair);
};

/// The verdict on a light field from its pairs between columns (x) and between rows (y), with the errors and
/// scales it rests on and the sentence that explains it. Without any pair it is undecidable.
SelfCheckResult judge(const AxisErrors& x, const AxisErrors& y);

}  // namespace plenolab
