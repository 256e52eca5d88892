#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "metrics/comparison.h"

namespace plenolab {

/// Which values of a quantity mean a test image nearer to its reference.
enum class Better {
  kHigher,
  kLower,
  kNearerZero,  ///< signed errors
  kNeither,     ///< describes the comparison, e.g. the share of clipped pixels
};

/// What one number of a metric means.
struct MetricQuantity {
  std::string name;  ///< stable, in snake case, as in Measurement::quantity
  std::string unit;
  Better better = Better::kLower;
  double minimum = 0, maximum = 0;  ///< range of values, may be infinite
  double identical = 0;             ///< value for two equal images (NaN = depends on the image)
  std::string meaning;              ///< one sentence
  bool monotone = true;             ///< never better with more noise; else only in the large
};

/// A metric: compares a test image with a reference of the same size, or judges an image without one.
struct Metric {
  std::string name;                        ///< on the command line, e.g. "psnr_gamma"
  std::string family;                      ///< selects several at once, e.g. "psnr"
  std::string summary;                     ///< one sentence with the source
  bool symmetric = true;                   ///< swapping test and reference changes nothing but signs
  std::vector<MetricQuantity> quantities;  ///< in the order in which compare functions return them
  /// Scene-referred images; empty if the metric does not take them.
  std::function<std::vector<Measurement>(const SceneImage& test, const SceneImage& reference,
                                         const ComparisonConditions&)>
      compare_scene;
  /// Display-referred images (compared as encoded, exposure unused); empty if the metric does not take them.
  std::function<std::vector<Measurement>(const DisplayImage& test, const DisplayImage& reference,
                                         const ComparisonConditions&)>
      compare_display;
  /// A tone mapped image with the scene it shows; empty if the metric does not take them.
  std::function<std::vector<Measurement>(const DisplayImage& test, const SceneImage& reference,
                                         const ComparisonConditions&)>
      compare_mapped;
  /// A display-referred image alone; empty for metrics that need a reference, and the only one that is not
  /// empty for those that take none.
  std::function<std::vector<Measurement>(const DisplayImage& test, const ComparisonConditions&)> judge;
  bool viewing = false;             ///< whether the numbers depend on the viewing conditions
  bool absolute_luminance = false;  ///< whether the numbers mean nothing without the scale of scene images
};

/// All metrics. Adding one: a file with its function and a line in metrics/table.cpp.
std::span<const Metric> metrics();

/// The metrics named: each name is that of a metric, of a family, or "all"; in table order, each once. Throws
/// InputError listing the known names for an unknown one.
std::vector<const Metric*> select_metrics(std::span<const std::string> names);

}  // namespace plenolab
