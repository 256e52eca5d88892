#include "core/tonemap/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

// Bins of equal leading bits: 8 bits of exponent and 8 of mantissa.
constexpr int kDroppedBits = 15;
constexpr std::size_t kBins = std::size_t{1} << (31 - kDroppedBits);
constexpr int kSlabs = 8;  // each has bins of its own; fixed, so that sums do not depend on threads

float bin_edge(std::uint32_t bin) {
  return std::bit_cast<float>(bin << kDroppedBits);
}

struct RowSums {
  std::array<double, 3> colour{};
  double luminance = 0, log10 = 0;
  std::int64_t zeros = 0;
  float min_positive = std::numeric_limits<float>::max(), max = 0;
};

/// Sum in a fixed order of eight interleaved partial sums, which vectorises.
double sum_of(std::span<const float> values) {
  std::array<double, 8> part{};
  std::size_t i = 0;
  for (; i + 8 <= values.size(); i += 8)
    for (std::size_t k = 0; k < 8; ++k) part[k] += static_cast<double>(values[i + k]);
  for (std::size_t k = 0; i < values.size(); ++i, ++k) part[k] += static_cast<double>(values[i]);
  return std::accumulate(part.begin(), part.end(), 0.0);
}

/// Buffers of one row.
struct RowChannels {
  std::array<std::vector<float>, 3> colour;
  std::vector<float> luminance;
};

/// Sums of one row; its luminances are counted in `bins`.
RowSums sum_row(std::span<const Rgb> row, RowChannels& channels, std::vector<std::uint32_t>& bins) {
  auto& [r, g, b] = channels.colour;
  for (std::vector<float>* v : {&r, &g, &b, &channels.luminance}) v->resize(row.size());
  split_row(row, r, g, b);
  std::vector<float>& luminance = channels.luminance;
  luminance_row(row, luminance);
  RowSums sums{.colour = {sum_of(r), sum_of(g), sum_of(b)}, .luminance = sum_of(luminance)};
  for (float& l : luminance) {
    sums.max = std::max(sums.max, l);
    const bool positive = l > 0;
    if (positive) sums.min_positive = std::min(sums.min_positive, l);
    sums.zeros += positive ? 0 : 1;
    ++bins[std::bit_cast<std::uint32_t>(std::abs(l)) >> kDroppedBits];
    l = positive ? l : 1.0f;  // adds nothing to the sum of logs
  }
  bins[0] -= static_cast<std::uint32_t>(sums.zeros);
  log10_row(luminance, luminance);
  sums.log10 = sum_of(luminance);
  return sums;
}

void add_row(const RowSums& row, ViewStatistics& total) {
  for (std::size_t i = 0; i < 3; ++i) total.colour_sum[i] += row.colour[i];
  total.luminance_sum += row.luminance;
  total.log10_sum += row.log10;
  total.zero_pixels += row.zeros;
  if (row.max <= 0) return;
  const double lowest = static_cast<double>(row.min_positive);
  total.min_positive = total.min_positive > 0 ? std::min(total.min_positive, lowest) : lowest;
  total.max_luminance = std::max(total.max_luminance, static_cast<double>(row.max));
}

using Bins = std::vector<std::uint32_t>;

void collect_bins(const std::vector<Bins>& slabs, ViewStatistics& total) {
  std::vector<std::int64_t> sum(kBins, 0);
  for (const Bins& slab : slabs)
    std::transform(slab.begin(), slab.end(), sum.begin(), sum.begin(),
                   [](std::uint32_t a, std::int64_t b) { return static_cast<std::int64_t>(a) + b; });
  for (std::size_t b = 0; b < kBins; ++b)
    if (sum[b] > 0) total.bins.emplace_back(static_cast<std::uint32_t>(b), sum[b]);
}

/// Statistics of a view without defects; nothing if it has some, which are found on the way.
std::optional<ViewStatistics> measure_usable(const SceneImage& image, int threads) {
  std::vector<RowSums> rows(static_cast<std::size_t>(image.height()));
  std::vector<Bins> slabs(kSlabs);
  std::atomic<bool> usable = true;
  parallel_for(kSlabs, 1, threads, [&](int begin, int end) {
    RowChannels channels;
    for (int slab = begin; slab < end; ++slab) {
      const int first = image.height() * slab / kSlabs, last = image.height() * (slab + 1) / kSlabs;
      if (first == last) continue;
      Bins& bins = slabs[static_cast<std::size_t>(slab)];
      bins.assign(kBins, 0);
      for (int y = first; y < last && usable; ++y) {
        const std::span<const Rgb> row(image.row(y), static_cast<std::size_t>(image.width()));
        if (all_usable(row))
          rows[static_cast<std::size_t>(y)] = sum_row(row, channels, bins);
        else
          usable = false;
      }
    }
  });
  if (!usable) return std::nullopt;
  ViewStatistics total;
  total.pixels = static_cast<std::int64_t>(image.size());
  for (const RowSums& row : rows) add_row(row, total);
  collect_bins(slabs, total);
  return total;
}

/// log10 of the luminance of rank p·(n − 1) among the positive ones, linear inside the bin.
double log_percentile(const ViewStatistics& s, double p) {
  const double rank = p * static_cast<double>(s.pixels - s.zero_pixels - 1);
  double before = 0;
  for (const auto& [bin, count] : s.bins) {
    const double n = static_cast<double>(count);
    if (rank < before + n) {
      const double low = static_cast<double>(bin_edge(bin)), high = static_cast<double>(bin_edge(bin + 1));
      const double value = low + (high - low) * (rank - before + 0.5) / n;
      return std::log10(std::clamp(value, s.min_positive, s.max_luminance));
    }
    before += n;
  }
  return std::log10(s.max_luminance);
}

double winsorised_log_average(const ViewStatistics& s, double log_low, double log_high) {
  double sum = 0;
  for (const auto& [bin, count] : s.bins) {
    const double centre = 0.5 * (static_cast<double>(bin_edge(bin)) + static_cast<double>(bin_edge(bin + 1)));
    sum += static_cast<double>(count) * std::clamp(std::log10(centre), log_low, log_high);
  }
  return std::clamp(sum / static_cast<double>(s.pixels - s.zero_pixels), log_low, log_high);
}

using BinCounts = decltype(ViewStatistics::bins);

BinCounts merge_bins(const BinCounts& a, const BinCounts& b) {
  BinCounts all;
  all.reserve(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  BinCounts sum;
  for (const auto& [bin, count] : all) {
    if (!sum.empty() && sum.back().first == bin)
      sum.back().second += count;
    else
      sum.emplace_back(bin, count);
  }
  return sum;
}

void evaluate_positive(const ViewStatistics& s, double log_of_floor, ImageStatistics& out) {
  const double log_min_positive = std::log10(s.min_positive);
  out.log_max = std::log10(s.max_luminance);
  out.log_min = s.zero_pixels > 0 ? std::min(log_of_floor, log_min_positive) : log_min_positive;
  const double sum = s.log10_sum + static_cast<double>(s.zero_pixels) * log_of_floor;
  // The sum of many rounded logs must not leave the range.
  out.log_average = std::clamp(sum / static_cast<double>(s.pixels), out.log_min, out.log_max);
  out.log_p1 = log_percentile(s, 0.01);
  out.log_p99 = log_percentile(s, 0.99);
  out.log_robust_average = winsorised_log_average(s, out.log_p1, out.log_p99);
}

void add_weighted(const ImageStatistics& s, double w, ImageStatistics& sum) {
  for (std::size_t i = 0; i < 3; ++i) sum.average_colour[i] += w * s.average_colour[i];
  sum.average_luminance += w * s.average_luminance;
  sum.log_average += w * s.log_average;
  sum.log_min += w * s.log_min;
  sum.log_max += w * s.log_max;
  sum.log_p1 += w * s.log_p1;
  sum.log_p99 += w * s.log_p99;
  sum.log_robust_average += w * s.log_robust_average;
}

}  // namespace

ViewStatistics measure_view(const SceneImage& view, int threads) {
  if (std::optional<ViewStatistics> statistics = measure_usable(view, threads)) return *statistics;
  SceneImage copy = view;
  const PixelRepairs repairs = repair(copy);
  std::optional<ViewStatistics> statistics = measure_usable(copy, threads);
  PLENOLAB_CHECK(statistics.has_value(), "a repaired view has no defects");
  statistics->repairs = repairs;
  return *statistics;
}

ViewStatistics merge(const ViewStatistics& a, const ViewStatistics& b) {
  ViewStatistics sum = a;
  sum.pixels += b.pixels;
  sum.zero_pixels += b.zero_pixels;
  sum.repairs.nan += b.repairs.nan;
  sum.repairs.positive_infinity += b.repairs.positive_infinity;
  sum.repairs.negative += b.repairs.negative;
  for (std::size_t i = 0; i < 3; ++i) sum.colour_sum[i] += b.colour_sum[i];
  sum.luminance_sum += b.luminance_sum;
  sum.log10_sum += b.log10_sum;
  if (b.min_positive > 0)
    sum.min_positive = a.min_positive > 0 ? std::min(a.min_positive, b.min_positive) : b.min_positive;
  sum.max_luminance = std::max(a.max_luminance, b.max_luminance);
  sum.bins = merge_bins(a.bins, b.bins);
  return sum;
}

ViewStatistics merge(std::span<const ViewStatistics> views) {
  return std::accumulate(views.begin(), views.end(), ViewStatistics{},
                         [](const ViewStatistics& a, const ViewStatistics& b) { return merge(a, b); });
}

double log_floor(const ViewStatistics& light_field) {
  return light_field.min_positive > 0 ? light_field.min_positive : 1.0;
}

ImageStatistics evaluate(const ViewStatistics& s, double floor) {
  if (s.pixels == 0)
    throw InputError("an image without pixels has no statistics; give one of at least 1 × 1");
  if (!(floor > 0) || !std::isfinite(floor))
    throw InputError(fmt::format("the log floor must be a positive luminance, not {}", floor));
  ImageStatistics out;
  const double n = static_cast<double>(s.pixels);
  for (std::size_t i = 0; i < 3; ++i) out.average_colour[i] = s.colour_sum[i] / n;
  out.average_luminance = s.luminance_sum / n;
  const double log_of_floor = std::log10(floor);
  if (s.max_luminance > 0)
    evaluate_positive(s, log_of_floor, out);
  else
    out.log_average = out.log_min = out.log_max = out.log_p1 = out.log_p99 = out.log_robust_average =
        log_of_floor;
  return out;
}

ImageStatistics blend(std::span<const ImageStatistics> statistics, std::span<const double> weights) {
  if (statistics.empty() || statistics.size() != weights.size())
    throw InputError(fmt::format("{} statistics cannot be blended with {} weights; give one weight each",
                                 statistics.size(), weights.size()));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return !(w >= 0); }) ||
      !(std::abs(sum - 1) <= 1e-6))
    throw InputError(fmt::format("weights of statistics must be ≥ 0 with a sum of 1, not {}", sum));
  ImageStatistics out;
  for (std::size_t i = 0; i < statistics.size(); ++i) add_weighted(statistics[i], weights[i], out);
  return out;
}

}  // namespace plenolab
