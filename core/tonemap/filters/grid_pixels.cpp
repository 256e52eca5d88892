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

/// Where one pixel lies in the grid.
struct Sample {
  int x = 0, y = 0;
  GridCoordinate column, row, bin, layer;

  int layers() const { return layer.fraction > 0 ? 2 : 1; }
  /// Share of one of the layers.
  float share(int l) const { return l == 0 ? 1 - layer.fraction : layer.fraction; }
};

/// Shares of the four cells around a pixel.
struct CellShares {
  float of[4];
  explicit CellShares(const Sample& s)
      : of{(1 - s.column.fraction) * (1 - s.row.fraction), s.column.fraction * (1 - s.row.fraction),
           (1 - s.column.fraction) * s.row.fraction, s.column.fraction * s.row.fraction} {}
};

/// Calls body(sample, corners) for every pixel between two rows of cells.
template <class Float, class Body>
void for_pixels(const GridImage& image, int row, Float* data, const Body& body) {
  Corners<Float> corners(image.layout, data);
  const PixelRows rows = pixel_rows(image.axes, row);
  for (int y = rows.begin; y < rows.end; ++y) {
    const float* range = image.input.range.row(y);
    const float* disparity = image.input.depth ? image.input.depth->disparity->row(y) : nullptr;
    for (int x = 0; x < image.input.width(); ++x) {
      const Sample sample{x,
                          y,
                          image.axes.column_of[static_cast<std::size_t>(x)],
                          image.axes.row_of[static_cast<std::size_t>(y)],
                          image.axes.bins.at(range[x]),
                          disparity ? image.axes.layers.at(disparity[x]) : GridCoordinate{}};
      corners.move_to(sample.column.index, row, sample.layer);
      body(sample, corners);
    }
  }
}

void splat_band(const GridImage& image, int row, float* data) {
  for_pixels(image, row, data, [&](const Sample& s, const Corners<float>& corners) {
    const float value = image.input.value.at(s.x, s.y) - image.centre, far = s.bin.fraction, near = 1 - far;
    const float terms[kPairFloats] = {near, near * value, far, far * value};
    const CellShares shares(s);
    for (int l = 0; l < s.layers(); ++l)
      for (int c = 0; c < 4; ++c) {
        float* p = corners.at(l, c, s.bin.index);
        const float weight = s.share(l) * shares.of[c];
        for (int i = 0; i < kPairFloats; ++i) p[i] += weight * terms[i];
      }
  });
}

void slice_band(const GridImage& image, int row, const float* data, Plane<float>& out) {
  for_pixels(image, row, data, [&](const Sample& s, const Corners<const float>& corners) {
    float sums[kPairFloats] = {};
    const CellShares shares(s);
    for (int l = 0; l < s.layers(); ++l)
      for (int c = 0; c < 4; ++c) {
        const float* p = corners.at(l, c, s.bin.index);
        const float weight = s.share(l) * shares.of[c];
        for (int i = 0; i < kPairFloats; ++i) sums[i] += weight * p[i];
      }
    const float far = s.bin.fraction, near = 1 - far;
    out.at(s.x, s.y) = image.centre + (near * sums[1] + far * sums[3]) / (near * sums[0] + far * sums[2]);
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
