#include "core/lut/grade.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/lut/lattice.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/lut/grade.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One colour in four lanes; the fourth is not used.
using ColourLanes = hn::CappedTag<float, 4>;
using Colour = hn::Vec<ColourLanes>;

struct PaddedNodes {
  const float* nodes;
  std::ptrdiff_t stride_g, stride_b;  // in nodes
};

HWY_INLINE Colour NodeAt(const float* nodes, std::ptrdiff_t node) {
  return hn::Load(ColourLanes(), nodes + 4 * node);
}

HWY_INLINE Colour Mix(Colour a, Colour b, float t) {
  return hn::MulAdd(hn::Sub(b, a), hn::Set(ColourLanes(), t), a);
}

HWY_INLINE Colour Trilinear(const PaddedNodes& lut, std::ptrdiff_t first, const Cell& cell) {
  const auto along_red = [&](std::ptrdiff_t at) {
    return Mix(NodeAt(lut.nodes, at), NodeAt(lut.nodes, at + 1), cell.r.fraction);
  };
  const auto along_green = [&](std::ptrdiff_t at) {
    return Mix(along_red(at), along_red(at + lut.stride_g), cell.g.fraction);
  };
  return Mix(along_green(first), along_green(first + lut.stride_b), cell.b.fraction);
}

// The axes of the largest and the smallest fraction are chosen without branches; ties do not matter, because
// the weight between equal fractions is 0.
HWY_INLINE Colour Tetrahedral(const PaddedNodes& lut, std::ptrdiff_t first, const Cell& cell) {
  const float r = cell.r.fraction, g = cell.g.fraction, b = cell.b.fraction;
  const bool r_over_g = r > g, g_over_b = g > b, r_over_b = r > b;
  const std::ptrdiff_t top_of_rg = r_over_g ? 1 : lut.stride_g, end_of_rg = r_over_g ? lut.stride_g : 1;
  const float high_rg = r_over_g ? r : g, low_rg = r_over_g ? g : r;
  const bool rg_over_b = r_over_g ? r_over_b : g_over_b, b_over_low = r_over_g ? !g_over_b : !r_over_b;
  const std::ptrdiff_t largest = rg_over_b ? top_of_rg : lut.stride_b;
  const std::ptrdiff_t smallest = b_over_low ? end_of_rg : lut.stride_b;
  const float high = rg_over_b ? high_rg : b, low = b_over_low ? low_rg : b;
  const float middle = rg_over_b ? (b_over_low ? b : low_rg) : high_rg;
  const std::ptrdiff_t last = first + 1 + lut.stride_g + lut.stride_b;
  const ColourLanes d;
  Colour colour = hn::Mul(NodeAt(lut.nodes, first), hn::Set(d, 1 - high));
  colour = hn::MulAdd(NodeAt(lut.nodes, first + largest), hn::Set(d, high - middle), colour);
  colour = hn::MulAdd(NodeAt(lut.nodes, last - smallest), hn::Set(d, middle - low), colour);
  return hn::MulAdd(NodeAt(lut.nodes, last), hn::Set(d, low), colour);
}

template <class Interpolate>
HWY_INLINE std::int64_t GradeWith(const PaddedNodes& lut, const Lattice& lattice, const Rgb* in, Rgb* out,
                                  int count, const Interpolate& interpolate) {
  const ColourLanes d;
  std::int64_t cut = 0;
  HWY_ALIGN float lanes[4] = {};
  for (int i = 0; i < count; ++i) {
    const Cell cell = cell_of(lattice, in[i]);
    const std::ptrdiff_t first = cell.r.node + cell.g.node * lut.stride_g + cell.b.node * lut.stride_b;
    const Colour colour = interpolate(lut, first, cell);
    const Colour kept = hn::Min(hn::Max(colour, hn::Zero(d)), hn::Set(d, 1));
    // The fourth lane is 0 at every node and so never cut.
    cut += static_cast<std::int64_t>(hn::CountTrue(d, hn::Ne(kept, colour)));
    hn::Store(kept, d, lanes);
    out[i] = {lanes[0], lanes[1], lanes[2]};
  }
  return cut;
}

std::int64_t GradeRow(const float* nodes, std::ptrdiff_t stride_g, std::ptrdiff_t stride_b,
                      const Lattice& lattice, const Rgb* in, Rgb* out, int count, bool tetrahedral) {
  const PaddedNodes lut{nodes, stride_g, stride_b};
  if (tetrahedral) return GradeWith(lut, lattice, in, out, count, Tetrahedral);
  return GradeWith(lut, lattice, in, out, count, Trilinear);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(GradeRow);

constexpr int kRowGrain = 16;
}  // namespace

PreparedLut::PreparedLut(const Lut& lut) {
  lut.validate();
  header_ = {lut.size, lut.domain_min, lut.domain_max, {}, {}};
  const int n = lut.size + 1;
  stride_g_ = n;
  stride_b_ = n * n;
  nodes_.resize(4 * static_cast<std::size_t>(n) * static_cast<std::size_t>(stride_b_));
  std::size_t k = 0;
  for (int b = 0; b < n; ++b)
    for (int g = 0; g < n; ++g)
      for (int r = 0; r < n; ++r, k += 4) {
        const int last = lut.size - 1;
        const Rgb& c = lut.node(std::min(r, last), std::min(g, last), std::min(b, last));
        nodes_[k] = c.r;
        nodes_[k + 1] = c.g;
        nodes_[k + 2] = c.b;
      }
}

std::int64_t PreparedLut::grade_row(const Rgb* in, Rgb* out, int count,
                                    LutInterpolation interpolation) const {
  return HWY_DYNAMIC_DISPATCH(GradeRow)(nodes_.data(), stride_g_, stride_b_, lattice_of(header_), in, out,
                                        count, interpolation == LutInterpolation::kTetrahedral);
}

GradedImage PreparedLut::grade(const DisplayImage& image, const GradeOptions& options) const {
  GradedImage graded{DisplayImage(image.width(), image.height()), 0};
  std::vector<std::int64_t> cut(static_cast<std::size_t>(image.height()));
  parallel_for(image.height(), kRowGrain, options.threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      cut[static_cast<std::size_t>(y)] =
          grade_row(image.row(y), graded.image.row(y), image.width(), options.interpolation);
  });
  for (const std::int64_t row : cut) graded.cut += row;
  return graded;
}

}  // namespace plenolab
#endif  // HWY_ONCE
