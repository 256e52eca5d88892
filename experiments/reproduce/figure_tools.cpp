#include "experiments/reproduce/figure_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

template <class Image>
Image cut(const Image& image, const PixelBox& box) {
  PLENOLAB_CHECK(box.x >= 0 && box.y >= 0 && box.width > 0 && box.height > 0 &&
                     box.x + box.width <= image.width() && box.y + box.height <= image.height(),
                 fmt::format("box {} {} {} {} in {} × {}", box.x, box.y, box.width, box.height, image.width(),
                             image.height()));
  Image part(box.width, box.height);
  for (int y = 0; y < box.height; ++y) std::copy_n(image.row(box.y + y) + box.x, box.width, part.row(y));
  return part;
}

/// Sums over all rectangles from the top-left corner: entry (x, y) covers the pixels left of x and above y.
Plane<double> summed_area(const Plane<float>& values) {
  Plane<double> sums(values.width() + 1, values.height() + 1);
  for (int y = 0; y < values.height(); ++y) {
    double row = 0;
    for (int x = 0; x < values.width(); ++x) {
      row += static_cast<double>(values.at(x, y));
      sums.at(x + 1, y + 1) = sums.at(x + 1, y) + row;
    }
  }
  return sums;
}

double sum_between(const Plane<double>& sums, int x0, int y0, int x1, int y1) {
  return sums.at(x1, y1) - sums.at(x0, y1) - sums.at(x1, y0) + sums.at(x0, y0);
}

float encoded_luma(Rgb c, float exposure) {
  const auto encode = [exposure](float v) { return gamma_encode(std::clamp(v * exposure, 0.0f, 1.0f)); };
  return luminance({encode(c.r), encode(c.g), encode(c.b)});
}

Plane<float> luma_difference(const SceneImage& test, const SceneImage& reference, float exposure) {
  Plane<float> difference(test.width(), test.height());
  for (std::size_t i = 0; i < test.size(); ++i)
    difference.pixels()[i] =
        encoded_luma(test.pixels()[i], exposure) - encoded_luma(reference.pixels()[i], exposure);
  return difference;
}

}  // namespace

SceneImage crop(const SceneImage& image, const PixelBox& box) {
  return cut(image, box);
}

DisplayImage crop(const DisplayImage& image, const PixelBox& box) {
  return cut(image, box);
}

DisplayImage magnify(const DisplayImage& image, int factor) {
  DisplayImage large(image.width() * factor, image.height() * factor);
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x) large.at(x, y) = image.at(x / factor, y / factor);
  return large;
}

DisplayImage mark_box(DisplayImage image, const PixelBox& box, Rgb colour) {
  const int left = std::max(box.x - 1, 0), right = std::min(box.x + box.width, image.width() - 1);
  const int top = std::max(box.y - 1, 0), bottom = std::min(box.y + box.height, image.height() - 1);
  for (int x = left; x <= right; ++x) image.at(x, top) = image.at(x, bottom) = colour;
  for (int y = top; y <= bottom; ++y) image.at(left, y) = image.at(right, y) = colour;
  return image;
}

DisplayImage mark_row(DisplayImage image, int row, Rgb colour) {
  std::fill_n(image.row(row), image.width(), colour);
  return image;
}

DisplayImage mark_column(DisplayImage image, int column, Rgb colour) {
  for (int y = 0; y < image.height(); ++y) image.at(column, y) = colour;
  return image;
}

float figure_exposure(const SceneImage& truth) {
  std::vector<float> luminances;
  for (const Rgb& c : truth.pixels())
    if (const float y = luminance(c); std::isfinite(y) && y >= 0) luminances.push_back(y);
  if (luminances.empty()) return 1;
  std::sort(luminances.begin(), luminances.end());
  const double bright = quantile_of_sorted(std::span<const float>(luminances), 0.95);
  return bright > 0 ? static_cast<float>(1 / bright) : exposure_from(truth);
}

float crop_exposure(const SceneImage& truth, const PixelBox& box) {
  return std::max(figure_exposure(truth), exposure_from(crop(truth, box)));
}

int crop_size(int width, int height) {
  return std::min({std::max(16, width / 6), width, height});
}

PixelBox densest_box(const Plane<float>& weights, int size) {
  const Plane<double> sums = summed_area(weights);
  PixelBox best{(weights.width() - size) / 2, (weights.height() - size) / 2, size, size};
  double most = 0;
  for (int y = 0; y + size <= weights.height(); ++y)
    for (int x = 0; x + size <= weights.width(); ++x) {
      const double sum = sum_between(sums, x, y, x + size, y + size);
      if (sum <= most) continue;
      most = sum;
      best = {x, y, size, size};
    }
  return best;
}

int densest_row(const Plane<float>& weights, const PixelBox& box) {
  const Plane<double> sums = summed_area(weights);
  int best = box.y + box.height / 2;
  double most = 0;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const double sum = sum_between(sums, box.x, y, box.x + box.width, y + 1);
    if (sum <= most) continue;
    most = sum;
    best = y;
  }
  return best;
}

Plane<float> box_mean(const Plane<float>& values, int radius) {
  const Plane<double> sums = summed_area(values);
  Plane<float> means(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) {
      const int x0 = std::max(x - radius, 0), x1 = std::min(x + radius + 1, values.width());
      const int y0 = std::max(y - radius, 0), y1 = std::min(y + radius + 1, values.height());
      means.at(x, y) = static_cast<float>(sum_between(sums, x0, y0, x1, y1) / ((x1 - x0) * (y1 - y0)));
    }
  return means;
}

Plane<float> smoothed_squared_difference(const SceneImage& test, const SceneImage& reference, float exposure,
                                         int radius) {
  Plane<float> smooth = box_mean(luma_difference(test, reference, exposure), radius);
  for (float& v : smooth.pixels()) v *= v;
  return smooth;
}

std::size_t count_set(const Mask& mask) {
  return mask.size() -
         static_cast<std::size_t>(std::count(mask.pixels().begin(), mask.pixels().end(), std::uint8_t{0}));
}

Plane<float> as_weights(const Mask& mask) {
  Plane<float> weights(mask.width(), mask.height());
  std::transform(mask.pixels().begin(), mask.pixels().end(), weights.pixels().begin(),
                 [](unsigned char set) { return set != 0 ? 1.0f : 0.0f; });
  return weights;
}

double rms_difference(const SceneImage& test, const SceneImage& reference, float exposure,
                      const PixelBox& box) {
  const DisplayImage a = expose(crop(test, box), exposure), b = expose(crop(reference, box), exposure);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb d = a.pixels()[i] - b.pixels()[i];
    sum += static_cast<double>(d.r * d.r + d.g * d.g + d.b * d.b);
  }
  return std::sqrt(sum / (3 * static_cast<double>(a.size())));
}

}  // namespace plenolab
