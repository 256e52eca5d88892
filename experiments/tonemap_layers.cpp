#include "experiments/tonemap_layers.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/quantile.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr double kShownShare = 0.99;

/// Grey picture of (v − black)/(white − black), cut to [0, 1].
DisplayImage grey_picture(const Plane<float>& plane, double black, double white) {
  DisplayImage image(plane.width(), plane.height());
  const double scale = white > black ? 1 / (white - black) : 0;
  std::transform(plane.pixels().begin(), plane.pixels().end(), image.pixels().begin(), [&](float v) {
    const float grey = static_cast<float>(std::clamp((static_cast<double>(v) - black) * scale, 0.0, 1.0));
    return Rgb{grey, grey, grey};
  });
  return image;
}

Plane<float> difference(const Plane<float>& a, const Plane<float>& b) {
  Plane<float> result = a;
  std::transform(a.pixels().begin(), a.pixels().end(), b.pixels().begin(), result.pixels().begin(),
                 std::minus<float>());
  return result;
}

/// Absolute values of the planes, in ascending order.
std::vector<float> sorted_magnitudes(const Plane<float>& a, const Plane<float>& b) {
  std::vector<float> values;
  for (const Plane<float>* plane : {&a, &b})
    for (const float v : plane->pixels()) values.push_back(std::abs(v));
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace

LayerPictures picture_layers(const BilateralLayers& layers, double base_outliers) {
  const Plane<float> detail = layers.detail(), temporary = temporary_layer(layers);
  BaseHistogram bases = measure_base(layers);
  if (!temporary.empty()) bases = merge(std::move(bases), measure_base({.base = temporary}));
  const BaseRange range = range_of(bases, base_outliers);
  const std::vector<float> magnitudes = sorted_magnitudes(detail, layers.foreground);
  const double scale = quantile_of_sorted(std::span<const float>(magnitudes), kShownShare);
  LayerPictures shown{
      .pictures = {{"base", grey_picture(layers.base, range.min, range.max)},
                   {"detail", grey_picture(detail, -scale, scale)}},
      .base_range = range,
      .detail_scale = scale,
      .detail_cut = magnitudes.end() - std::upper_bound(magnitudes.begin(), magnitudes.end(), scale)};
  if (layers.foreground.empty()) return shown;
  shown.pictures.push_back({"temporary", grey_picture(temporary, range.min, range.max)});
  shown.pictures.push_back({"foreground", grey_picture(layers.foreground, -scale, scale)});
  return shown;
}

Plane<float> temporary_layer(const BilateralLayers& layers) {
  return layers.foreground.empty() ? Plane<float>() : difference(layers.base, layers.foreground);
}

ResultTable write_layers(const BilateralLayers& layers, const DisplayImage& result, const fs::path& folder) {
  const LayerPictures shown = picture_layers(layers);
  for (const LayerPicture& picture : shown.pictures)
    write_display_image(folder / (picture.name + ".png"), picture.image);
  const Plane<float> detail = layers.detail(), temporary = temporary_layer(layers);
  std::vector<ExrExtraChannel> channels{
      {"log_luminance", &layers.log_luminance}, {"base", &layers.base}, {"detail", &detail}};
  if (!temporary.empty()) {
    channels.push_back({"foreground", &layers.foreground});
    channels.push_back({"temporary", &temporary});
  }
  write_exr(folder / "layers.exr", result, channels, {.colour_type = ExrPixelType::kFloat});
  ResultTable table;
  table.add({"base_min", shown.base_range.min, "log10 units", {}});
  table.add({"base_max", shown.base_range.max, "log10 units", {}});
  table.add({"detail_scale", shown.detail_scale, "log10 units", {}});
  table.add({"detail_cut", static_cast<double>(shown.detail_cut), "px", {}});
  return table;
}

}  // namespace plenolab
