// Which samples of the search can be hits for a tile.
//
// The linear search stops at sample k of a pixel because f(d) = disp(A(d)) − d is > 0 at d_k and was ≤ 0 at
// the sample before it, d' ≤ d_(k−1) (d_(k−1) itself, or where the path entered the image). disp is bilinear,
// hence continuous along the path, so some d* in [d_k, d'] has disp(A*) = d* with A* = B + v·d*. A* lies in a
// quad (the square between four neighbouring pixel centres), where the bilinear disparity lies between the
// quad's smallest and largest value m and M. Therefore:
//   d_k ≤ M, d_(k−1) ≥ m, and B is in the quad shifted by −v·d* for some d* in [m, M] ∩ [d_k, d_(k−1)].
// Setting bit k in all tiles that this region touches, for every quad and every such k, leaves out no sample
// at which the linear search stops; testing fewer of the samples before it changes nothing because none of
// them is a hit. Unlike a splat of single pixels dilated by a constant, this covers pseudo-surfaces between
// two surfaces, where the bilinear disparity passes through values that no pixel has. Rounding is covered by
// widening [m, M] and the region: the test is evaluated in float with an error below 5e-7 of the largest
// disparity, positions with one below 1e-6 px.
//
// Quads in which f falls along the whole way of the path are left out. Between d' = d_(k−1) and d_k, f has to
// rise from ≤ 0 to > 0; where it falls at least as fast as the path's own d (v·∇disp ≥ 2), it does not, so
// that some d* with f = 0 lies in a quad that is entered. With the rounding error ε of f: outside the quads
// entered |f| > ε does not hold for an f ≤ ε that only falls, and a whole step in quads left out takes f from
// ≤ ε to ≤ ε − Δ, below −ε as long as Δ > 2ε. A path that enters through the border begins with less than a
// step, so quads near the border are always entered. This spares the tiles beside an edge that lie behind it.
//
// Blocks of 8 × 8 quads that are nearly flat are entered as one; in the others, small groups of quads are
// entered together, and the samples of steep groups eight at a time.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/synthesis/search.h"

namespace plenolab {
namespace {

constexpr double kRegionMargin_px = 1e-3;
constexpr double kFlatSteps = 2;          ///< blocks whose disparity spans fewer steps are entered as one
constexpr int kSamplesAtOnce = 8;         ///< of a steep group of quads
constexpr int kGroup = 2;                 ///< quads along the edge of a group
constexpr int kBorder = 6;                ///< px: more than a step, whose largest is 4
constexpr double kDenseShare = 1.0 / 32;  ///< entering costs about as much as 32 vectorised samples

double disparity_margin(const EpipolarPath& path) {
  return 1e-4 + 2e-6 * path.d_max;
}

/// Rectangle in pixel centres of a key view, as indices, both ends included.
struct Region {
  double left, top, right, bottom;
};

struct SampleRange {
  int begin, end;  ///< inclusive
};

class OccupancyBuilder {
 public:
  OccupancyBuilder(const PreparedView& view, const EpipolarPath& path, TileOccupancy& out)
      : view_(view),
        path_(path),
        out_(out),
        margin_(disparity_margin(path)),
        leaves_out_(path.step > 4 * margin_) {}

  void enter_block_row(int row) {
    for (int column = 0; column < view_.blocks.width(); ++column) enter_block(column, row);
  }

  /// Rough number of entries of steep blocks.
  double steep_work() const {
    double work = 0;
    for (const DisparityRange& block : view_.blocks.pixels())
      if (!is_flat(block)) work += 64 + 2 * (block.max - block.min) / path_.step;
    return work;
  }

 private:
  bool is_flat(DisparityRange range) const { return range.max - range.min <= kFlatSteps * path_.step; }

  void enter_block(int column, int row) {
    constexpr int kBlock = PreparedView::kBlock;
    const int x = column * kBlock, y = row * kBlock;
    const int right = std::min(x + kBlock, view_.width - 1), bottom = std::min(y + kBlock, view_.height - 1);
    const DisparityRange range = view_.blocks.at(column, row);
    if (is_flat(range)) return enter_flat(range, {double(x), double(y), double(right), double(bottom)});
    for (int j = y; j < std::max(bottom, y + 1); j += kGroup)
      for (int i = x; i < std::max(right, x + 1); i += kGroup)
        enter_group(i, j, std::min(i + kGroup, std::max(right, x + 1)),
                    std::min(j + kGroup, std::max(bottom, y + 1)));
  }

  /// The quads [x, right) × [y, bottom).
  void enter_group(int x, int y, int right, int bottom) {
    DisparityRange range{std::numeric_limits<float>::max(), -1};
    for (int j = y; j < bottom; ++j)
      for (int i = x; i < right; ++i) {
        const float *upper = view_.disparity_row(j) + i, *lower = view_.disparity_row(j + 1) + i;
        if (falls(upper, lower) && !is_near_border(i, j)) continue;
        range.min = std::min({range.min, upper[0], upper[1], lower[0], lower[1]});
        range.max = std::max({range.max, upper[0], upper[1], lower[0], lower[1]});
      }
    if (range.max < 0) return;
    const Region region{double(x), double(y), double(right), double(bottom)};
    if (is_flat(range))
      enter_flat(range, region);
    else
      enter_steep(range, region);
  }

  /// Whether f falls along the path everywhere in a quad.
  bool falls(const float* upper, const float* lower) const {
    const double across = std::min(path_.vx * (upper[1] - upper[0]), path_.vx * (lower[1] - lower[0]));
    const double down = std::min(path_.vy * (lower[0] - upper[0]), path_.vy * (lower[1] - upper[1]));
    return leaves_out_ && across + down >= 2;
  }

  bool is_near_border(int i, int j) const {
    return std::min({i, j, view_.width - 2 - i, view_.height - 2 - j}) < kBorder;
  }

  void enter_flat(DisparityRange range, const Region& region) {
    mark(samples_of(range), region, range.min - margin_, range.max + margin_);
  }

  void enter_steep(DisparityRange range, const Region& region) {
    const SampleRange samples = samples_of(range);
    for (int begin = samples.begin; begin <= samples.end; begin += kSamplesAtOnce) {
      const int end = std::min(begin + kSamplesAtOnce - 1, samples.end);
      mark({begin, end}, region, std::max(range.min - margin_, path_.disparity(end)),
           std::min(range.max + margin_, path_.disparity(begin - 1)));
    }
  }

  /// Samples k with d_k ≤ M and d_(k−1) ≥ m, widened.
  SampleRange samples_of(DisparityRange range) const {
    const double begin = std::ceil((path_.d_max - range.max - margin_) / path_.step) + 1;
    const double end = std::floor((path_.d_max - range.min + margin_) / path_.step) + 2;
    return {index_of(begin), index_of(end)};
  }

  int index_of(double k) const {
    return static_cast<int>(
        std::clamp(k - static_cast<double>(path_.first), 0.0, static_cast<double>(path_.last())));
  }

  void mark(SampleRange samples, const Region& region, double d_low, double d_high) {
    const double shift_x0 = path_.vx * d_low, shift_x1 = path_.vx * d_high;
    const double shift_y0 = path_.vy * d_low, shift_y1 = path_.vy * d_high;
    const int left =
        pixel(region.left - path_.sx - std::max(shift_x0, shift_x1) - kRegionMargin_px, path_.width, true);
    const int right =
        pixel(region.right - path_.sx - std::min(shift_x0, shift_x1) + kRegionMargin_px, path_.width, false);
    const int top =
        pixel(region.top - path_.sy - std::max(shift_y0, shift_y1) - kRegionMargin_px, path_.height, true);
    const int bottom = pixel(region.bottom - path_.sy - std::min(shift_y0, shift_y1) + kRegionMargin_px,
                             path_.height, false);
    if (left > right || top > bottom) return;
    for (int y = top / TileOccupancy::kTileHeight; y <= bottom / TileOccupancy::kTileHeight; ++y)
      for (int x = left / TileOccupancy::kTileWidth; x <= right / TileOccupancy::kTileWidth; ++x)
        mark_tile(x, y, samples);
  }

  /// First (or last) pixel at or beyond a coordinate, cut to −1 … size.
  static int pixel(double coordinate, int size, bool first) {
    if (first) return round_up(std::clamp(coordinate, 0.0, static_cast<double>(size)));
    return round_down(std::clamp(coordinate, -1.0, static_cast<double>(size - 1)));
  }

  /// ⌈v⌉ and ⌊v⌋ for |v| < 2³¹, without a library call.
  static int round_up(double v) {
    const int whole = static_cast<int>(v);
    return whole + (whole < v ? 1 : 0);
  }
  static int round_down(double v) {
    const int whole = static_cast<int>(v);
    return whole - (whole > v ? 1 : 0);
  }

  void mark_tile(int x, int y, SampleRange samples) {
    std::uint64_t* words =
        out_.bits.data() +
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(out_.tiles_x) + static_cast<std::size_t>(x)) *
            static_cast<std::size_t>(out_.words);
    for (int word = samples.begin / 64; word <= samples.end / 64; ++word) {
      std::uint64_t mask = ~std::uint64_t{0};
      if (word == samples.begin / 64) mask &= ~std::uint64_t{0} << (samples.begin % 64);
      if (word == samples.end / 64) mask &= ~std::uint64_t{0} >> (63 - samples.end % 64);
      const std::atomic_ref<std::uint64_t> bits(
          words[word]);  // neighbouring blocks are entered by other threads
      if ((bits.load(std::memory_order_relaxed) & mask) != mask)
        bits.fetch_or(mask, std::memory_order_relaxed);
    }
  }

  const PreparedView& view_;
  const EpipolarPath& path_;
  TileOccupancy& out_;
  double margin_;
  bool leaves_out_;  ///< a step is longer than the rounding errors of f, see above
};

TileOccupancy filled(const EpipolarPath& path, std::uint64_t fill) {
  TileOccupancy occupancy;
  occupancy.tiles_x = (path.width + TileOccupancy::kTileWidth - 1) / TileOccupancy::kTileWidth;
  occupancy.tiles_y = (path.height + TileOccupancy::kTileHeight - 1) / TileOccupancy::kTileHeight;
  occupancy.words = path.last() / 64 + 1;
  const std::size_t tiles =
      static_cast<std::size_t>(occupancy.tiles_x) * static_cast<std::size_t>(occupancy.tiles_y);
  const auto words = static_cast<std::size_t>(occupancy.words);
  occupancy.bits.assign(tiles * words, fill);
  const int top = path.last() % 64;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    std::uint64_t& word = occupancy.bits[tile * words + words - 1];
    word = (word & (~std::uint64_t{0} >> (63 - top))) | (std::uint64_t{1} << top);
  }
  return occupancy;
}

}  // namespace

TileOccupancy last_sample_only(const EpipolarPath& path) {
  return filled(path, 0);
}

TileOccupancy build_occupancy(const PreparedView& view, const EpipolarPath& path, int threads) {
  TileOccupancy occupancy = filled(path, 0);
  if (path.is_key_view()) return occupancy;
  OccupancyBuilder builder(view, path, occupancy);
  const double all_samples = static_cast<double>(path.samples.size()) * static_cast<double>(path.width) *
                             static_cast<double>(path.height);
  if (builder.steep_work() > kDenseShare * all_samples) return filled(path, ~std::uint64_t{0});
  parallel_for(view.blocks.height(), 1, threads, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) builder.enter_block_row(row);
  });
  return occupancy;
}

}  // namespace plenolab
