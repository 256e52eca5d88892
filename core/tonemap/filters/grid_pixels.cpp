#include "core/base/parallel.h"
#include "core/tonemap/filters/grid_passes.h"

namespace plenolab {
namespace {

/// Floats of two neighbouring bins: weight, weighted value, weight, weighted value. Loops over them become
/// one vector instruction.
constexpr int kPairFloats = 2 * kBinFloats;

/// Where the samples around a pixel lie: up to two layers of the four cells around it. Neighbouring pixels
/// mostly share them.
template <class Float>
class Corners {
 public:
  Corners(const GridLayout& layout, Float* data) : layout_(layout), data_(data) {}

  void move_to(int column, int row, GridCoordinate layer) {
    const int layers = layer.fraction > 0 ? 2 : 1;
    if (column == column_ && row == row_ && layer.index == layer_ && layers <= layers_) return;
    column_ = column, row_ = row, layer_ = layer.index, layers_ = layers;
    for (int l = 0; l < layers; ++l)
      for (int c = 0; c < 4; ++c) {
        const GridBlock& block = *find_block(layout_.cell(column + c % 2, row + c / 2), layer_ + l);
        bin_0_[l][c] = data_ + block.offset - static_cast<std::ptrdiff_t>(block.begin) * kBinFloats;
      }
  }

  Float* at(int layer, int corner, int bin) const {
    return bin_0_[layer][corner] + static_cast<std::ptrdiff_t>(bin) * kBinFloats;
  }

 private:
  const GridLayout& layout_;
  Float* data_;
  int column_ = -1, row_ = -1, layer_ = -1, layers_ = 0;
  Float* bin_0_[2][4] = {};
};

/// Calls body(x, y, bin, layer weights, corner weights, corners) for every pixel between two rows of cells.
template <class Float, class Body>
void for_pixels(const GridImage& image, int row, Float* data, const Body& body) {
  Corners<Float> corners(image.layout, data);
  const PixelRows rows = pixel_rows(image.axes, row);
  for (int y = rows.begin; y < rows.end; ++y) {
    const float down = image.axes.row_of[static_cast<std::size_t>(y)].fraction;
    const float* range = image.input.range.row(y);
    const float* disparity = image.input.depth ? image.input.depth->disparity->row(y) : nullptr;
    for (int x = 0; x < image.input.width(); ++x) {
      const GridCoordinate column = image.axes.column_of[static_cast<std::size_t>(x)];
      const GridCoordinate layer = disparity ? image.axes.layers.at(disparity[x]) : GridCoordinate{};
      corners.move_to(column.index, row, layer);
      const float right = column.fraction;
      const float weights[4] = {(1 - right) * (1 - down), right * (1 - down), (1 - right) * down,
                                right * down};
      body(x, y, image.axes.bins.at(range[x]), layer.fraction, weights, corners);
    }
  }
}

void splat_band(const GridImage& image, int row, float* data) {
  for_pixels(image, row, data,
             [&](int x, int y, GridCoordinate bin, float deeper, const float* weights, auto& corners) {
               const float value = image.input.value.at(x, y) - image.centre, near = 1 - bin.fraction,
                           far = bin.fraction;
               const float terms[kPairFloats] = {near, near * value, far, far * value};
               for (int l = 0; l < (deeper > 0 ? 2 : 1); ++l) {
                 const float share = l == 0 ? 1 - deeper : deeper;
                 for (int c = 0; c < 4; ++c) {
                   float* p = corners.at(l, c, bin.index);
                   const float weight = share * weights[c];
                   for (int i = 0; i < kPairFloats; ++i) p[i] += weight * terms[i];
                 }
               }
             });
}

void slice_band(const GridImage& image, int row, const float* data, Plane<float>& out) {
  for_pixels(image, row, data,
             [&](int x, int y, GridCoordinate bin, float deeper, const float* weights, auto& corners) {
               float s[kPairFloats] = {};
               for (int l = 0; l < (deeper > 0 ? 2 : 1); ++l) {
                 const float share = l == 0 ? 1 - deeper : deeper;
                 for (int c = 0; c < 4; ++c) {
                   const float* p = corners.at(l, c, bin.index);
                   const float weight = share * weights[c];
                   for (int i = 0; i < kPairFloats; ++i) s[i] += weight * p[i];
                 }
               }
               const float near = 1 - bin.fraction, far = bin.fraction;
               out.at(x, y) = image.centre + (near * s[1] + far * s[3]) / (near * s[0] + far * s[2]);
             });
}

}  // namespace

GridData splat(const GridImage& image) {
  GridData data(image.layout.floats, 0.0f);
  // A band of pixels adds to the row of cells above and to the one below it: even bands first, then odd ones.
  for (const int parity : {0, 1})
    parallel_for((image.axes.rows - 1 - parity + 1) / 2, 1, image.input.threads, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) splat_band(image, 2 * i + parity, data.data());
    });
  return data;
}

Plane<float> slice(const GridImage& image, const GridData& data) {
  Plane<float> out(image.input.width(), image.input.height());
  parallel_for(image.axes.rows - 1, 1, image.input.threads, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) slice_band(image, row, data.data(), out);
  });
  return out;
}

}  // namespace plenolab
