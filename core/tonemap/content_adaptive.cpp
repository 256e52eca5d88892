#include "core/tonemap/content_adaptive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/pq_operator.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kBins = PqHistogram::kBins;
constexpr double kLargestSignal = 1.95;
constexpr double kGamma = 2.2;
constexpr double kResponsePower = 0.73;
constexpr int kRowsAtOnce = 32;

std::size_t bin_of(double signal, double signal_max) {
  return static_cast<std::size_t>(std::clamp(signal / signal_max * kBins, 0.0, kBins - 1.0));
}

/// Luminance at the lower end of a bin; the upper end of the last one is that of bin kBins.
double bin_end(int bin, double signal_max) {
  return pq_luminance(signal_max * bin / kBins);
}

/// Rise over each bin of a function of luminance.
template <class Function>
std::vector<double> rises(double signal_max, Function function) {
  std::vector<double> result;
  double below = function(bin_end(0, signal_max));
  for (int bin = 0; bin < kBins; ++bin) {
    const double above = function(bin_end(bin + 1, signal_max));
    result.push_back(above - below);
    below = above;
  }
  return result;
}

double photographic_luma(double luminance, double key_over_average) {
  const double scaled = luminance * key_over_average;
  return std::pow(scaled / (1 + scaled), 1 / kGamma);
}

double response(double luminance, double average) {
  const double l = std::pow(luminance / average, kResponsePower);
  return l / (l + 1);
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Lowers low bins to their bound; returns what each gave.
std::vector<double> take_from_low(std::vector<double>& slopes, const BinSplit& split,
                                  const std::vector<double>& responses, double kappa) {
  const double scale = kappa * total(slopes) / total(responses);
  std::vector<double> given(slopes.size());
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (split.heavy[i]) continue;
    given[i] = std::max(0.0, slopes[i] - scale * responses[i]);
    slopes[i] -= given[i];
  }
  return given;
}

/// Gives the heavy bins equal parts of `freed`, up to the cap; what is left goes back to where it came from.
void give_to_heavy(std::vector<double>& slopes, const std::vector<double>& photographic,
                   const BinSplit& split, const std::vector<double>& given, const std::optional<double>& cap,
                   ContentAdaptiveCurve& curve) {
  const double freed = total(given);
  const double part = freed / split.heavy_count;
  double left = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!split.heavy[i]) continue;
    slopes[i] += part;
    if (cap && slopes[i] > *cap * photographic[i]) {
      left += slopes[i] - *cap * photographic[i];
      slopes[i] = *cap * photographic[i];
      ++curve.capped_bins;
    }
    if (photographic[i] > 0) curve.largest_rise = std::max(curve.largest_rise, slopes[i] / photographic[i]);
  }
  if (freed > 0)
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] += left / freed * given[i];
}

/// Why a histogram cannot tell low from heavy bins; empty if it can.
std::string why_plain(const PqHistogram& histogram, const BinSplit& split) {
  const auto filled =
      std::count_if(histogram.counts.begin(), histogram.counts.end(), [](std::int64_t n) { return n > 0; });
  if (filled <= 1) return "all luminances lie in one bin";
  if (split.heavy_count == 0) return "no bin stands out";
  return "";
}

}  // namespace

void ContentAdaptiveOptions::validate() const {
  if (!(key > 0 && key <= 4)) throw InputError(fmt::format("the key must lie in (0, 4], not {}", key));
  if (!(kappa >= 0 && kappa <= 1)) throw InputError(fmt::format("kappa must lie in [0, 1], not {}", kappa));
  if (slope_cap && !(*slope_cap >= 1))
    throw InputError(fmt::format("the slope cap must be at least 1, not {}", *slope_cap));
  if (!(colour_exponent >= 0 && colour_exponent <= 1))
    throw InputError(fmt::format("the colour exponent must lie in [0, 1], not {}", colour_exponent));
  if (!(cd_m2_per_unit > 0 && std::isfinite(cd_m2_per_unit)))
    throw InputError(fmt::format("the luminance of radiance 1 must be positive, not {}", cd_m2_per_unit));
}

PqHistogram measure_pq_histogram(const Plane<float>& luminance_cd_m2, double largest_cd_m2, int threads) {
  PqHistogram histogram;
  histogram.counts.assign(kBins, 0);
  histogram.signal_max = std::clamp(pq_signal(largest_cd_m2), 1.0, kLargestSignal);
  Plane<std::uint16_t> bins(luminance_cd_m2.width(), luminance_cd_m2.height());
  // What counts as the largest signal has its luminance in the average, too: else all would be dark to it.
  const double most_cd_m2 = pq_luminance(kLargestSignal);
  parallel_for(bins.height(), kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < bins.width(); ++x)
        bins.at(x, y) = static_cast<std::uint16_t>(
            bin_of(pq_signal(static_cast<double>(luminance_cd_m2.at(x, y))), histogram.signal_max));
  });
  for (std::size_t i = 0; i < bins.size(); ++i) {
    ++histogram.counts[bins.pixels()[i]];
    const float luminance = luminance_cd_m2.pixels()[i];
    if (!(luminance > 0)) continue;
    histogram.log10_sum += std::log10(std::min(static_cast<double>(luminance), most_cd_m2));
    ++histogram.positive;
  }
  return histogram;
}

PqHistogram merge(const PqHistogram& a, const PqHistogram& b) {
  PLENOLAB_CHECK(a.signal_max == b.signal_max && a.counts.size() == b.counts.size(),
                 "histograms of different bins");
  PqHistogram sum = a;
  for (std::size_t i = 0; i < sum.counts.size(); ++i) sum.counts[i] += b.counts[i];
  sum.log10_sum += b.log10_sum;
  sum.positive += b.positive;
  return sum;
}

BinSplit split_by_entropy(const std::vector<std::int64_t>& counts) {
  std::vector<double> sorted(counts.begin(), counts.end());
  std::sort(sorted.begin(), sorted.end());
  // Entropy of a part with sum S and Σ n·ln n = T is ln S − T/S.
  const auto entropy = [](double sum, double sum_n_log_n) {
    return sum > 0 ? std::log(sum) - sum_n_log_n / sum : 0;
  };
  const auto n_log_n = [](double n) { return n > 0 ? n * std::log(n) : 0; };
  double all = 0, all_t = 0, low = 0, low_t = 0;
  for (const double n : sorted) all += n, all_t += n_log_n(n);
  double best = -1, threshold = sorted.empty() ? 0 : sorted.back();
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    low += sorted[i], low_t += n_log_n(sorted[i]);
    const double value = entropy(low, low_t) + entropy(all - low, all_t - low_t);
    if (low > 0 && value > best) best = value, threshold = sorted[i];
  }
  BinSplit split;
  for (const std::int64_t n : counts) {
    split.heavy.push_back(static_cast<double>(n) > threshold);
    split.heavy_count += split.heavy.back();
  }
  return split;
}

float ContentAdaptiveCurve::at(double luminance_cd_m2) const {
  const double position = std::clamp(pq_signal(luminance_cd_m2) / signal_max, 0.0, 1.0) * kBins;
  const auto bin = static_cast<std::size_t>(std::min(position, kBins - 1.0));
  const auto t = static_cast<float>(position - static_cast<double>(bin));
  return (1 - t) * luma[bin] + t * luma[bin + 1];
}

ContentAdaptiveCurve fit_curve(const ContentAdaptiveOptions& options, const PqHistogram& histogram) {
  options.validate();
  const double average = std::pow(10, std::clamp(histogram.log_average(), -30.0, 30.0));
  const std::vector<double> photographic = rises(histogram.signal_max, [&](double luminance) {
    return photographic_luma(luminance, options.key / average);
  });
  ContentAdaptiveCurve curve;
  curve.signal_max = histogram.signal_max;
  const BinSplit split = split_by_entropy(histogram.counts);
  curve.plain = why_plain(histogram, split);
  std::vector<double> slopes = photographic;
  if (curve.plain.empty()) {
    curve.heavy_bins = split.heavy_count;
    const std::vector<double> responses =
        rises(histogram.signal_max, [&](double luminance) { return response(luminance, average); });
    const std::vector<double> given = take_from_low(slopes, split, responses, options.kappa);
    give_to_heavy(slopes, photographic, split, given, options.slope_cap, curve);
  }
  double luma = 0;
  curve.luma.push_back(0);
  for (const double slope : slopes) curve.luma.push_back(static_cast<float>(luma += slope));
  return curve;
}

Plane<float> apply_curve(const ContentAdaptiveCurve& curve, const Plane<float>& luminance_cd_m2) {
  Plane<float> luma(luminance_cd_m2.width(), luminance_cd_m2.height());
  for (std::size_t i = 0; i < luma.size(); ++i)
    luma.pixels()[i] = curve.at(static_cast<double>(luminance_cd_m2.pixels()[i]));
  return luma;
}

ContentAdaptiveParameters fit(const ContentAdaptiveOptions& options, const PqHistogram& histogram) {
  return {fit_curve(options, histogram), options.colour_exponent, options.cd_m2_per_unit};
}

ToneMapped apply(const ContentAdaptiveParameters& p, const SceneImage& view, int threads) {
  return map_rows(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts& counts) {
        buffers.a.resize(scene.size());
        luminance_row(scene, buffers.a);
        for (float& v : buffers.a) v = p.curve.at(static_cast<double>(v) * p.cd_m2_per_unit);
        counts.clipped_high += apply_colour_ratio(scene, buffers.a, p.colour_exponent, out);
      });
}

}  // namespace plenolab
