#include "core/tonemap/generic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/input_policy.h"
#include "core/tonemap/map_rows.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;
constexpr double kCentres[]{1 / 4.0, 1 / 16.0, 1 / 64.0};  // cycles/px, finest first
constexpr double kOctaves = 2;                             // to either side of a centre

void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw InputError(fmt::format("{} must lie in [{:g}, {:g}], not {}", name, low, high, value));
}

double band(std::size_t index, double cycles_per_px) {
  const double octaves = std::log2(cycles_per_px / kCentres[index]);
  if (index == 0 && octaves > 0) return 1;
  return std::abs(octaves) < kOctaves ? 0.5 * (1 + std::cos(std::numbers::pi * octaves / kOctaves)) : 0;
}

bool has_gains(const GenericOptions& o) {
  return o.fine != 0 || o.middle != 0 || o.coarse != 0;
}

/// Even lengths, which the cosine transform needs; the last row or column is repeated.
cv::Mat even_copy(const Plane<float>& plane) {
  cv::Mat even(plane.height() + plane.height() % 2, plane.width() + plane.width() % 2, CV_32F);
  for (int y = 0; y < even.rows; ++y) {
    const float* row = plane.row(std::min(y, plane.height() - 1));
    std::copy(row, row + plane.width(), even.ptr<float>(y));
    if (even.cols > plane.width()) even.at<float>(y, plane.width()) = row[plane.width() - 1];
  }
  return even;
}

/// Luma of log10 luminance, in the steps of generic_curve.
void curve_row(const GenericParameters& p, std::span<float> log_luminance) {
  const GenericOptions& o = p.options;
  const auto b = static_cast<float>(o.brightness), half_c = static_cast<float>(o.contrast / 2);
  const auto d_l = static_cast<float>(o.low_range), d_h = static_cast<float>(o.high_range);
  const auto a_l = static_cast<float>((o.contrast * o.low_range - 1) / o.low_range);
  const auto a_h = static_cast<float>((o.contrast * o.high_range - 1) / o.high_range);
  const auto average = static_cast<float>(p.log_average);
  for (float& v : log_luminance) {
    const float t = std::min(std::max(v - average - b, -d_l), d_h);
    const float bend = t > 0 ? a_h : -a_l;
    v = std::min(std::max(half_c * t / (1 + bend * t) + 0.5f, 0.0f), 1.0f);
  }
}

/// Luma of a row; luminance 0 has luma 0.
void luma_row(const GenericParameters& p, std::span<const Rgb> scene, std::span<float> luma) {
  luminance_row(scene, luma);
  for (float& l : luma) l = std::max(l, std::numeric_limits<float>::min());
  log10_row(luma, luma);
  curve_row(p, luma);
}

std::int64_t cut_row(std::span<float> luma) {
  std::int64_t cut = 0;
  for (float& v : luma) {
    cut += v < 0 ? 1 : 0;
    v = std::max(v, 0.0f);
  }
  return cut;
}

/// With gains the whole plane of luma comes first.
ToneMapped apply_with_gains(const GenericParameters& p, const SceneImage& view, int threads) {
  const RepairedView repaired(view, threads);
  const SceneImage& scene = repaired.image();
  const auto width = static_cast<std::size_t>(scene.width());
  Plane<float> luma(scene.width(), scene.height());
  parallel_for(scene.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) luma_row(p, {scene.row(y), width}, {luma.row(y), width});
  });
  modulate_bands(p.options, luma);
  ToneMapped mapped =
      map_rows(scene, threads,
               [&](int y, std::span<const Rgb> row, std::span<Rgb> out, RowBuffers&, MappingCounts& counts) {
                 const std::span<float> l(luma.row(y), width);
                 counts.clipped_low += cut_row(l);
                 for (float& v : l) {
                   counts.clipped_high += v > 1 ? 1 : 0;
                   v = std::min(v, 1.0f);
                 }
                 counts.clipped_high += apply_colour_ratio(row, l, p.options.colour_exponent, out);
               });
  mapped.counts.repairs = repaired.repairs();
  return mapped;
}

}  // namespace

void GenericOptions::validate() const {
  check_range("brightness b", brightness, -2, 2);
  check_range("the low range d_l", low_range, 0.001, 2.5);
  check_range("the high range d_h", high_range, 0.001, 2.5);
  check_range("the contrast c", contrast, 0.2, 1.5);
  for (const double gain : {fine, middle, coarse}) check_range("a gain of a band", gain, -2, 2);
  check_range("the colour exponent", colour_exponent, 0, 1);
  check_range("the scale of the bands", band_scale, 1, 64);
}

double generic_curve(const GenericOptions& o, double x) {
  const double t = x - o.brightness;
  if (t <= -o.low_range) return 0;
  if (t > o.high_range) return 1;
  const double a_l = (o.contrast * o.low_range - 1) / o.low_range;
  const double a_h = (o.contrast * o.high_range - 1) / o.high_range;
  return 0.5 * o.contrast * t / (1 + (t > 0 ? a_h : -a_l) * t) + 0.5;
}

double band_log2_gain(const GenericOptions& o, double cycles_per_px) {
  if (!(cycles_per_px > 0)) return 0;
  const double f = cycles_per_px * o.band_scale;
  return o.fine * band(0, f) + o.middle * band(1, f) + o.coarse * band(2, f);
}

void modulate_bands(const GenericOptions& options, Plane<float>& luma) {
  if (!has_gains(options) || luma.empty()) return;
  cv::Mat spectrum = even_copy(luma);
  cv::dct(spectrum, spectrum);
  for (int v = 0; v < spectrum.rows; ++v)
    for (int u = 0; u < spectrum.cols; ++u) {
      const double f = std::hypot(0.5 * u / spectrum.cols, 0.5 * v / spectrum.rows);
      spectrum.at<float>(v, u) *= static_cast<float>(std::exp2(band_log2_gain(options, f)));
    }
  cv::idct(spectrum, spectrum);
  for (int y = 0; y < luma.height(); ++y)
    std::copy(spectrum.ptr<float>(y), spectrum.ptr<float>(y) + luma.width(), luma.row(y));
}

GenericParameters fit(const GenericOptions& options, const ImageStatistics& statistics) {
  options.validate();
  return {options, std::clamp(statistics.log_average, -37.0, 38.6)};
}

ToneMapped apply(const GenericParameters& p, const SceneImage& view, int threads) {
  if (has_gains(p.options)) return apply_with_gains(p, view, threads);
  return map_rows(
      view, threads,
      [&](int, std::span<const Rgb> scene, std::span<Rgb> out, RowBuffers& buffers, MappingCounts& counts) {
        buffers.a.resize(scene.size());
        luma_row(p, scene, buffers.a);
        counts.clipped_high += apply_colour_ratio(scene, buffers.a, p.options.colour_exponent, out);
      });
}

}  // namespace plenolab
