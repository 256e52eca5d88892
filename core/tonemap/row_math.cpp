#include "core/tonemap/row_math.h"

#include "core/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/row_math.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/tonemap/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {

void Log10Row(const float* x, float* out, std::size_t count) {
  MapRow(x, out, count, [](Vec v, LaneMask) { return hn::Mul(Log2(v), C(0.301029996f)); });
}

void Exp10Row(const float* x, float* out, std::size_t count) {
  MapRow(x, out, count, [](Vec v, LaneMask) { return Exp2(hn::Mul(v, C(3.321928095f))); });
}

void PowerRow(const float* x, float p, float* out, std::size_t count) {
  MapRow(x, out, count, [p](Vec v, LaneMask) { return Pow(v, p); });
}

void LuminanceRow(const Rgb* c, float* out, std::size_t count) {
  VisitPixels(c, count, [=](Vec r, Vec g, Vec b, std::size_t i, LaneMask) {
    StoreLanes(Luminance(r, g, b), out, i, count);
  });
}

void SplitRow(const Rgb* c, float* red, float* green, float* blue, std::size_t count) {
  VisitPixels(c, count, [=](Vec r, Vec g, Vec b, std::size_t i, LaneMask) {
    StoreLanes(r, red, i, count);
    StoreLanes(g, green, i, count);
    StoreLanes(b, blue, i, count);
  });
}

bool AllUsable(const Rgb* c, std::size_t count) {
  const Floats d;
  LaneMask good = AllLanes();
  const auto usable = [d](Vec v) { return hn::And(hn::Ge(v, hn::Zero(d)), hn::Le(v, C(kLargest))); };
  VisitPixels(c, count, [&](Vec r, Vec g, Vec b, std::size_t, LaneMask) {
    good = hn::And(good, hn::And(usable(r), hn::And(usable(g), usable(b))));
  });
  return hn::AllTrue(d, good);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(Log10Row);
HWY_EXPORT(Exp10Row);
HWY_EXPORT(PowerRow);
HWY_EXPORT(LuminanceRow);
HWY_EXPORT(SplitRow);
HWY_EXPORT(AllUsable);
}  // namespace

void log10_row(std::span<const float> x, std::span<float> out) {
  PLENOLAB_CHECK(x.size() == out.size(), "rows of equal length");
  HWY_DYNAMIC_DISPATCH(Log10Row)(x.data(), out.data(), x.size());
}

void exp10_row(std::span<const float> x, std::span<float> out) {
  PLENOLAB_CHECK(x.size() == out.size(), "rows of equal length");
  HWY_DYNAMIC_DISPATCH(Exp10Row)(x.data(), out.data(), x.size());
}

void power_row(std::span<const float> x, float p, std::span<float> out) {
  PLENOLAB_CHECK(x.size() == out.size() && p >= 0, "rows of equal length, exponent ≥ 0");
  HWY_DYNAMIC_DISPATCH(PowerRow)(x.data(), p, out.data(), x.size());
}

void luminance_row(std::span<const Rgb> c, std::span<float> out) {
  PLENOLAB_CHECK(c.size() == out.size(), "rows of equal length");
  HWY_DYNAMIC_DISPATCH(LuminanceRow)(c.data(), out.data(), c.size());
}

void split_row(std::span<const Rgb> c, std::span<float> r, std::span<float> g, std::span<float> b) {
  PLENOLAB_CHECK(c.size() == r.size() && c.size() == g.size() && c.size() == b.size(),
                 "rows of equal length");
  HWY_DYNAMIC_DISPATCH(SplitRow)(c.data(), r.data(), g.data(), b.data(), c.size());
}

bool all_usable(std::span<const Rgb> c) {
  return HWY_DYNAMIC_DISPATCH(AllUsable)(c.data(), c.size());
}

}  // namespace plenolab
#endif
