// The tile search with vector instructions. All pixels of the novel view share the baseline, so at sample k
// every pixel's A has the same fractions: a row of pixels reads rows of the disparity map from one offset,
// without gathers.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/synthesis/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/synthesis/search_patch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/synthesis/crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kRows = TileOccupancy::kTileHeight;
constexpr int kNever = std::numeric_limits<int>::max();

/// One tile-high strip of as many columns as a vector has lanes.
class StripSearch {
 public:
  StripSearch(const PreparedView& view, const EpipolarPath& path, std::span<const std::uint64_t> candidates,
              int x, int y, PatchHits& hits, int hits_index)
      : view_(view), path_(path), candidates_(candidates), x_(x), y_(y), hits_(hits), base_(hits_index) {
    std::iota(columns_, columns_ + kLanes, x);
  }

  SearchCounts run(int columns, int rows) {
    start_pixels(columns, rows);
    for (std::size_t word = 0; word < candidates_.size() && rows_left_ != 0; ++word)
      for (std::uint64_t bits = candidates_[word]; bits != 0 && rows_left_ != 0; bits &= bits - 1)
        visit(static_cast<int>(word) * 64 + std::countr_zero(bits));
    return counts_;
  }

 private:
  /// Sets the first sample of every pixel; pixels whose path enters through the border need their own look.
  void start_pixels(int columns, int rows) {
    std::fill_n(first_, kRows * kLanes, kNever);
    const bool all_inside = start_inside(path_.columns, x_, columns) && start_inside(path_.rows, y_, rows);
    if (all_inside && columns == kLanes) {
      std::fill_n(first_, rows * kLanes, 0);
      rows_left_ = (1u << rows) - 1;
      return;
    }
    for (int row = 0; row < rows; ++row) {
      for (int lane = 0; lane < columns; ++lane)
        first_[row * kLanes + lane] = all_inside ? 0 : start_pixel(lane, row);
      if (std::any_of(first_ + row * kLanes, first_ + row * kLanes + columns,
                      [](int k) { return k != kNever; }))
        rows_left_ |= 1u << row;
    }
  }

  /// Whether the paths of these columns or rows run inside the image all the way.
  bool start_inside(const std::vector<AxisClip>& clips, int begin, int count) const {
    const auto inside = [&](const AxisClip& clip) { return clip.near <= 0 && clip.far == path_.start; };
    return inside(clips[static_cast<std::size_t>(begin)]) &&
           inside(clips[static_cast<std::size_t>(begin + count - 1)]);
  }

  int start_pixel(int lane, int row) {
    const int x = x_ + lane, y = y_ + row;
    const AxisClip &along_x = path_.columns[static_cast<std::size_t>(x)],
                   &along_y = path_.rows[static_cast<std::size_t>(y)];
    const AxisClip& nearer = along_x.far < along_y.far ? along_x : along_y;
    const double near = std::max(along_x.near, along_y.near);
    if (near > nearer.far || near > 0) {
      hits_.set(hit_index(row) + lane, search_pixel(view_, path_, candidates_, x, y, counts_));
      return kNever;
    }
    if (nearer.far == path_.start) return 0;
    const PathSample& entry = nearer.entry;
    ++counts_.samples;
    if (bilinear_disparity(view_, x + entry.ox, y + entry.oy, entry.fx, entry.fy) > entry.d) {
      hits_.set(hit_index(row) + lane, Hit{});
      return kNever;
    }
    return nearer.first;
  }

  int hit_index(int row) const { return base_ + row * Patch::kMaxWidth; }

  /// Whether some pixel of the row may be inside the image at a sample.
  bool reaches_image(const PathSample& sample, int row) const {
    const int i = x_ + sample.ox, j = y_ + row + sample.oy;
    return j >= -1 && j < view_.height && i < view_.width && i + kLanes > -1;
  }

  /// Disparities at a sample, on row j of the key view and between the columns it lies between.
  FloatVec between_columns(const PathSample& sample, int j) const {
    const Floats d;
    const float* left = view_.disparity_row(j) + x_ + sample.ox;
    const auto a = hn::LoadU(d, left);
    return hn::Add(a, hn::Mul(hn::Set(d, sample.fx), hn::Sub(hn::LoadU(d, left + 1), a)));
  }

  LaneMask active(int row, int index) const {
    const Ints di;
    const auto first = hn::Load(di, first_ + row * kLanes);
    return hn::RebindMask(Floats(), hn::Lt(first, hn::Set(di, index + 1)));
  }

  void visit(int index) {
    const PathSample& sample = path_.samples[static_cast<std::size_t>(index)];
    const Floats d;
    const auto fy = hn::Set(d, sample.fy), level = hn::Set(d, sample.d);
    FloatVec upper, lower = hn::Zero(d);
    int lower_row = kNever;  // whose values `lower` holds: those of the next row's upper edge
    for (unsigned rows = rows_left_; rows != 0; rows &= rows - 1) {
      const int row = std::countr_zero(rows);
      const LaneMask searching = active(row, index);
      counts_.samples += hn::CountTrue(d, searching);
      if (!reaches_image(sample, row)) continue;
      const int j = y_ + row + sample.oy;
      upper = j == lower_row ? lower : between_columns(sample, j);
      lower = between_columns(sample, j + 1);
      lower_row = j + 1;
      LaneMask hit = searching;
      if (index < path_.last()) {
        const auto disparity = hn::Add(upper, hn::Mul(fy, hn::Sub(lower, upper)));
        hit = hn::And(searching, hn::Gt(disparity, level));
      }
      if (!hn::AllFalse(d, hit)) finish(index, row, hit);
    }
  }

  /// Finds A for the lanes that hit, and takes them out of the search.
  void finish(int index, int row, LaneMask hit) {
    const Floats d;
    const Ints di;
    int* first = first_ + row * kLanes;
    const auto firsts = hn::Load(di, first);
    const auto at_first = hn::And(hit, hn::RebindMask(d, hn::Eq(firsts, hn::Set(di, index))));
    const auto left = hn::IfThenElse(hn::RebindMask(di, hit), hn::Set(di, kNever), firsts);
    const LaneMask inner = hn::AndNot(at_first, hit);
    if (!hn::AllFalse(d, at_first)) finish_at_first(index, row);
    hn::Store(left, di, first);
    if (hn::AllTrue(di, hn::Eq(left, hn::Set(di, kNever)))) rows_left_ &= ~(1u << row);
    if (!hn::AllFalse(d, inner)) refine(index, row, inner);
  }

  /// Lanes that hit at the first sample of their path: the step before it begins where they entered, pixel by
  /// pixel.
  void finish_at_first(int index, int row) {
    const PathSample& sample = path_.samples[static_cast<std::size_t>(index)];
    for (int lane = 0; lane < kLanes; ++lane) {
      if (first_[row * kLanes + lane] != index) continue;
      const int x = x_ + lane, y = y_ + row;
      if (index < path_.last() &&
          !(bilinear_disparity(view_, x + sample.ox, y + sample.oy, sample.fx, sample.fy) > sample.d))
        continue;
      SearchCounts counts;
      hits_.set(hit_index(row) + lane, search_pixel(view_, path_, candidates_, x, y, counts));
      counts_.refine += counts.refine;
    }
  }

  void refine(int index, int row, LaneMask lanes) {
    const Floats d;
    const PathSample* sub = path_.sub_samples.data() + static_cast<std::size_t>(index) * (kSubSamples + 1);
    Corners corners(view_, x_, y_ + row, sub[0]);
    Crossings crossings(sub[kSubSamples]);
    auto previous = hn::Sub(corners.at(sub[0]), hn::Set(d, sub[0].d));
    LaneMask pending = lanes;
    for (int n = 1; n <= kSubSamples; ++n) {
      counts_.refine += hn::CountTrue(d, pending);
      const auto disparity = corners.at(sub[n]);
      const auto level = hn::Set(d, sub[n].d);
      const auto f = hn::Sub(disparity, level);
      const LaneMask crossing = hn::And(pending, hn::Gt(disparity, level));
      if (!hn::AllFalse(d, crossing)) {
        crossings.set(crossing, sub + n, previous, f);
        pending = hn::AndNot(crossing, pending);
        if (hn::AllFalse(d, pending)) break;
      }
      previous = f;
    }
    store(row, crossings, lanes);
  }

  void store(int row, const Crossings& c, LaneMask lanes) {
    const Ints di;
    const auto t = hn::Div(c.before, hn::Sub(c.before, c.at));
    const auto x = hn::Add(hn::Load(di, columns_), c.ox), y = hn::Add(hn::Set(di, y_ + row), c.oy);
    const int n = hit_index(row);
    store_axis(x, hn::Add(c.fx, hn::Mul(t, c.dx)), view_.width, lanes, hits_.i + n, hits_.fx + n);
    store_axis(y, hn::Add(c.fy, hn::Mul(t, c.dy)), view_.height, lanes, hits_.j + n, hits_.fy + n);
  }

  static void store_axis(IntVec whole, FloatVec g, int size, LaneMask lanes, std::int32_t* index_out,
                         float* fraction_out) {
    const Floats d;
    const Ints di;
    const auto floor = hn::Floor(g);
    auto fraction = hn::Sub(g, floor);
    auto index = hn::Add(whole, hn::ConvertTo(di, floor));
    const auto carry = hn::Ge(fraction, hn::Set(d, 1.0f));
    index = hn::IfThenElse(hn::RebindMask(di, carry), hn::Add(index, hn::Set(di, 1)), index);
    const auto outside = hn::Or(hn::Lt(index, hn::Zero(di)), hn::Gt(index, hn::Set(di, size - 2)));
    fraction = hn::IfThenZeroElse(hn::Or(carry, hn::RebindMask(d, outside)), fraction);
    index = hn::Max(hn::Zero(di), hn::Min(index, hn::Set(di, size - 1)));
    hn::BlendedStore(index, hn::RebindMask(di, lanes), di, index_out);
    hn::BlendedStore(fraction, lanes, d, fraction_out);
  }

  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(Floats()));
  const PreparedView& view_;
  const EpipolarPath& path_;
  std::span<const std::uint64_t> candidates_;
  int x_, y_;
  PatchHits& hits_;
  int base_;
  unsigned rows_left_ = 0;
  SearchCounts counts_;
  alignas(64) int first_[kRows * TileOccupancy::kTileWidth];
  alignas(64) int columns_[TileOccupancy::kTileWidth];  ///< of the novel view, one a lane
};

SearchCounts SearchStrips(const PreparedView& view, const EpipolarPath& path, const TileOccupancy& occupancy,
                          const Patch& patch, PatchHits& hits) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Floats()));
  SearchCounts counts;
  for (int x = 0; x < patch.width; x += kLanes) {
    StripSearch strip(view, path, occupancy.tile_of_pixel(patch.x + x, patch.y), patch.x + x, patch.y, hits,
                      x);
    counts += strip.run(std::min(kLanes, patch.width - x), patch.height);
  }
  return counts;
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {

HWY_EXPORT(SearchStrips);

/// Paths that need no search: A = B for every pixel.
void fill_key_view(const EpipolarPath& path, const PreparedView& view, const Patch& patch, PatchHits& hits) {
  SearchCounts none;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x)
      hits.set(y * Patch::kMaxWidth + x, search_pixel(view, path, {}, patch.x + x, patch.y + y, none));
}

}  // namespace

SearchCounts search_patch(const PreparedView& view, const EpipolarPath& path, const TileOccupancy& occupancy,
                          const Patch& patch, PatchHits& hits) {
  if (!path.is_key_view()) return HWY_DYNAMIC_DISPATCH(SearchStrips)(view, path, occupancy, patch, hits);
  fill_key_view(path, view, patch, hits);
  return {};
}

}  // namespace plenolab
#endif  // HWY_ONCE
