#include "metrics/drim.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "metrics/fill_invalid.h"
#include "metrics/vision/cortex.h"
#include "metrics/vision/perceived_contrast.h"
#include "metrics/vision/spectrum.h"

namespace plenolab {
namespace {

using vision::Canvas;
using vision::CortexLayout;
using vision::Spectrum;

constexpr int kRowsAtOnce = 32;
constexpr float kShown = 0.5f;  // probability from which a pixel counts as distorted

/// Responses of one image in one band, by orientation: contrast, and the largest in the neighbourhood.
struct BandContrast {
  std::vector<Plane<float>> contrast, largest;
};

/// Largest magnitude within `radius` pixels in both directions.
Plane<float> largest_near(const Plane<float>& contrast, int radius) {
  Plane<float> magnitude(contrast.width(), contrast.height());
  std::transform(contrast.pixels().begin(), contrast.pixels().end(), magnitude.pixels().begin(),
                 [](float v) { return std::abs(v); });
  Plane<float> largest(contrast.width(), contrast.height());
  const cv::Mat from(contrast.height(), contrast.width(), CV_32F, magnitude.pixels().data());
  cv::Mat to(contrast.height(), contrast.width(), CV_32F, largest.pixels().data());
  const int side = 2 * radius + 1;
  cv::dilate(from, to, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  return largest;
}

/// Two orientations (real and imaginary part) of a band, cut from the canvas.
void store_pair(BandContrast& band, const Spectrum& filtered, const Canvas& canvas, int orientation,
                int radius) {
  const auto count = static_cast<int>(band.contrast.size());
  for (int part = 0; part < 2 && orientation + part < count; ++part) {
    Plane<float> contrast(canvas.width, canvas.height);
    for (int y = 0; y < canvas.height; ++y)
      for (int x = 0; x < canvas.width; ++x)
        contrast.at(x, y) = part == 0 ? filtered.at(x, y).real() : filtered.at(x, y).imag();
    const auto slot = static_cast<std::size_t>(orientation + part);
    band.largest[slot] = largest_near(contrast, radius);
    band.contrast[slot] = std::move(contrast);
  }
}

vision::PairResponse pair_response(const CortexLayout& layout, int band, int orientation) {
  return [=](double x, double y) -> vision::FilterPair {
    const double response = vision::band_response(layout, band, std::sqrt(x * x + y * y));
    if (response == 0) return {};
    const bool has_second = orientation + 1 < layout.orientations;
    return {static_cast<float>(response * vision::orientation_response(layout, orientation, x, y)),
            has_second
                ? static_cast<float>(response * vision::orientation_response(layout, orientation + 1, x, y))
                : 0.0f};
  };
}

/// One band of both images; pairs of orientations run in parallel.
std::array<BandContrast, 2> band_of_both(const std::array<Spectrum, 2>& spectra, const Canvas& canvas,
                                         const CortexLayout& layout, int band, int threads) {
  const auto count = static_cast<std::size_t>(layout.orientations);
  std::array<BandContrast, 2> result;
  for (BandContrast& image : result)
    image = {std::vector<Plane<float>>(count), std::vector<Plane<float>>(count)};
  const int radius = std::max(1, static_cast<int>(std::lround(0.25 / vision::lower_edge(band))));
  const int pairs = (layout.orientations + 1) / 2;
  parallel_for(2 * pairs, 1, threads, [&](int begin, int end) {
    for (int task = begin; task < end; ++task) {
      const auto image = static_cast<std::size_t>(task / pairs);
      const int orientation = 2 * (task % pairs);
      store_pair(result[image], vision::filter(spectra[image], pair_response(layout, band, orientation), 1),
                 canvas, orientation, radius);
    }
  });
  return result;
}

/// exp(−|C·scale|^3.5): the probability that a contrast is not detected.
float undetected(float contrast, float scale) {
  const float c = std::abs(contrast) * scale;
  return std::exp(-c * c * c * std::sqrt(c));
}

/// Contrasts of one pixel in one band and orientation.
struct Contrasts {
  float test = 0, reference = 0, largest_test = 0, largest_reference = 0;
};

/// Factors on contrast before the psychometric function, for visible and for invisible.
struct Scales {
  float visible = 1, invisible = 1;
};

/// Multiplies the probabilities that a pixel has no distortion by those of one band. Few pixels meet a
/// condition; probabilities are computed for these alone.
void account(const Contrasts& c, const Scales& scales, float& no_loss, float& no_amplification,
             float& no_reversal) {
  if (c.largest_test < std::abs(c.reference))
    no_loss *=
        1 - (1 - undetected(c.reference, scales.visible)) * undetected(c.largest_test, scales.invisible);
  if (c.largest_reference < std::abs(c.test))
    no_amplification *=
        1 - (1 - undetected(c.test, scales.visible)) * undetected(c.largest_reference, scales.invisible);
  if (c.test * c.reference < 0)
    no_reversal *=
        1 - (1 - undetected(c.reference, scales.visible)) * (1 - undetected(c.test, scales.visible));
}

void account_band(DrimMaps& clean, const std::array<BandContrast, 2>& band, const Scales& scales,
                  int threads) {
  parallel_for(clean.loss.height(), kRowsAtOnce, threads, [&](int begin, int end) {
    for (std::size_t l = 0; l < band[0].contrast.size(); ++l) {
      for (int y = begin; y < end; ++y) {
        for (int x = 0; x < clean.loss.width(); ++x) {
          const Contrasts c{band[0].contrast[l].at(x, y), band[1].contrast[l].at(x, y),
                            band[0].largest[l].at(x, y), band[1].largest[l].at(x, y)};
          account(c, scales, clean.loss.at(x, y), clean.amplification.at(x, y), clean.reversal.at(x, y));
        }
      }
    }
  });
}

void turn_into_probabilities(Plane<float>& clean) {
  for (float& v : clean.pixels()) v = std::clamp(1 - v, 0.0f, 1.0f);
}

DrimMaps valid_maps(const Plane<float>& test, const Plane<float>& reference,
                    const ComparisonConditions& conditions, const DrimOptions& options) {
  DrimMaps maps = drim_maps(fill_invalid(test, conditions.valid), fill_invalid(reference, conditions.valid),
                            conditions.viewing, options, conditions.threads);
  for (std::size_t i = 0; i < maps.loss.size(); ++i)
    if (!is_valid(conditions.valid, i))
      maps.loss.pixels()[i] = maps.amplification.pixels()[i] = maps.reversal.pixels()[i] = 0;
  return maps;
}

template <class Test, class Reference>
std::vector<Measurement> measure_maps(const Test& test, const Reference& reference,
                                      const ComparisonConditions& conditions) {
  return drim_measurements(drim_maps(test, reference, conditions), conditions.valid);
}

}  // namespace

void DrimOptions::validate() const {
  if (bands < 1 || bands > 12)
    throw InputError(fmt::format("the number of bands is {} but must lie in [1, 12]", bands));
  if (orientations < 1 || orientations > 24)
    throw InputError(fmt::format("the number of orientations is {} but must lie in [1, 24]", orientations));
  if (!(threshold_jnd > 0 && threshold_jnd <= 100))
    throw InputError(fmt::format("threshold_jnd is {} but must lie in (0, 100]", threshold_jnd));
  if (!(margin_log10 >= 0 && margin_log10 <= 2))
    throw InputError(fmt::format("margin_log10 is {} but must lie in [0, 2]", margin_log10));
}

DrimMaps drim_maps(const Plane<float>& test_cd_m2, const Plane<float>& reference_cd_m2,
                   const ViewingConditions& viewing, const DrimOptions& options, int threads) {
  options.validate();
  viewing.validate();
  const int width = test_cd_m2.width(), height = test_cd_m2.height();
  if (width != reference_cd_m2.width() || height != reference_cd_m2.height() || test_cd_m2.empty())
    throw InputError(fmt::format("DRIM compares images of one size, not {}×{} with {}×{}", width, height,
                                 reference_cd_m2.width(), reference_cd_m2.height()));
  const Canvas canvas = vision::canvas_for(width, height);
  const std::array<const Plane<float>*, 2> images{&test_cd_m2, &reference_cd_m2};
  std::array<Spectrum, 2> spectra;
  parallel_for(2, 1, threads, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      spectra[i] =
          vision::spectrum_of(vision::pad(vision::perceived_contrast(*images[i], viewing, threads), canvas));
  });
  const CortexLayout layout{options.bands, options.orientations};
  const double half_margin = std::pow(10, options.margin_log10 / 2);
  const Scales scales{static_cast<float>(1 / (options.threshold_jnd * half_margin)),
                      static_cast<float>(half_margin / options.threshold_jnd)};
  const Plane<float> ones(width, height, 1);
  DrimMaps maps{ones, ones, ones};
  for (int band = 0; band < layout.bands; ++band)
    account_band(maps, band_of_both(spectra, canvas, layout, band, threads), scales, threads);
  for (Plane<float>* map : {&maps.loss, &maps.amplification, &maps.reversal}) turn_into_probabilities(*map);
  return maps;
}

DrimMaps drim_maps(const SceneImage& test, const SceneImage& reference,
                   const ComparisonConditions& conditions, const DrimOptions& options) {
  check_comparable(test, reference, conditions);
  return valid_maps(scene_luminance(test, conditions.cd_m2_per_unit),
                    scene_luminance(reference, conditions.cd_m2_per_unit), conditions, options);
}

DrimMaps drim_maps(const DisplayImage& test, const SceneImage& reference,
                   const ComparisonConditions& conditions, const DrimOptions& options) {
  check_comparable(test, reference, conditions);
  return valid_maps(displayed_luminance(test, conditions.viewing),
                    scene_luminance(reference, conditions.cd_m2_per_unit), conditions, options);
}

DrimMaps drim_maps(const DisplayImage& test, const DisplayImage& reference,
                   const ComparisonConditions& conditions, const DrimOptions& options) {
  check_comparable(test, reference, conditions);
  return valid_maps(displayed_luminance(test, conditions.viewing),
                    displayed_luminance(reference, conditions.viewing), conditions, options);
}

std::vector<Measurement> drim_measurements(const DrimMaps& maps, const Mask* valid) {
  std::array<double, 3> sum{};
  std::array<std::int64_t, 3> shown{};
  std::int64_t any = 0, pixels = 0;
  for (std::size_t i = 0; i < maps.loss.size(); ++i) {
    if (!is_valid(valid, i)) continue;
    const std::array<float, 3> p{maps.loss.pixels()[i], maps.amplification.pixels()[i],
                                 maps.reversal.pixels()[i]};
    for (std::size_t kind = 0; kind < 3; ++kind) {
      sum[kind] += static_cast<double>(p[kind]);
      shown[kind] += p[kind] >= kShown;
    }
    any += *std::max_element(p.begin(), p.end()) >= kShown;
    ++pixels;
  }
  const auto share = [&](std::int64_t count) {
    return static_cast<double>(count) / static_cast<double>(pixels);
  };
  const auto percent = [&](double total) { return 100 * total / static_cast<double>(pixels); };
  return {{"drim_share_any", share(any), "1"},
          {"drim_share_loss", share(shown[0]), "1"},
          {"drim_share_amplification", share(shown[1]), "1"},
          {"drim_share_reversal", share(shown[2]), "1"},
          {"drim_mean_loss", percent(sum[0]), "%"},
          {"drim_mean_amplification", percent(sum[1]), "%"},
          {"drim_mean_reversal", percent(sum[2]), "%"},
          {"drim_mean_total", percent(sum[0] + sum[1] + sum[2]), "%"}};
}

std::vector<Measurement> drim(const SceneImage& test, const SceneImage& reference,
                              const ComparisonConditions& conditions) {
  return measure_maps(test, reference, conditions);
}

std::vector<Measurement> drim(const DisplayImage& test, const SceneImage& reference,
                              const ComparisonConditions& conditions) {
  return measure_maps(test, reference, conditions);
}

std::vector<Measurement> drim(const DisplayImage& test, const DisplayImage& reference,
                              const ComparisonConditions& conditions) {
  return measure_maps(test, reference, conditions);
}

DisplayImage drim_false_colour(const DrimMaps& maps, const DisplayImage& backdrop) {
  PLENOLAB_CHECK(maps.loss.width() == backdrop.width() && maps.loss.height() == backdrop.height(),
                 "maps and backdrop differ in size");
  constexpr Rgb kLoss{0, 0.75f, 0.1f}, kAmplification{0.1f, 0.3f, 1}, kReversal{0.9f, 0.1f, 0.05f};
  DisplayImage picture(backdrop.width(), backdrop.height());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const float loss = maps.loss.pixels()[i], gain = maps.amplification.pixels()[i],
                reversal = maps.reversal.pixels()[i];
    const float strongest = std::max({loss, gain, reversal});
    const Rgb colour = strongest == loss ? kLoss : strongest == gain ? kAmplification : kReversal;
    // The darker half of grey stays visible below the colours.
    const float grey = 0.15f + 0.7f * luminance(backdrop.pixels()[i]);
    picture.pixels()[i] = (1 - strongest) * Rgb{grey, grey, grey} + strongest * colour;
  }
  return picture;
}

}  // namespace plenolab
