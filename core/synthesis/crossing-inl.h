// The second pass of the search for a row of pixels at once; compiled once per instruction set (Highway).

#if defined(PLENOLAB_CROSSING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PLENOLAB_CROSSING_INL_H
#undef PLENOLAB_CROSSING_INL_H
#else
#define PLENOLAB_CROSSING_INL_H
#endif

#include <hwy/highway.h>

#include "core/synthesis/search.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, TileOccupancy::kTileWidth>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVec = hn::Vec<Floats>;
using IntVec = hn::Vec<Ints>;
using LaneMask = hn::Mask<Floats>;

/// The four pixels around A for a row of pixels, kept while A stays between the same ones.
struct Corners {
  const PreparedView& view;
  int x, y;                               // of the first pixel of the row in the novel view
  int ox, oy;                             // of the pixels kept
  FloatVec a, right_of_a, b, right_of_b;  // upper and lower left, and the steps to their right neighbours

  Corners(const PreparedView& prepared, int left, int top, const PathSample& sample)
      : view(prepared), x(left), y(top) {
    load(sample);
  }

  FloatVec at(const PathSample& sample) {
    if (sample.ox != ox || sample.oy != oy) load(sample);
    const auto fx = hn::Set(Floats(), sample.fx);
    const auto upper = hn::Add(a, hn::Mul(fx, right_of_a)), lower = hn::Add(b, hn::Mul(fx, right_of_b));
    return hn::Add(upper, hn::Mul(hn::Set(Floats(), sample.fy), hn::Sub(lower, upper)));
  }

  void load(const PathSample& sample) {
    const Floats d;
    const int i = x + sample.ox, j = y + sample.oy;
    const float *upper = view.disparity_row(j) + i, *lower = view.disparity_row(j + 1) + i;
    a = hn::LoadU(d, upper);
    b = hn::LoadU(d, lower);
    right_of_a = hn::Sub(hn::LoadU(d, upper + 1), a);
    right_of_b = hn::Sub(hn::LoadU(d, lower + 1), b);
    ox = sample.ox;
    oy = sample.oy;
  }
};

/// Where lanes cross the surface: between two sub-samples, f before and at the crossing.
struct Crossings {
  FloatVec before, at, fx, fy, dx, dy;
  IntVec ox, oy;

  /// At a sub-sample itself, for all lanes.
  explicit Crossings(const PathSample& sample)
      : before(hn::Zero(Floats())),
        at(hn::Set(Floats(), -1.0f)),
        fx(hn::Set(Floats(), sample.fx)),
        fy(hn::Set(Floats(), sample.fy)),
        dx(hn::Zero(Floats())),
        dy(hn::Zero(Floats())),
        ox(hn::Set(Ints(), sample.ox)),
        oy(hn::Set(Ints(), sample.oy)) {}

  void set(LaneMask lanes, const PathSample* to, FloatVec f_before, FloatVec f) {
    const Floats d;
    const Ints di;
    const PathSample& from = *(to - 1);
    const auto int_lanes = hn::RebindMask(di, lanes);
    before = hn::IfThenElse(lanes, f_before, before);
    at = hn::IfThenElse(lanes, f, at);
    fx = hn::IfThenElse(lanes, hn::Set(d, from.fx), fx);
    fy = hn::IfThenElse(lanes, hn::Set(d, from.fy), fy);
    dx = hn::IfThenElse(lanes, hn::Set(d, to->dx), dx);
    dy = hn::IfThenElse(lanes, hn::Set(d, to->dy), dy);
    ox = hn::IfThenElse(int_lanes, hn::Set(di, from.ox), ox);
    oy = hn::IfThenElse(int_lanes, hn::Set(di, from.oy), oy);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#endif
