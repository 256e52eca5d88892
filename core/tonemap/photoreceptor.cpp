#include "core/tonemap/photoreceptor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/tonemap/row_math.h"

namespace plenolab {

namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

/// The receptor in single precision. V is formed of quarters, so that the sum in its denominator stays
/// finite.
struct RowReceptor {
  float exposure, contrast, scaled_factor;
  float own_colour, own_luminance;  // weights of C[i] and L in I_a
  std::array<float, 3> global;      // (1 − l)·I_global

  explicit RowReceptor(const Photoreceptor& r)
      : exposure(static_cast<float>(r.exposure)),
        contrast(static_cast<float>(r.contrast)),
        scaled_factor(static_cast<float>(0.25 * std::pow(r.factor, r.contrast))),
        own_colour(static_cast<float>(r.light_adaptation * r.colour_adaptation)),
        own_luminance(static_cast<float>(r.light_adaptation * (1 - r.colour_adaptation))) {
    for (std::size_t i = 0; i < 3; ++i)
      global[i] = static_cast<float>((1 - r.light_adaptation) * r.global[i]);
  }

  bool grey_level() const { return own_colour == 0 && global[0] == global[1] && global[1] == global[2]; }
};

float scaled(float value, float exposure) {
  return std::min(value * exposure, kLargest);
}

float response(float c, float adapted) {
  const float quarter = 0.25f * c;
  return quarter > 0 ? quarter / (quarter + adapted) : 0.0f;
}

/// One adaptation level for all channels of a pixel.
void respond_grey_level(const RowReceptor& r, std::span<const Rgb> scene, std::span<Rgb> out,
                        RowBuffers& buffers) {
  buffers.a.resize(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const float l = scaled(luminance(scene[i]), r.exposure);
    buffers.a[i] = std::min(r.own_luminance * l + r.global[0], kLargest);
  }
  power_row(buffers.a, r.contrast, buffers.a);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const float adapted = r.scaled_factor * buffers.a[i];
    out[i] = {response(scaled(scene[i].r, r.exposure), adapted),
              response(scaled(scene[i].g, r.exposure), adapted),
              response(scaled(scene[i].b, r.exposure), adapted)};
  }
}

void respond_colour_level(const RowReceptor& r, std::span<const Rgb> scene, std::span<Rgb> out,
                          RowBuffers& buffers) {
  buffers.a.resize(3 * scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const float shared = r.own_luminance * scaled(luminance(scene[i]), r.exposure);
    const std::array<float, 3> c{scene[i].r, scene[i].g, scene[i].b};
    for (std::size_t k = 0; k < 3; ++k)
      buffers.a[3 * i + k] =
          std::min(r.own_colour * scaled(c[k], r.exposure) + shared + r.global[k], kLargest);
  }
  power_row(buffers.a, r.contrast, buffers.a);
  for (std::size_t i = 0; i < scene.size(); ++i)
    out[i] = {response(scaled(scene[i].r, r.exposure), r.scaled_factor * buffers.a[3 * i]),
              response(scaled(scene[i].g, r.exposure), r.scaled_factor * buffers.a[3 * i + 1]),
              response(scaled(scene[i].b, r.exposure), r.scaled_factor * buffers.a[3 * i + 2])};
}

}  // namespace

void respond_row(const Photoreceptor& receptor, std::span<const Rgb> scene, std::span<Rgb> out,
                 RowBuffers& buffers) {
  const RowReceptor row(receptor);
  if (row.grey_level())
    respond_grey_level(row, scene, out, buffers);
  else
    respond_colour_level(row, scene, out, buffers);
}

double respond_to_grey(const Photoreceptor& r, double luminance) {
  const double c = r.exposure * luminance;
  if (!(c > 0)) return 0;
  const double level = r.light_adaptation * c + (1 - r.light_adaptation) * r.global[0];
  return c / (c + std::pow(r.factor * level, r.contrast));
}

double contrast_of(double log_min, double log_average, double log_max) {
  const double range = log_max - log_min;
  const double k = range > 0 ? std::clamp((log_max - log_average) / range, 0.0, 1.0) : 0.5;
  return 0.3 + 0.7 * std::pow(k, 1.4);
}

void validate_photoreceptor(double brightness, double colour_adaptation, double light_adaptation) {
  if (!(std::abs(brightness) <= 8))
    throw InputError(fmt::format("the brightness must lie in [-8, 8], not {}", brightness));
  if (!(colour_adaptation >= 0 && colour_adaptation <= 1))
    throw InputError(fmt::format("the colour adaptation must lie in [0, 1], not {}", colour_adaptation));
  if (!(light_adaptation >= 0 && light_adaptation <= 1))
    throw InputError(fmt::format("the light adaptation must lie in [0, 1], not {}", light_adaptation));
}

}  // namespace plenolab
