#include "core/synthesis/epipolar_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace plenolab {
namespace {

/// Steps of paths that hardly move: large enough to leave the image's depth range, small enough for float.
constexpr double kMaxStep = 1e30;
/// No pixel of any image is this far from its path; keeps whole-pixel offsets within int.
constexpr double kMaxOffset_px = 1e8;

struct WholeAndFraction {
  int whole;
  float fraction;
};

/// Splits so that whole + fraction is the nearest representable position, fraction in [0, 1).
WholeAndFraction split(double offset) {
  offset = std::clamp(offset, -kMaxOffset_px, kMaxOffset_px);
  const double whole = std::floor(offset);
  const float fraction = static_cast<float>(offset - whole);
  if (fraction >= 1) return {static_cast<int>(whole) + 1, 0};
  return {static_cast<int>(whole), fraction};
}

/// Narrows [near, far] to the d with −tolerance ≤ u + v·d ≤ size − 1 + tolerance.
void clip_axis(double u, double v, int size, double& near, double& far) {
  const double low = -kInsideTolerance_px - u, high = size - 1 + kInsideTolerance_px - u;
  if (v == 0) {
    if (low > 0 || high < 0) far = -1;
    return;
  }
  near = std::max(near, (v > 0 ? low : high) / v);
  far = std::min(far, (v > 0 ? high : low) / v);
}

/// Number of positive samples: the k with d_max + (1 − k)·Δ > 0.
std::int64_t positive_samples(double d_max, double step) {
  auto count = static_cast<std::int64_t>(std::floor(d_max / step)) + 1;
  const auto value = [&](std::int64_t k) { return d_max + static_cast<double>(1 - k) * step; };
  while (value(count) > 0) ++count;
  while (count > 0 && value(count - 1) <= 0) --count;
  return count;
}

/// A k whose sample lies beyond the image for every pixel, or 0.
std::int64_t first_sample(const EpipolarPath& path) {
  double reach = path.start;
  if (path.vx != 0)
    reach = std::min(reach, (path.width - std::copysign(path.sx, path.sx * path.vx)) / std::abs(path.vx));
  if (path.vy != 0)
    reach = std::min(reach, (path.height - std::copysign(path.sy, path.sy * path.vy)) / std::abs(path.vy));
  reach = std::max(reach, 0.0);
  return std::max<std::int64_t>(
      0, static_cast<std::int64_t>(std::floor((path.d_max - reach) / path.step + 1)) - 1);
}

void tabulate(EpipolarPath& path) {
  path.first = first_sample(path);
  const std::int64_t positive = positive_samples(path.d_max, path.step);
  path.samples.resize(static_cast<std::size_t>(std::max<std::int64_t>(positive - path.first, 0)) + 1);
  for (int k = 0; k <= path.last(); ++k)
    path.samples[static_cast<std::size_t>(k)] = path.at(path.disparity(k));
  path.sub_samples.reserve(path.samples.size() * (kSubSamples + 1));
  for (int k = 0; k <= path.last(); ++k)
    for (int sub = 0; sub <= kSubSamples; ++sub)
      path.sub_samples.push_back(path.sub_sample(path.disparity(k - 1), path.disparity(k), sub));
}

/// The first sample with d_k < far.
int first_below(const EpipolarPath& path, double far) {
  int index =
      static_cast<int>(std::clamp((path.d_max - far) / path.step + 1 - static_cast<double>(path.first), 0.0,
                                  static_cast<double>(path.last())));
  while (index > 0 && path.disparity(index - 1) < far) --index;
  while (index < path.last() && path.disparity(index) >= far) ++index;
  return index;
}

std::vector<AxisClip> clip_all(const EpipolarPath& path, double offset, double v, int size) {
  std::vector<AxisClip> clips(static_cast<std::size_t>(size));
  for (int n = 0; n < size; ++n) {
    AxisClip& clip = clips[static_cast<std::size_t>(n)];
    clip.far = path.start;
    clip_axis(n + offset, v, size, clip.near, clip.far);
    if (clip.near > clip.far || clip.far == path.start) continue;
    clip.entry = path.at(clip.far);
    clip.first = first_below(path, clip.far);
  }
  return clips;
}

}  // namespace

double EpipolarPath::disparity(int index) const {
  if (index == last()) return 0;
  return d_max + static_cast<double>(1 - first - index) * step;
}

PathSample EpipolarPath::at(double d) const {
  const WholeAndFraction x = split(sx + vx * d), y = split(sy + vy * d);
  return {static_cast<float>(d), x.whole, y.whole, x.fraction, y.fraction, 0, 0};
}

PathSample EpipolarPath::sub_sample(double d_from, double d_to, int sub) const {
  const auto value = [&](int n) {
    return n == kSubSamples ? d_to : d_from + (d_to - d_from) * n / kSubSamples;
  };
  PathSample sample = at(value(sub));
  if (sub == 0) return sample;
  sample.dx = static_cast<float>(vx * (value(sub) - value(sub - 1)));
  sample.dy = static_cast<float>(vy * (value(sub) - value(sub - 1)));
  return sample;
}

EpipolarPath make_path(const ViewGrid& grid, CameraPosition position, const UsedView& view, double d_max,
                       const SynthesisOptions& options) {
  EpipolarPath path;
  path.width = grid.width;
  path.height = grid.height;
  path.vx = view.b_x;
  path.vy = view.b_y * grid.vertical_ratio();
  if (options.camera == CameraKind::kFixedScreen) {
    const double d_screen = grid.disparity_px(options.screen_depth_m);
    if (!(d_screen <= kMaxScreenDisparity_px))
      throw InputError(
          fmt::format("the screen depth of {} m is a disparity of {} px a column, more than {}: use a "
                      "screen farther away",
                      options.screen_depth_m, d_screen, kMaxScreenDisparity_px));
    path.sx = (0.5 * (grid.columns - 1) - position.s) * d_screen;
    path.sy = (0.5 * (grid.rows - 1) - position.t) * d_screen * grid.vertical_ratio();
  }
  path.d_max = d_max;
  if (path.is_key_view()) {
    path.samples = {path.at(0)};
    return path;
  }
  path.step = std::min(options.step_px / std::hypot(path.vx, path.vy), kMaxStep);
  path.start = d_max + path.step;
  tabulate(path);
  path.columns = clip_all(path, path.sx, path.vx, path.width);
  path.rows = clip_all(path, path.sy, path.vy, path.height);
  return path;
}

ClippedPath clip_path(const EpipolarPath& path, int x, int y) {
  ClippedPath clip{0, path.start, false, false};
  clip_axis(x + path.sx, path.vx, path.width, clip.near, clip.far);
  clip_axis(y + path.sy, path.vy, path.height, clip.near, clip.far);
  clip.inside = clip.far >= clip.near;
  clip.entered = clip.far < path.start;
  return clip;
}

}  // namespace plenolab
