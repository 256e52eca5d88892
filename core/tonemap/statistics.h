#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/image/image.h"
#include "core/image/repair.h"

namespace plenolab {

/// Raw luminance statistics of one view, or of several after `merge`. Values are sums and counts, so that
/// those of a light field can be had from those of its views in any grouping, and so that the log floor
/// (smallest positive luminance of the whole light field) can be chosen afterwards. Unit: that of the
/// radiance.
struct ViewStatistics {
  std::int64_t pixels = 0;
  std::int64_t zero_pixels = 0;  ///< luminance 0 after repair
  PixelRepairs repairs;
  std::array<double, 3> colour_sum{};  ///< r, g, b
  double luminance_sum = 0;
  double log10_sum = 0;      ///< over positive luminances
  double min_positive = 0;   ///< 0 if no pixel is positive
  double max_luminance = 0;  ///< 0 if no pixel is positive
  /// Sorted (bin, count) of positive luminances; bins are 2^-8 of an octave's lower end wide (0.4 %).
  std::vector<std::pair<std::uint32_t, std::int64_t>> bins;
  friend bool operator==(const ViewStatistics&, const ViewStatistics&) = default;
};

/// Measures a view of any size ≥ 0; NaN, Inf and negative values count as core/image/repair.h replaces them.
/// Bit-identical for any number of threads.
ViewStatistics measure_view(const SceneImage& view, int threads = 0);

/// Statistics of all pixels of both together.
ViewStatistics merge(const ViewStatistics& a, const ViewStatistics& b);
ViewStatistics merge(std::span<const ViewStatistics> views);

/// The numbers that operators are fitted to. Logs are log10 of luminance, with `log floor` in place of
/// luminance 0 where it says so. A view without a positive pixel has averages 0, and the floor for all logs.
struct ImageStatistics {
  std::array<double, 3> average_colour{};  ///< arithmetic, per channel
  double average_luminance = 0;            ///< arithmetic
  double log_average = 0;                  ///< mean of log L, floored
  double log_min = 0, log_max = 0;         ///< extremes of log L, floored
  double log_p1 = 0, log_p99 = 0;          ///< percentiles of log L over positive pixels, to 0.4 %
  /// Mean of log L over positive pixels with log L cut to [log_p1, log_p99] (a winsorised mean): neither
  /// black pixels nor a few outliers of any size can move it.
  double log_robust_average = 0;
  friend bool operator==(const ImageStatistics&, const ImageStatistics&) = default;
};

/// Log floor of a light field with these statistics: its smallest positive luminance; 1 if there is none.
double log_floor(const ViewStatistics& light_field);

/// Evaluates statistics with a given log floor > 0 (see log_floor). At least one pixel, else InputError.
ImageStatistics evaluate(const ViewStatistics& statistics, double floor);

/// Weighted sum of statistics, number by number (thesis, section 5.2.2: averages and the three logs are
/// blended bilinearly). As many weights as statistics, each ≥ 0, with a sum within 1e-6 of 1; else
/// InputError. Equal statistics give themselves up to rounding.
ImageStatistics blend(std::span<const ImageStatistics> statistics, std::span<const double> weights);

}  // namespace plenolab
