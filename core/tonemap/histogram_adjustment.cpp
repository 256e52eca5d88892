#include "core/tonemap/histogram_adjustment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr double kGamma = 2.2;
constexpr int kSlabs = 8;  // of rows, counted side by side

/// Bin of log luminance; the ends take what lies outside.
int bin_of(double log_luminance, const LogHistogram& h) {
  const int bins = static_cast<int>(h.counts.size());
  const double range = h.log_max - h.log_min;
  if (!(range > 0)) return bins - 1;
  const double position = (log_luminance - h.log_min) / range * bins;
  return static_cast<int>(std::clamp(std::floor(position), 0.0, static_cast<double>(bins - 1)));
}

/// log10 of the luminances of a row; `floored` counts those of 0, which have that of `floor`.
void log_luminance_row(std::span<const Rgb> scene, float floor, std::vector<float>& out,
                       std::int64_t& floored) {
  out.resize(scene.size());
  luminance_row(scene, out);
  for (float& l : out) {
    floored += l > 0 ? 0 : 1;
    l = l > 0 ? l : floor;
  }
  log10_row(out, out);
}

/// Adds rows [first, last) of a repaired view. Counts are whole, so their order does not matter.
void count_rows(const SceneImage& image, int first, int last, float floor, LogHistogram& histogram) {
  std::vector<float> logs;
  std::int64_t floored = 0;
  for (int y = first; y < last; ++y) {
    log_luminance_row({image.row(y), static_cast<std::size_t>(image.width())}, floor, logs, floored);
    for (const float v : logs)
      histogram.counts[static_cast<std::size_t>(bin_of(static_cast<double>(v), histogram))] += 1;
  }
}

/// Ceiling of each bin for a total T.
class Ceiling {
 public:
  Ceiling(const HistogramOptions& options, const LogHistogram& histogram)
      : options_(options),
        log_unit_(std::log10(options.cd_m2_per_unit)),
        log_min_(histogram.log_min),
        bin_width_((histogram.log_max - histogram.log_min) / static_cast<double>(histogram.counts.size())),
        log_display_min_(std::log10(options.display_min_cd_m2)),
        log_contrast_(std::log10(options.display_max_cd_m2 / options.display_min_cd_m2)) {}

  /// `cumulative` = p at the centre of the bin, of the total.
  double of(int bin, double cumulative, double total) const {
    // Printed: log c / (range·N), range = Δb·N.
    const double ratio = as_printed() ? log_contrast_ / (bin_width_ * bins2()) : bin_width_ / log_contrast_;
    return ratio * total * (perceptual() ? perceptual_factor(bin, cumulative) : 1.0);
  }

 private:
  bool as_printed() const {
    return options_.ceiling == HistogramCeiling::kAsPrinted ||
           options_.ceiling == HistogramCeiling::kLinearAsPrinted;
  }
  bool perceptual() const {
    return options_.ceiling == HistogramCeiling::kPerceptual ||
           options_.ceiling == HistogramCeiling::kAsPrinted;
  }
  double bins2() const { return static_cast<double>(options_.bins) * static_cast<double>(options_.bins); }

  /// Visible steps of the scene over those of the display, ΔL_t(L_d)/L_d · L_w/ΔL_t(L_w).
  double perceptual_factor(int bin, double cumulative) const {
    const double world = std::pow(10.0, log_unit_ + log_min_ + (bin + 0.5) * bin_width_);
    const double display = std::pow(10.0, log_display_min_ + log_contrast_ * cumulative);
    return just_noticeable_difference_cd_m2(display) / display * world /
           just_noticeable_difference_cd_m2(world);
  }

  const HistogramOptions& options_;
  double log_unit_, log_min_, bin_width_, log_display_min_, log_contrast_;
};

double total_of(const std::vector<double>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0.0);
}

/// Trims every bin to its ceiling, all computed from the counts before the pass.
TrimmingPass trim_once(const Ceiling& ceiling, std::vector<double>& counts) {
  TrimmingPass pass{.total = total_of(counts)};
  double below = 0;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    const double count = counts[b];
    const double limit = ceiling.of(static_cast<int>(b), (below + 0.5 * count) / pass.total, pass.total);
    below += count;
    if (count <= limit) continue;
    pass.trimmed += count - limit;
    ++pass.bins;
    counts[b] = limit;
  }
  return pass;
}

/// Trims until the rule of the options ends it; false if the total falls below `tolerance` pixels.
bool trim(const HistogramOptions& options, const Ceiling& ceiling, double tolerance,
          std::vector<double>& counts, std::vector<TrimmingPass>& passes) {
  for (int n = 0; !options.fixed_passes || n < *options.fixed_passes; ++n) {
    passes.push_back(trim_once(ceiling, counts));
    if (passes.back().total - passes.back().trimmed < tolerance) return false;
    if (!options.fixed_passes && passes.back().trimmed <= tolerance) return true;
  }
  return true;
}

std::vector<double> cumulative_of(const std::vector<double>& counts) {
  std::vector<double> p(counts.size() + 1, 0.0);
  std::partial_sum(counts.begin(), counts.end(), p.begin() + 1);
  const double total = p.back();
  for (double& v : p) v /= total;
  return p;
}

/// The mapping with what does not depend on the pixel computed once.
class Curve {
 public:
  explicit Curve(const HistogramParameters& p)
      : edges_(p.cumulative),
        log_min_(p.log_min),
        log_max_(p.log_max),
        bins_per_unit_(p.linear ? 0 : static_cast<double>(p.cumulative.size() - 1) / (p.log_max - p.log_min)),
        display_min_(p.log_display_min),
        display_range_(p.log_display_max - p.log_display_min),
        linear_shift_(p.log_display_max - p.log_max) {}

  /// log10 L → log10 L_d; L outside the histogram counts as its end.
  double at(double log_luminance) const {
    const double inside = std::clamp(log_luminance, log_min_, log_max_);
    if (edges_.empty()) return inside + linear_shift_;
    const double position = (inside - log_min_) * bins_per_unit_;
    const std::size_t bin = std::min(static_cast<std::size_t>(position), edges_.size() - 2);
    const double below = edges_[bin];
    const double p = below + (edges_[bin + 1] - below) * (position - static_cast<double>(bin));
    return display_min_ + display_range_ * std::min(p, 1.0);
  }

 private:
  const std::vector<double>& edges_;
  double log_min_, log_max_, bins_per_unit_, display_min_, display_range_, linear_shift_;
};

/// log10 L_d → (L_d − L_dmin)/(L_dmax − L_dmin), cut to [0, 1] with counts.
void display_luma_row(const HistogramParameters& p, std::span<float> values, MappingCounts& counts) {
  exp10_row(values, values);
  const float low = static_cast<float>(std::pow(10.0, p.log_display_min));
  const float range = static_cast<float>(std::pow(10.0, p.log_display_max)) - low;
  // Rounding of logs at the ends of the display is no clipping.
  constexpr float kRounding = 1e-5f;
  for (float& v : values) {
    const float share = (v - low) / range;
    counts.clipped_high += share > 1 + kRounding ? 1 : 0;
    counts.clipped_low += share < -kRounding ? 1 : 0;
    v = std::clamp(share, 0.0f, 1.0f);
  }
  power_row(values, static_cast<float>(1 / kGamma), values);
}

void check_display(const HistogramOptions& o) {
  if (!(o.display_min_cd_m2 > 0 && o.display_min_cd_m2 < o.display_max_cd_m2 && o.display_max_cd_m2 <= 1e6))
    throw InputError(
        fmt::format("the display must satisfy 0 < darkest < brightest ≤ 1e6 cd/m², not {} and {}",
                    o.display_min_cd_m2, o.display_max_cd_m2));
}

}  // namespace

void HistogramOptions::validate() const {
  check_display(*this);
  if (bins < 2 || bins > 65536)
    throw InputError(fmt::format("the number of histogram bins must lie in [2, 65536], not {}", bins));
  if (!(tolerance > 0 && tolerance < 1))
    throw InputError(fmt::format("the trimming tolerance must lie in (0, 1), not {}", tolerance));
  if (fixed_passes && (*fixed_passes < 0 || *fixed_passes > 1000))
    throw InputError(
        fmt::format("the number of trimming passes must lie in [0, 1000], not {}", *fixed_passes));
  if (!(colour_exponent >= 0 && colour_exponent <= 1))
    throw InputError(fmt::format("the colour exponent must lie in [0, 1], not {}", colour_exponent));
  if (!(cd_m2_per_unit > 0 && cd_m2_per_unit <= 1e12))
    throw InputError(fmt::format("cd/m² per unit must lie in (0, 1e12], not {}", cd_m2_per_unit));
}

LogHistogram measure_histogram(const SceneImage& view, double floor, double log_min, double log_max, int bins,
                               int threads) {
  PLENOLAB_CHECK(floor > 0 && log_min <= log_max && bins > 0, "floor > 0, log_min ≤ log_max, bins > 0");
  const RepairedView repaired(view, threads);
  const SceneImage& image = repaired.image();
  const LogHistogram empty{log_min, log_max, std::vector<double>(static_cast<std::size_t>(bins), 0.0)};
  std::vector<LogHistogram> slabs(kSlabs, empty);
  parallel_for(kSlabs, 1, threads, [&](int begin, int end) {
    for (int slab = begin; slab < end; ++slab)
      count_rows(image, image.height() * slab / kSlabs, image.height() * (slab + 1) / kSlabs,
                 static_cast<float>(floor), slabs[static_cast<std::size_t>(slab)]);
  });
  return std::accumulate(slabs.begin(), slabs.end(), empty,
                         [](const LogHistogram& a, const LogHistogram& b) { return merge(a, b); });
}

LogHistogram merge(const LogHistogram& a, const LogHistogram& b) {
  PLENOLAB_CHECK(a.log_min == b.log_min && a.log_max == b.log_max && a.counts.size() == b.counts.size(),
                 "histograms of one range and number of bins");
  LogHistogram sum = a;
  for (std::size_t i = 0; i < sum.counts.size(); ++i) sum.counts[i] += b.counts[i];
  return sum;
}

double just_noticeable_difference_cd_m2(double luminance_cd_m2) {
  if (luminance_cd_m2 < 1.148e-4) return 1.38e-3;
  const double t = std::log10(luminance_cd_m2);
  if (t < -1.44) return std::pow(10.0, std::pow(std::max(0.405 * t + 1.6, 0.0), 2.18) - 2.86);
  if (t < -0.0184) return std::pow(10.0, t - 0.395);
  if (t < 1.9) return std::pow(10.0, std::pow(0.249 * t + 0.65, 2.7) - 0.72);
  return std::pow(10.0, t - 1.255);
}

bool fits_display(const HistogramOptions& options, double log_min, double log_max) {
  return log_max - log_min <= std::log10(options.display_max_cd_m2) - std::log10(options.display_min_cd_m2);
}

HistogramParameters fit(const HistogramOptions& options, const LogHistogram& histogram, double floor) {
  options.validate();
  PLENOLAB_CHECK(histogram.counts.size() == static_cast<std::size_t>(options.bins), "bins as in the options");
  HistogramParameters p;
  p.floor = floor;
  p.log_min = histogram.log_min;
  p.log_max = histogram.log_max;
  p.log_display_min = std::log10(options.display_min_cd_m2);
  p.log_display_max = std::log10(options.display_max_cd_m2);
  p.colour_exponent = options.colour_exponent;
  const double range = p.log_max - p.log_min, display_range = p.log_display_max - p.log_display_min;
  if (fits_display(options, p.log_min, p.log_max)) {
    p.linear = true;
    p.linear_because =
        fmt::format("the range of {:.2f} log10 units fits the display's {:.2f}", range, display_range);
    return p;
  }
  std::vector<double> counts = histogram.counts;
  const double initial = total_of(counts), tolerance = options.tolerance * initial;
  PLENOLAB_CHECK(initial > 0, "a histogram of at least one pixel");
  if (trim(options, Ceiling(options, histogram), tolerance, counts, p.passes)) {
    p.cumulative = cumulative_of(counts);
    return p;
  }
  p.linear = true;
  p.linear_because = fmt::format("trimming left less than {:.1f} % of the pixels after {} passes",
                                 100 * options.tolerance, p.passes.size());
  return p;
}

double display_log_luminance(const HistogramParameters& p, double log_luminance) {
  return Curve(p).at(log_luminance);
}

ToneMapped apply(const HistogramParameters& p, const SceneImage& view, int threads) {
  const Curve curve(p);
  return map_rows(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts& counts) {
        log_luminance_row(scene, static_cast<float>(p.floor), buffers.a, counts.floored_pixels);
        for (float& v : buffers.a) v = static_cast<float>(curve.at(static_cast<double>(v)));
        display_luma_row(p, buffers.a, counts);
        counts.clipped_high += apply_colour_ratio(scene, buffers.a, p.colour_exponent, out);
      });
}

}  // namespace plenolab
