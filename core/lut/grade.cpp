#include "core/lut/grade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/lut/lattice.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/lut/grade.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLENOLAB_LUT_GRADE_TYPES
#define PLENOLAB_LUT_GRADE_TYPES
namespace plenolab {

/// Corners of a tetrahedron as nodes from the first corner of the cell on.
struct TetrahedronCorners {
  std::ptrdiff_t second = 0, third = 0, last = 0;
};

struct PaddedNodes {
  const float* nodes;
  std::ptrdiff_t stride_g, stride_b;  ///< in nodes
  /// By (r > g) + 2·(g > b) + 4·(r > b) of the fractions; between equal ones any order does.
  TetrahedronCorners corners[8];
};

/// No vector of any target has more floats.
inline constexpr std::size_t kMostLanes = 64;

/// Lattice of the three channels by turns, three vectors of any target long.
inline constexpr std::size_t kPatternLength = 3 * kMostLanes;
struct LatticePattern {
  float low[kPatternLength], scale[kPatternLength];
  std::int32_t stride[kPatternLength];
  float last;
};

}  // namespace plenolab
#endif

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One colour in four lanes; the fourth is not used.
using ColourLanes = hn::CappedTag<float, 4>;
using Colour = hn::Vec<ColourLanes>;

HWY_INLINE Colour NodeAt(const float* nodes, std::ptrdiff_t node) {
  return hn::Load(ColourLanes(), nodes + 4 * node);
}

HWY_INLINE Colour Mix(Colour a, Colour b, float t) {
  return hn::MulAdd(hn::Sub(b, a), hn::Set(ColourLanes(), t), a);
}

HWY_INLINE Colour Trilinear(const PaddedNodes& lut, std::ptrdiff_t first, float r, float g, float b) {
  const auto along_red = [&](std::ptrdiff_t at) {
    return Mix(NodeAt(lut.nodes, at), NodeAt(lut.nodes, at + 1), r);
  };
  const auto along_green = [&](std::ptrdiff_t at) {
    return Mix(along_red(at), along_red(at + lut.stride_g), g);
  };
  return Mix(along_green(first), along_green(first + lut.stride_b), b);
}

// The way from the first corner to the last goes along the axes in descending order of their fractions. It is
// looked up, because branches that depend on colours are guessed wrongly in every second pixel.
HWY_INLINE Colour Tetrahedral(const PaddedNodes& lut, std::ptrdiff_t first, float r, float g, float b) {
  const int order = static_cast<int>(r > g) + 2 * static_cast<int>(g > b) + 4 * static_cast<int>(r > b);
  const float high = std::max(std::max(r, g), b), low = std::min(std::min(r, g), b);
  const float middle = std::max(std::min(r, g), std::min(std::max(r, g), b));
  const TetrahedronCorners corners = lut.corners[order];
  const ColourLanes d;
  Colour colour = hn::Mul(NodeAt(lut.nodes, first), hn::Set(d, 1 - high));
  colour = hn::MulAdd(NodeAt(lut.nodes, first + corners.second), hn::Set(d, high - middle), colour);
  colour = hn::MulAdd(NodeAt(lut.nodes, first + corners.third), hn::Set(d, middle - low), colour);
  return hn::MulAdd(NodeAt(lut.nodes, first + corners.last), hn::Set(d, low), colour);
}

/// position_on (lattice.h) of all channel values of a row, side by side; patterns hold three vectors.
void PlaceRow(const float* values, std::size_t count, const LatticePattern& pattern, std::int32_t* offsets,
              float* fractions) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const std::size_t lanes = hn::Lanes(d);
  const auto last = hn::Set(d, pattern.last);
  for (std::size_t i = 0, k = 0; i < count; i += lanes, k = k == 2 * lanes ? 0 : k + lanes) {
    const auto low = hn::LoadU(d, pattern.low + k), scale = hn::LoadU(d, pattern.scale + k);
    const auto position = hn::Mul(hn::Sub(hn::LoadU(d, values + i), low), scale);
    const auto above = hn::IfThenElseZero(hn::Gt(position, hn::Zero(d)), position);
    const auto cut = hn::Min(above, last);
    const auto node = hn::ConvertTo(di, cut);
    hn::StoreU(hn::Mul(node, hn::LoadU(di, pattern.stride + k)), di, offsets + i);
    hn::StoreU(hn::Sub(cut, hn::ConvertTo(d, node)), d, fractions + i);
  }
}

/// `out` has room for one float more than the pixels take.
template <class Interpolate>
HWY_INLINE std::int64_t GradeWith(const PaddedNodes& lut, const std::int32_t* offsets, const float* fractions,
                                  float* out, int count, const Interpolate& interpolate) {
  const ColourLanes d;
  const hn::RebindToSigned<ColourLanes> di;
  auto cut = hn::Zero(di);
  for (int i = 0; i < count; ++i, offsets += 3, fractions += 3, out += 3) {
    const Colour colour = interpolate(lut, std::ptrdiff_t{offsets[0]} + offsets[1] + offsets[2], fractions[0],
                                      fractions[1], fractions[2]);
    const Colour kept = hn::Min(hn::Max(colour, hn::Zero(d)), hn::Set(d, 1));
    // The fourth lane is 0 at every node and so never cut. True lanes are −1.
    cut = hn::Sub(cut, hn::BitCast(di, hn::VecFromMask(d, hn::Ne(kept, colour))));
    // The fourth lane falls on the next pixel, which is written after it.
    hn::StoreU(kept, d, out);
  }
  return hn::GetLane(hn::SumOfLanes(di, cut));
}

std::int64_t InterpolateRow(const PaddedNodes& lut, const std::int32_t* offsets, const float* fractions,
                            float* out, int count, bool tetrahedral) {
  if (tetrahedral) return GradeWith(lut, offsets, fractions, out, count, Tetrahedral);
  return GradeWith(lut, offsets, fractions, out, count, Trilinear);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(PlaceRow);
HWY_EXPORT(InterpolateRow);

constexpr int kRowGrain = 16;
/// Rows are rounded up to whole vectors.
constexpr std::size_t kPadding = kMostLanes;

/// Axes 0 to 2 from the largest fraction to the smallest, by the code of PaddedNodes::corners. Codes 1 + 2
/// and 4 contradict themselves and do not occur.
constexpr int kAxisOrder[8][3]{{2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {0, 1, 2},
                               {0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}};

LatticePattern pattern_of(const Lattice& lattice, const std::int32_t (&strides)[3]) {
  LatticePattern pattern;
  const float low[]{lattice.low.r, lattice.low.g, lattice.low.b},
      scale[]{lattice.scale.r, lattice.scale.g, lattice.scale.b};
  for (std::size_t i = 0; i < kPatternLength; ++i) {
    pattern.low[i] = low[i % 3];
    pattern.scale[i] = scale[i % 3];
    pattern.stride[i] = strides[i % 3];
  }
  pattern.last = lattice.last;
  return pattern;
}

PaddedNodes padded_nodes(const std::vector<float>& nodes, const std::int32_t (&strides)[3]) {
  PaddedNodes padded{nodes.data(), strides[1], strides[2], {}};
  for (std::size_t code = 0; code < 8; ++code) {
    const auto& order = kAxisOrder[code];
    const std::ptrdiff_t second = strides[order[0]], third = second + strides[order[1]];
    padded.corners[code] = {second, third, third + strides[order[2]]};
  }
  return padded;
}
}  // namespace

PreparedLut::PreparedLut(const Lut& lut) {
  lut.validate();
  header_ = {lut.size, lut.domain_min, lut.domain_max, {}, {}};
  const int n = lut.size + 1, last = lut.size - 1;
  nodes_.resize(4 * static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  std::size_t k = 0;
  for (int b = 0; b < n; ++b)
    for (int g = 0; g < n; ++g)
      for (int r = 0; r < n; ++r, k += 4) {
        const Rgb& c = lut.node(std::min(r, last), std::min(g, last), std::min(b, last));
        nodes_[k] = c.r;
        nodes_[k + 1] = c.g;
        nodes_[k + 2] = c.b;
      }
}

/// Grades runs of pixels by one table.
class RowGrader {
 public:
  explicit RowGrader(const PreparedLut& lut)
      : strides_{1, lut.header_.size + 1, (lut.header_.size + 1) * (lut.header_.size + 1)},
        pattern_(pattern_of(lattice_of(lut.header_), strides_)),
        nodes_(padded_nodes(lut.nodes_, strides_)) {}

  /// Room for the longest run.
  struct Buffers {
    explicit Buffers(std::size_t pixels)
        : row(3 * pixels + kPadding), fractions(row.size()), offsets(row.size()) {}
    std::vector<float> row, fractions;
    std::vector<std::int32_t> offsets;
  };

  /// Returns the channel values that were cut.
  std::int64_t grade(const Rgb* in, Rgb* out, int count, LutInterpolation interpolation,
                     Buffers& buffers) const {
    const std::size_t values = 3 * static_cast<std::size_t>(count);
    std::memcpy(buffers.row.data(), in, values * sizeof(float));
    HWY_DYNAMIC_DISPATCH(PlaceRow)
    (buffers.row.data(), values, pattern_, buffers.offsets.data(), buffers.fractions.data());
    const std::int64_t cut = HWY_DYNAMIC_DISPATCH(InterpolateRow)(
        nodes_, buffers.offsets.data(), buffers.fractions.data(), buffers.row.data(), count,
        interpolation == LutInterpolation::kTetrahedral);
    std::memcpy(static_cast<void*>(out), buffers.row.data(), values * sizeof(float));
    return cut;
  }

 private:
  std::int32_t strides_[3];
  LatticePattern pattern_;
  PaddedNodes nodes_;
};

namespace {

/// Grades row by row; `grade_row(y, buffers, graded)` returns the values cut in it.
template <class GradeRow>
GradedImage grade_rows(const DisplayImage& image, int threads, const GradeRow& grade_row) {
  GradedImage graded{DisplayImage(image.width(), image.height()), 0};
  std::vector<std::int64_t> cut(static_cast<std::size_t>(image.height()));
  parallel_for(image.height(), kRowGrain, threads, [&](int begin, int end) {
    RowGrader::Buffers buffers(static_cast<std::size_t>(image.width()));
    for (int y = begin; y < end; ++y) cut[static_cast<std::size_t>(y)] = grade_row(y, buffers, graded.image);
  });
  for (const std::int64_t row : cut) graded.cut += row;
  return graded;
}

}  // namespace

GradedImage PreparedLut::grade(const DisplayImage& image, const GradeOptions& options) const {
  const RowGrader grader(*this);
  return grade_rows(image, options.threads, [&](int y, RowGrader::Buffers& buffers, DisplayImage& out) {
    return grader.grade(image.row(y), out.row(y), image.width(), options.interpolation, buffers);
  });
}

GradedImage grade_by_map(const DisplayImage& image, const Plane<int>& of_pixel,
                         std::span<const PreparedLut* const> tables, const GradeOptions& options) {
  if (image.width() != of_pixel.width() || image.height() != of_pixel.height())
    throw InputError(fmt::format("a picture of {} × {} pixels and a map of {} × {} do not belong together",
                                 image.width(), image.height(), of_pixel.width(), of_pixel.height()));
  std::vector<RowGrader> graders;
  for (const PreparedLut* table : tables) graders.emplace_back(*table);
  return grade_rows(image, options.threads, [&](int y, RowGrader::Buffers& buffers, DisplayImage& out) {
    const int* const owner = of_pixel.row(y);
    std::int64_t cut = 0;
    for (int x = 0; x < image.width();) {
      int end = x + 1;
      while (end < image.width() && owner[end] == owner[x]) ++end;
      cut += graders[static_cast<std::size_t>(owner[x])].grade(image.row(y) + x, out.row(y) + x, end - x,
                                                               options.interpolation, buffers);
      x = end;
    }
    return cut;
  });
}

}  // namespace plenolab
#endif  // HWY_ONCE
