#include "core/lightfield/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/image/colour.h"

namespace plenolab {

namespace {

// Luminance percentiles from a histogram of log10, fine enough for 0.01 and wide enough for every float.
constexpr double kLowestLog10 = -46, kHighestLog10 = 40, kBinsPerDecade = 200;
constexpr std::size_t kBins = static_cast<std::size_t>((kHighestLog10 - kLowestLog10) * kBinsPerDecade);

constexpr float kDepthEdge_px = 1.0f;

class Measurement {
 public:
  template <class Referral>
  double add(const KeyView<Referral>& view) {
    add_disparity(view.disparity);
    return add_colour(view.colour);
  }

  void finish(LightFieldProfile& p) const {
    p.min_disparity_px = lowest_;
    p.max_disparity_px = highest_;
    p.constant_disparity = lowest_ == highest_;
    p.depth_edge_share = groups_ > 0 ? static_cast<double>(edges_) / static_cast<double>(groups_) : 0.0;
    p.grey = grey_;
    p.constant_colour = constant_colour_;
    p.defects = defects_;
    if (positive_ == 0) return;
    p.log10_p1 = percentile(0.01);
    p.log10_p99 = percentile(0.99);
    p.dynamic_range_log10 = p.log10_p99 - p.log10_p1;
  }

 private:
  void add_disparity(const DisparityMap& map) {
    for (const float d : map.pixels()) {
      lowest_ = std::min(lowest_, d);
      highest_ = std::max(highest_, d);
    }
    for (int y = 0; y + 1 < map.height(); ++y)
      for (int x = 0; x + 1 < map.width(); ++x) {
        const auto [low, high] =
            std::minmax({map.at(x, y), map.at(x + 1, y), map.at(x, y + 1), map.at(x + 1, y + 1)});
        edges_ += high - low > kDepthEdge_px;
        ++groups_;
      }
  }

  // Mean log luminance of the view's positive finite pixels; NaN if it has none.
  double add_colour(const Plane<Rgb>& colour) {
    double sum = 0;
    std::int64_t count = 0;
    for (const Rgb& c : colour.pixels()) {
      count_defects_of(c);
      if (!has_first_) first_ = c;
      has_first_ = true;
      constant_colour_ = constant_colour_ && c == first_;
      grey_ = grey_ && c.r == c.g && c.g == c.b;
      const float y = luminance(c);
      if (!(y > 0) || !std::isfinite(y)) continue;
      const double log_y = std::log10(double{y});
      ++histogram_[static_cast<std::size_t>((log_y - kLowestLog10) * kBinsPerDecade)];
      sum += log_y;
      ++count;
    }
    positive_ += count;
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }

  void count_defects_of(Rgb c) {
    for (const float v : {c.r, c.g, c.b}) {
      if (std::isnan(v)) {
        ++defects_.nan;
        // Neither grey nor colour can be told from what is not a number: prune nothing.
        grey_ = constant_colour_ = false;
      } else if (v < 0) {
        ++defects_.negative;
      } else if (std::isinf(v)) {
        ++defects_.positive_infinity;
      }
    }
  }

  double percentile(double share) const {
    const auto wanted = static_cast<std::int64_t>(share * static_cast<double>(positive_ - 1)) + 1;
    std::int64_t seen = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      seen += histogram_[bin];
      if (seen >= wanted) return kLowestLog10 + (static_cast<double>(bin) + 0.5) / kBinsPerDecade;
    }
    return kHighestLog10;
  }

  float lowest_ = std::numeric_limits<float>::infinity();
  float highest_ = -std::numeric_limits<float>::infinity();
  std::int64_t edges_ = 0, groups_ = 0, positive_ = 0;
  bool grey_ = true, constant_colour_ = true, has_first_ = false;
  Rgb first_;
  PixelRepairs defects_;
  std::vector<std::int64_t> histogram_ = std::vector<std::int64_t>(kBins, 0);
};

double largest_neighbour_ratio(const std::vector<double>& log_average, int columns, int rows) {
  double largest = 0;
  const auto at = [&](int column, int row) {
    return log_average[static_cast<std::size_t>(row * columns + column)];
  };
  const auto compare = [&](double a, double b) {
    if (std::isfinite(a) && std::isfinite(b)) largest = std::max(largest, std::abs(a - b));
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      if (column + 1 < columns) compare(at(column, row), at(column + 1, row));
      if (row + 1 < rows) compare(at(column, row), at(column, row + 1));
    }
  return std::pow(10.0, largest);
}

template <class Referral>
LightFieldProfile profile_any(const BasicLightField<Referral>& light_field, const Progress& progress) {
  const ViewGrid& grid = light_field.grid();
  LightFieldProfile result;
  result.views = grid.columns * grid.rows;
  Measurement measurement;
  std::vector<double> log_average;
  for (int i = 0; i < result.views; ++i) {
    log_average.push_back(measurement.add(*light_field.view(i % grid.columns, i / grid.columns)));
    if (progress) progress((i + 1.0) / result.views);
  }
  measurement.finish(result);
  result.lighting_change = largest_neighbour_ratio(log_average, grid.columns, grid.rows);
  return result;
}

}  // namespace

LightFieldProfile profile(const LightField& light_field, const Progress& progress) {
  return profile_any(light_field, progress);
}

LightFieldProfile profile(const DisplayLightField& light_field, const Progress& progress) {
  return profile_any(light_field, progress);
}

}  // namespace plenolab
