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
void write_grey(const fs::path& file, const Plane<float>& plane, double black, double white) {
  DisplayImage image(plane.width(), plane.height());
  const double scale = white > black ? 1 / (white - black) : 0;
  std::transform(plane.pixels().begin(), plane.pixels().end(), image.pixels().begin(), [&](float v) {
    const float grey = static_cast<float>(std::clamp((static_cast<double>(v) - black) * scale, 0.0, 1.0));
    return Rgb{grey, grey, grey};
  });
  write_display_image(file, image);
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

ResultTable write_layers(const BilateralLayers& layers, const DisplayImage& result, const fs::path& folder) {
  const Plane<float> detail = layers.detail();
  const bool enhanced = !layers.foreground.empty();
  const Plane<float> temporary = enhanced ? difference(layers.base, layers.foreground) : Plane<float>();
  BaseRange range = measure_base(layers).extremes;
  for (const float v : temporary.pixels())
    range = {std::min(range.min, static_cast<double>(v)), std::max(range.max, static_cast<double>(v))};
  const std::vector<float> magnitudes = sorted_magnitudes(detail, layers.foreground);
  const double scale = quantile_of_sorted(std::span<const float>(magnitudes), kShownShare);
  const auto cut = magnitudes.end() - std::upper_bound(magnitudes.begin(), magnitudes.end(), scale);
  write_grey(folder / "base.png", layers.base, range.min, range.max);
  write_grey(folder / "detail.png", detail, -scale, scale);
  std::vector<ExrExtraChannel> channels{
      {"log_luminance", &layers.log_luminance}, {"base", &layers.base}, {"detail", &detail}};
  if (enhanced) {
    write_grey(folder / "temporary.png", temporary, range.min, range.max);
    write_grey(folder / "foreground.png", layers.foreground, -scale, scale);
    channels.push_back({"foreground", &layers.foreground});
    channels.push_back({"temporary", &temporary});
  }
  write_exr(folder / "layers.exr", result, channels, {.colour_type = ExrPixelType::kFloat});
  ResultTable table;
  table.add({"base_min", range.min, "log10 units", {}});
  table.add({"base_max", range.max, "log10 units", {}});
  table.add({"detail_scale", scale, "log10 units", {}});
  table.add({"detail_cut", static_cast<double>(cut), "px", {}});
  return table;
}

}  // namespace plenolab
