#include "core/synthesis/patch_blend.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/synthesis/patch_blend.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/synthesis/gamma_decode-inl.h"
#include "core/synthesis/look_up_pixel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, TileOccupancy::kTileWidth>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVec = hn::Vec<Floats>;
using LaneMask = hn::Mask<Floats>;

/// Weights are scaled by this so that the smallest product of weights stays a normal float; it cancels in the
/// division.
constexpr double kWeightScale = 1e18;
/// Added to W_bi where no surviving view has any (rule 5).
constexpr double kFallbackWeight = 1e-6;

/// Blends the pixels of one vector.
class VectorBlend {
 public:
  VectorBlend(const BlendSetup& setup, PatchViews& views, int index, int lanes)
      : setup_(setup),
        views_(views),
        index_(index),
        valid_(hn::FirstN(Floats(), static_cast<std::size_t>(lanes))) {
    const Floats d;
    restoring_ = hn::FirstN(d, 0);
    test_visibility();
  }

  bool wants_restoration() const { return setup_.options.restore && !hn::AllFalse(Floats(), restorable()); }

  /// Rule 4: moves the hits of the pixels that no view in frustum may show to the background beside them.
  void restore() {
    const Floats d;
    restoring_ = restorable();
    alignas(64) float flags[TileOccupancy::kTileWidth];
    hn::Store(hn::IfThenElseZero(restoring_, hn::Set(d, 1.0f)), d, flags);
    for (int v = 0; v < setup_.count; ++v) {
      PatchView& view = this->view(v);
      for (int lane = 0; lane < static_cast<int>(hn::Lanes(d)); ++lane) {
        const int n = index_ + lane;
        if (flags[lane] == 0 || view.hits.i[n] < 0) continue;
        view.hits.set(n, background_pixel(*setup_.prepared[static_cast<std::size_t>(v)], view.hits.get(n)));
        LookUpPixel(*setup_.prepared[static_cast<std::size_t>(v)], view.hits.get(n),
                    view.colour_disparity + 4 * n, view.range + n);
      }
      used_[v] = hn::Or(used_[v], hn::And(restoring_, in_frustum_[v]));
    }
  }

  void blend() {
    const Floats d;
    weigh(kBilinear);
    const LaneMask none = hn::And(hn::Eq(sum_, hn::Zero(d)), any_used());
    if (!hn::AllFalse(d, none)) weigh_where(none);
    mix();
  }

  void count(SynthesisStatistics& statistics) const {
    const Floats d;
    for (int v = 0; v < setup_.count; ++v) {
      const LaneMask restored = hn::And(restoring_, in_frustum_[v]);
      const LaneMask zero = hn::And(used_[v], hn::Eq(weight_[v], hn::Zero(d)));
      statistics.out_of_frustum += hn::CountTrue(d, hn::AndNot(in_frustum_[v], valid_));
      statistics.restored += hn::CountTrue(d, restored);
      statistics.disoccluded += hn::CountTrue(d, disoccluded(v));
      statistics.occluded += hn::CountTrue(d, hn::AndNot(used_[v], passed_[v]));
      statistics.weight_zero += hn::CountTrue(d, hn::AndNot(restored, zero));
      statistics.used += hn::CountTrue(d, hn::AndNot(hn::Or(zero, restored), used_[v]));
    }
  }

  void record() {
    const Floats d;
    const Ints di;
    const auto state = [&](CorrespondenceState s) { return hn::Set(di, static_cast<std::int32_t>(s)); };
    const auto where = [&](LaneMask mask, CorrespondenceState yes, auto no) {
      return hn::IfThenElse(hn::RebindMask(di, mask), state(yes), no);
    };
    for (int v = 0; v < setup_.count; ++v) {
      auto result = state(CorrespondenceState::kOutOfFrustum);
      result = where(in_frustum_[v], CorrespondenceState::kDisocclusion, result);
      result = where(passed_[v], CorrespondenceState::kOccluded, result);
      result = where(used_[v], CorrespondenceState::kUsed, result);
      result =
          where(hn::And(used_[v], hn::Eq(weight_[v], hn::Zero(d))), CorrespondenceState::kWeightZero, result);
      result = where(hn::And(restoring_, in_frustum_[v]), CorrespondenceState::kRestored, result);
      hn::Store(result, di, view(v).state + index_);
      hn::Store(hn::IfThenElseZero(hn::Gt(sum_, hn::Zero(d)), hn::Div(weight_[v], sum_)), d,
                view(v).share + index_);
    }
  }

  /// Interleaved r, g, b of the lanes.
  void store_colour(float* rgb) const { hn::StoreInterleaved3(r_, g_, b_, Floats(), rgb); }

  /// Number of views that see each pixel, before restoration.
  void store_visible(std::int32_t* counts) const {
    const Ints di;
    auto count = hn::Zero(di);
    for (int v = 0; v < setup_.count; ++v)
      count = hn::Add(count, hn::IfThenElseZero(hn::RebindMask(di, survived_[v]), hn::Set(di, 1)));
    hn::Store(count, di, counts);
  }

  void store_masks(std::int32_t* unseen, std::int32_t* restored) const {
    const Ints di;
    const auto one = hn::Set(di, 1);
    hn::Store(hn::IfThenZeroElse(hn::RebindMask(di, any_used()), one), di, unseen);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(di, restoring_), one), di, restored);
  }

 private:
  enum Weighting { kBilinear, kFallback };

  PatchView& view(int v) const { return views_.views[static_cast<std::size_t>(v)]; }
  const UsedView& used_view(int v) const { return setup_.used[static_cast<std::size_t>(v)]; }

  void load_colour(int v, FloatVec& r, FloatVec& g, FloatVec& b, FloatVec& disparity) const {
    hn::LoadInterleaved4(Floats(), view(v).colour_disparity + 4 * index_, r, g, b, disparity);
  }

  /// Rules 2 and 3.
  void test_visibility() {
    const Floats d;
    const Ints di;
    FloatVec disparity[kMaxViews];
    auto front = hn::Set(d, -1.0f);
    for (int v = 0; v < setup_.count; ++v) {
      FloatVec r, g, b;
      load_colour(v, r, g, b, disparity[v]);
      const auto found = hn::Gt(hn::Load(di, view(v).hits.i + index_), hn::Set(di, -1));
      in_frustum_[v] = passed_[v] = hn::And(valid_, hn::RebindMask(d, found));
      if (setup_.test_disocclusion) {
        const auto limit = hn::Set(d, static_cast<float>(setup_.options.disocclusion_px));
        passed_[v] = hn::And(passed_[v], hn::Le(hn::Load(d, view(v).range + index_), limit));
      }
      front = hn::Max(front, hn::IfThenElse(passed_[v], disparity[v], hn::Set(d, -1.0f)));
    }
    const auto margin = hn::Set(d, static_cast<float>(setup_.options.occlusion_margin_px));
    for (int v = 0; v < setup_.count; ++v) {
      survived_[v] = passed_[v];
      if (setup_.test_occlusion)
        survived_[v] = hn::AndNot(hn::Gt(front, hn::Add(disparity[v], margin)), passed_[v]);
      used_[v] = survived_[v];
    }
  }

  LaneMask any_of(const LaneMask* masks) const {
    LaneMask any = hn::FirstN(Floats(), 0);
    for (int v = 0; v < setup_.count; ++v) any = hn::Or(any, masks[v]);
    return any;
  }
  LaneMask any_used() const { return any_of(used_); }
  /// Pixels in some frustum whose views all failed rule 2.
  LaneMask restorable() const { return hn::AndNot(any_of(passed_), any_of(in_frustum_)); }
  LaneMask disoccluded(int v) const { return hn::AndNot(restoring_, hn::AndNot(passed_[v], in_frustum_[v])); }

  /// W_bo of one axis at A, `baseline` = |b_x| + δ_bo.
  FloatVec border_weight(const std::int32_t* index, const float* fraction, int size, double baseline) const {
    const Floats d;
    const Ints di;
    if (setup_.options.border_weight == BorderWeight::kNone) return hn::Set(d, 1.0f);
    const auto a =
        hn::Add(hn::ConvertTo(d, hn::Load(di, index)), hn::Add(hn::Load(d, fraction), hn::Set(d, 0.5f)));
    const auto distance = hn::Min(a, hn::Sub(hn::Set(d, static_cast<float>(size)), a));
    const auto inverse = hn::Set(d, static_cast<float>(1 / (setup_.options.border_fraction * size)));
    const auto one = hn::Set(d, 1.0f);
    const auto g = hn::Max(hn::Min(hn::Mul(distance, inverse), one), hn::Zero(d));
    if (setup_.options.border_weight == BorderWeight::kLinearGradient) return g;
    const auto g3 = hn::Mul(hn::Mul(g, g), g);
    const auto near = hn::Mul(hn::Mul(hn::Sub(one, g3), g), hn::Set(d, static_cast<float>(baseline)));
    return hn::Add(hn::Mul(g3, g), near);
  }

  FloatVec weight(int v, Weighting weighting) const {
    const Floats d;
    const PatchHits& hits = view(v).hits;
    const UsedView& used = used_view(v);
    const PreparedView& prepared = *setup_.prepared[static_cast<std::size_t>(v)];
    const double bilinear = used.weight + (weighting == kFallback ? kFallbackWeight : 0);
    const auto horizontal = border_weight(hits.i + index_, hits.fx + index_, prepared.width,
                                          std::abs(used.b_x) + setup_.options.border_delta);
    const auto vertical = border_weight(hits.j + index_, hits.fy + index_, prepared.height,
                                        std::abs(used.b_y) + setup_.options.border_delta);
    const auto w =
        hn::Mul(hn::Mul(horizontal, vertical), hn::Set(d, static_cast<float>(bilinear * kWeightScale)));
    return hn::IfThenElseZero(used_[v], w);
  }

  void weigh(Weighting weighting) {
    sum_ = hn::Zero(Floats());
    for (int v = 0; v < setup_.count; ++v) {
      weight_[v] = weight(v, weighting);
      sum_ = hn::Add(sum_, weight_[v]);
    }
  }

  void weigh_where(LaneMask lanes) {
    FloatVec kept[kMaxViews];
    std::copy_n(weight_, setup_.count, kept);
    const FloatVec kept_sum = sum_;
    weigh(kFallback);
    for (int v = 0; v < setup_.count; ++v) weight_[v] = hn::IfThenElse(lanes, weight_[v], kept[v]);
    sum_ = hn::IfThenElse(lanes, sum_, kept_sum);
  }

  /// The weighted mean; a single contributing view gives its colour unchanged.
  void mix() {
    const Floats d;
    const auto zero = hn::Zero(d);
    r_ = g_ = b_ = zero;
    auto alone_r = zero, alone_g = zero, alone_b = zero;
    for (int v = 0; v < setup_.count; ++v) {
      FloatVec r, g, b, disparity;
      load_colour(v, r, g, b, disparity);
      const LaneMask contributes = hn::Gt(weight_[v], zero);
      const LaneMask alone = hn::And(contributes, hn::Eq(weight_[v], sum_));
      add(r_, r, v, contributes);
      add(g_, g, v, contributes);
      add(b_, b, v, contributes);
      alone_r = hn::IfThenElse(alone, r, alone_r);
      alone_g = hn::IfThenElse(alone, g, alone_g);
      alone_b = hn::IfThenElse(alone, b, alone_b);
      alone_ = v == 0 ? alone : hn::Or(alone_, alone);
    }
    r_ = finish(r_, alone_r);
    g_ = finish(g_, alone_g);
    b_ = finish(b_, alone_b);
  }

  void add(FloatVec& sum, FloatVec value, int v, LaneMask contributes) const {
    sum = hn::Add(sum, hn::IfThenElseZero(contributes, hn::Mul(weight_[v], value)));
  }

  FloatVec finish(FloatVec sum, FloatVec alone) const {
    const Floats d;
    auto mean = hn::IfThenElseZero(hn::Gt(sum_, hn::Zero(d)), hn::Div(sum, sum_));
    mean = hn::IfThenElse(alone_, alone, mean);
    return setup_.decode ? DecodeGamma(d, hn::Max(mean, hn::Zero(d))) : mean;
  }

  const BlendSetup& setup_;
  PatchViews& views_;
  int index_;
  LaneMask valid_, restoring_, alone_;
  LaneMask in_frustum_[kMaxViews], passed_[kMaxViews], survived_[kMaxViews], used_[kMaxViews];
  FloatVec weight_[kMaxViews];
  FloatVec sum_, r_, g_, b_;
};

void CopyBytes(const std::int32_t* values, int count, std::uint8_t* out) {
  for (int n = 0; n < count; ++n) out[n] = static_cast<std::uint8_t>(values[n]);
}

SynthesisStatistics BlendVectors(const BlendSetup& setup, const Patch& patch, PatchViews& views,
                                 const BlendOutput& out) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Floats()));
  SynthesisStatistics statistics;
  alignas(64) float rgb[3 * TileOccupancy::kTileWidth];
  alignas(64) std::int32_t first[TileOccupancy::kTileWidth], second[TileOccupancy::kTileWidth];
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; x += kLanes) {
      const int lanes = std::min(kLanes, patch.width - x);
      VectorBlend blend(setup, views, y * Patch::kMaxWidth + x, lanes);
      if (blend.wants_restoration()) blend.restore();
      blend.blend();
      blend.count(statistics);
      if (setup.record) blend.record();
      blend.store_colour(rgb);
      std::memcpy(&out.image->at(patch.x + x, patch.y + y), rgb,
                  sizeof(Rgb) * static_cast<std::size_t>(lanes));
      blend.store_visible(first);
      CopyBytes(first, lanes, &out.visible_views->at(patch.x + x, patch.y + y));
      blend.store_masks(first, second);
      CopyBytes(first, lanes, &out.unseen->at(patch.x + x, patch.y + y));
      CopyBytes(second, lanes, &out.restored->at(patch.x + x, patch.y + y));
    }
  return statistics;
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {
HWY_EXPORT(BlendVectors);
}  // namespace

SynthesisStatistics blend_patch(const BlendSetup& setup, const Patch& patch, PatchViews& views,
                                const BlendOutput& out) {
  return HWY_DYNAMIC_DISPATCH(BlendVectors)(setup, patch, views, out);
}

}  // namespace plenolab
#endif  // HWY_ONCE
