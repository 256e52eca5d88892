#include "core/synthesis/search.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace plenolab {
namespace {

/// One pixel's search, the literal reading of rule 1.
class PixelSearch {
 public:
  PixelSearch(const PreparedView& view, const EpipolarPath& path, std::span<const std::uint64_t> candidates,
              int x, int y, SearchCounts& counts)
      : view_(view), path_(path), candidates_(candidates), x_(x), y_(y), counts_(counts) {}

  Hit run() {
    const ClippedPath clip = clip_path(path_, x_, y_);
    if (!clip.inside) return {};
    if (path_.is_key_view()) return at_sample(path_.samples.front());
    double previous = path_.start;
    int index = 0;
    if (clip.entered) {
      const PathSample entry = path_.at(clip.far);
      ++counts_.samples;
      if (disparity_at(entry) > entry.d) return {};
      previous = clip.far;
      while (index < path_.last() && path_.disparity(index) >= clip.far) ++index;
    }
    return clip.near > 0 ? walk_until(clip.near, index, previous) : walk_to_zero(index, previous);
  }

 private:
  /// The next sample to look at, from `index` on.
  int next(int index) const {
    if (candidates_.empty() || index >= path_.last()) return std::min(index, path_.last());
    auto word = static_cast<std::size_t>(index) / 64;
    std::uint64_t bits = candidates_[word] & (~std::uint64_t{0} << (index % 64));
    while (bits == 0) bits = candidates_[++word];  // ends at the last sample, whose bit is always set
    return static_cast<int>(word) * 64 + std::countr_zero(bits);
  }

  double before(int index, int first, double first_previous) const {
    return index == first ? first_previous : path_.disparity(index - 1);
  }

  bool is_hit(const PathSample& sample) {
    ++counts_.samples;
    return disparity_at(sample) > sample.d;
  }

  Hit walk_to_zero(int first, double previous) {
    int index = next(first);
    for (; index < path_.last(); index = next(index + 1))
      if (is_hit(path_.samples[static_cast<std::size_t>(index)])) break;
    if (index == path_.last()) ++counts_.samples;
    return refine(before(index, first, previous), path_.disparity(index));
  }

  /// B lies outside the image: the path leaves it at d = near > 0, where a miss proves nothing.
  Hit walk_until(double near, int first, double previous) {
    int index = next(first);
    for (; path_.disparity(index) > near; index = next(index + 1))
      if (is_hit(path_.samples[static_cast<std::size_t>(index)]))
        return refine(before(index, first, previous), path_.disparity(index));
    if (!is_hit(path_.at(near))) return {};
    while (index > first && path_.disparity(index - 1) <= near) --index;
    return refine(before(index, first, previous), near);
  }

  float disparity_at(const PathSample& sample) const {
    return bilinear_disparity(view_, x_ + sample.ox, y_ + sample.oy, sample.fx, sample.fy);
  }

  /// Second pass: the first crossing among the sub-samples, then one secant step; d_to itself if there is
  /// none.
  Hit refine(double d_from, double d_to) {
    PathSample previous = path_.sub_sample(d_from, d_to, 0);
    float previous_f = disparity_at(previous) - previous.d;
    for (int sub = 1; sub <= kSubSamples; ++sub) {
      const PathSample sample = path_.sub_sample(d_from, d_to, sub);
      const float disparity = disparity_at(sample);
      const float f = disparity - sample.d;
      ++counts_.refine;
      if (disparity > sample.d) {
        const float t = previous_f / (previous_f - f);
        return at(previous, previous.fx + t * sample.dx, previous.fy + t * sample.dy);
      }
      previous = sample;
      previous_f = f;
    }
    return at_sample(previous);
  }

  Hit at_sample(const PathSample& sample) const { return at(sample, sample.fx, sample.fy); }

  Hit at(const PathSample& sample, float gx, float gy) const {
    Hit hit;
    place(x_ + sample.ox, gx, view_.width, hit.i, hit.fx);
    place(y_ + sample.oy, gy, view_.height, hit.j, hit.fy);
    return hit;
  }

  /// Splits whole + g into index and fraction and keeps it inside the image.
  static void place(int whole, float g, int size, std::int32_t& index, float& fraction) {
    const float floor = std::floor(g);
    index = whole + static_cast<int>(floor);
    fraction = g - floor;
    if (fraction >= 1) {
      ++index;
      fraction = 0;
    }
    if (index < 0 || index >= size - 1) {
      index = index < 0 ? 0 : size - 1;
      fraction = 0;
    }
  }

  const PreparedView& view_;
  const EpipolarPath& path_;
  std::span<const std::uint64_t> candidates_;
  int x_, y_;
  SearchCounts& counts_;
};

}  // namespace

float bilinear_disparity(const PreparedView& view, int i, int j, float fx, float fy) {
  const float *upper = view.disparity_row(j) + i, *lower = view.disparity_row(j + 1) + i;
  const float a = upper[0] + fx * (upper[1] - upper[0]);
  const float b = lower[0] + fx * (lower[1] - lower[0]);
  return a + fy * (b - a);
}

Hit search_pixel(const PreparedView& view, const EpipolarPath& path,
                 std::span<const std::uint64_t> candidates, int x, int y, SearchCounts& counts) {
  return PixelSearch(view, path, candidates, x, y, counts).run();
}

}  // namespace plenolab
