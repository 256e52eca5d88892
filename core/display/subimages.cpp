#include "core/display/subimages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace plenolab {

namespace {

void require_size(const DisplayImage& image, const SubimageLayout& layout) {
  layout.validate();
  if (image.width() != layout.width() || image.height() != layout.height())
    throw InputError(fmt::format(
        "a light-field image of {} × {} subimages of {} px has {} × {} px, not {} × {}", layout.columns,
        layout.rows, layout.size_px, layout.width(), layout.height(), image.width(), image.height()));
}

/// The four inputs of each output pixel along one axis, clamped within its subimage.
std::vector<std::array<int, 4>> box_inputs(int subimages, int size) {
  std::vector<std::array<int, 4>> inputs;
  for (int s = 0; s < subimages; ++s)
    for (int i = 0; i < size / 2; ++i) {
      std::array<int, 4> four;
      for (int k = 0; k < 4; ++k)
        four[static_cast<std::size_t>(k)] = s * size + std::clamp(2 * i - 1 + k, 0, size - 1);
      inputs.push_back(four);
    }
  return inputs;
}

/// Where a panel pixel along one axis reads: two neighbours in one subimage; none outside the array.
struct PanelInput {
  int first = -1, second = -1;
  float weight = 0;  ///< of the second
};

std::vector<PanelInput> panel_inputs(int panel_px, int subimages, double pitch_px, int size) {
  std::vector<PanelInput> inputs(static_cast<std::size_t>(panel_px));
  const double start = (panel_px - subimages * pitch_px) / 2;
  for (int x = 0; x < panel_px; ++x) {
    const double u = (x + 0.5 - start) / pitch_px;
    if (!(u >= 0 && u < subimages)) continue;
    const int lens = static_cast<int>(u);
    const double position = std::clamp((u - lens) * size - 0.5, 0.0, size - 1.0);
    const int first = static_cast<int>(position);
    inputs[static_cast<std::size_t>(x)] = {lens * size + first, lens * size + std::min(first + 1, size - 1),
                                           static_cast<float>(position - first)};
  }
  return inputs;
}

Rgb between(Rgb a, Rgb b, float t) {
  return a + (b - a) * t;  // equal values stay as they are
}

}  // namespace

void SubimageLayout::validate() const {
  if (columns < 1 || rows < 1 || size_px < 1)
    throw InputError(fmt::format("a light-field image needs subimages and pixels, not {} × {} of {} px",
                                 columns, rows, size_px));
  if (size_px > std::numeric_limits<int>::max() / std::max(columns, rows))
    throw InputError(fmt::format("{} × {} subimages of {} px are too many pixels", columns, rows, size_px));
}

DisplayImage subimage(const DisplayImage& light_field, const SubimageLayout& layout, int column, int row) {
  require_size(light_field, layout);
  if (column < 0 || column >= layout.columns || row < 0 || row >= layout.rows)
    throw InputError(fmt::format("there is no subimage at column {}, row {} of {} × {}", column, row,
                                 layout.columns, layout.rows));
  const int n = layout.size_px;
  DisplayImage result(n, n);
  for (int y = 0; y < n; ++y) {
    const Rgb* from = light_field.row(row * n + y) + column * n;
    std::copy(from, from + n, result.row(y));
  }
  return result;
}

DisplayImage halve_subimages(const DisplayImage& light_field, const SubimageLayout& layout, int threads) {
  require_size(light_field, layout);
  const int n = layout.size_px;
  if (n % 2 != 0) throw InputError(fmt::format("subimages of {} px cannot be halved: the size is odd", n));
  DisplayImage result(layout.width() / 2, layout.height() / 2);
  const auto columns = box_inputs(layout.columns, n), rows = box_inputs(layout.rows, n);
  parallel_for(result.height(), 8, threads, [&](int begin, int end) {
    std::vector<Rgb> sums(static_cast<std::size_t>(light_field.width()));
    for (int y = begin; y < end; ++y) {
      const auto& four = rows[static_cast<std::size_t>(y)];
      const Rgb *a = light_field.row(four[0]), *b = light_field.row(four[1]), *c = light_field.row(four[2]),
                *d = light_field.row(four[3]);
      for (std::size_t x = 0; x < sums.size(); ++x) sums[x] = (a[x] + b[x]) + (c[x] + d[x]);
      Rgb* out = result.row(y);
      for (std::size_t x = 0; x < columns.size(); ++x) {
        const auto at = [&](std::size_t k) { return sums[static_cast<std::size_t>(columns[x][k])]; };
        out[x] = ((at(0) + at(1)) + (at(2) + at(3))) * (1.0f / 16);
      }
    }
  });
  return result;
}

DisplayImage panel_image(const DisplayImage& light_field, const SubimageLayout& layout,
                         const NearEyeDisplay& display, int threads) {
  require_size(light_field, layout);
  display.validate();
  if (layout.columns != display.columns || layout.rows != display.rows)
    throw InputError(fmt::format("{} × {} subimages do not fit a display with {} × {} lenses", layout.columns,
                                 layout.rows, display.columns, display.rows));
  const auto columns =
      panel_inputs(display.panel_width, layout.columns, display.subimage_pitch_px, layout.size_px);
  const auto rows =
      panel_inputs(display.panel_height, layout.rows, display.subimage_pitch_px, layout.size_px);
  DisplayImage panel(display.panel_width, display.panel_height);
  parallel_for(panel.height(), 16, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const PanelInput& v = rows[static_cast<std::size_t>(y)];
      if (v.first < 0) continue;
      const Rgb *above = light_field.row(v.first), *below = light_field.row(v.second);
      for (int x = 0; x < panel.width(); ++x) {
        const PanelInput& u = columns[static_cast<std::size_t>(x)];
        if (u.first < 0) continue;
        panel.at(x, y) = between(between(above[u.first], above[u.second], u.weight),
                                 between(below[u.first], below[u.second], u.weight), v.weight);
      }
    }
  });
  return panel;
}

}  // namespace plenolab
