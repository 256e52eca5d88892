#include "core/lightfield/self_check_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/image/colour.h"

namespace plenolab {
namespace {

constexpr double kSmallestScale = 0.4, kLargestScale = 2.5;
constexpr float kMinGradient = 1.0f / 512;  // of gamma-encoded luminance between neighbouring pixels
constexpr float kOccluded_px = 0.5f;
constexpr float kDepthEdge_px = 1.0f;

double factor_of(Displacement displacement) {
  constexpr double kFactors[kDisplacements] = {1, -1, 1, 0.5, 2, 0};
  return kFactors[static_cast<std::size_t>(displacement)];
}

struct Sample {
  int x = 0, y = 0;
  float value = 0, disparity = 0;
};

template <class Referral>
Plane<float> encoded_luminance(const RgbImage<Referral>& image, float exposure) {
  Plane<float> out(image.width(), image.height());
  std::transform(image.pixels().begin(), image.pixels().end(), out.pixels().begin(), [exposure](Rgb c) {
    const float y = luminance(c);
    if (!std::isfinite(y)) return std::numeric_limits<float>::quiet_NaN();
    return std::is_same_v<Referral, SceneReferred> ? gamma_encode(exposure * y) : y;
  });
  return out;
}

float exposure_of(const SceneImage& image) {
  return exposure_from(image);
}
float exposure_of(const DisplayImage&) {
  return 1.0f;
}

// Bilinear value at image coordinates (pixel centres at + 0.5); NaN outside the pixel centres.
float value_at(const Plane<float>& plane, double x, double y) {
  const double u = x - 0.5, v = y - 0.5;
  if (!(u >= 0 && v >= 0 && u <= plane.width() - 1 && v <= plane.height() - 1))
    return std::numeric_limits<float>::quiet_NaN();
  const int x0 = std::min(static_cast<int>(u), std::max(plane.width() - 2, 0));
  const int y0 = std::min(static_cast<int>(v), std::max(plane.height() - 2, 0));
  const int x1 = std::min(x0 + 1, plane.width() - 1), y1 = std::min(y0 + 1, plane.height() - 1);
  const double fx = u - x0, fy = v - y0;
  const double top = plane.at(x0, y0) * (1 - fx) + plane.at(x1, y0) * fx;
  const double bottom = plane.at(x0, y1) * (1 - fx) + plane.at(x1, y1) * fx;
  return static_cast<float>(top * (1 - fy) + bottom * fy);
}

// Compares one pair of neighbouring views: P to the left of or above Q, so F_p − F_q is one spacing to the
// left or up.
class PairComparison {
 public:
  template <class Referral>
  PairComparison(const KeyView<Referral>& p, const KeyView<Referral>& q, bool vertical, double ratio,
                 int max_samples)
      : vertical_(vertical), ratio_(ratio), disparity_p_(p.disparity), disparity_q_(q.disparity) {
    const float exposure = exposure_of(p.colour);
    luminance_p_ = encoded_luminance(p.colour, exposure);
    luminance_q_ = encoded_luminance(q.colour, exposure);
    collect_samples(max_samples);
  }

  PairErrors compare() const {
    PairErrors result;
    result.vertical = vertical_;
    result.usable = static_cast<int>(samples_.size()) >= kMinSamples;
    if (!result.usable) return result;
    for (int d = 0; d < kDisplacements; ++d)
      result.error[static_cast<std::size_t>(d)] = median_difference(static_cast<Displacement>(d), 1.0);
    for (int i = 0; i < kScales; ++i)
      result.scale_error[static_cast<std::size_t>(i)] = median_difference(Displacement::kStated, scale_at(i));
    return result;
  }

 private:
  float warped(const Sample& s, Displacement kind, double scale) const {
    const bool along_y = vertical_ != (kind == Displacement::kSwapped);
    const double shift = -factor_of(kind) * scale * s.disparity * (vertical_ ? ratio_ : 1.0);
    return value_at(luminance_q_, s.x + 0.5 + (along_y ? 0 : shift), s.y + 0.5 + (along_y ? shift : 0));
  }

  // Largest luminance step to a neighbour along either axis; NaN next to an undefined value.
  float gradient(int x, int y) const {
    const auto& l = luminance_p_;
    const float right = l.at(std::min(x + 1, l.width() - 1), y) - l.at(x, y);
    const float down = l.at(x, std::min(y + 1, l.height() - 1)) - l.at(x, y);
    return std::isnan(right + down) ? right + down : std::max(std::abs(right), std::abs(down));
  }

  bool at_depth_edge(int x, int y) const {
    float low = disparity_p_.at(x, y), high = low;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, disparity_p_.height() - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, disparity_p_.width() - 1); ++u) {
        low = std::min(low, disparity_p_.at(u, v));
        high = std::max(high, disparity_p_.at(u, v));
      }
    return high - low > kDepthEdge_px;
  }

  bool occluded(const Sample& s) const {
    const double shift = -s.disparity * (vertical_ ? ratio_ : 1.0);
    const float there =
        value_at(disparity_q_, s.x + 0.5 + (vertical_ ? 0 : shift), s.y + 0.5 + (vertical_ ? shift : 0));
    return there > s.disparity + kOccluded_px;
  }

  // The same pixels for every displacement, or errors could not be compared.
  bool comparable(const Sample& s) const {
    for (int d = 0; d < kDisplacements; ++d)
      if (std::isnan(warped(s, static_cast<Displacement>(d), 1.0))) return false;
    return !at_depth_edge(s.x, s.y) && !occluded(s);
  }

  void collect_samples(int max_samples) {
    const double pixels = static_cast<double>(luminance_p_.size());
    const int stride = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / max_samples))));
    for (int y = 0; y < luminance_p_.height(); y += stride)
      for (int x = 0; x < luminance_p_.width(); x += stride) {
        const Sample s{x, y, luminance_p_.at(x, y), disparity_p_.at(x, y)};
        if (gradient(x, y) >= kMinGradient && comparable(s)) samples_.push_back(s);
      }
    keep_most_textured();
  }

  void keep_most_textured() {
    const std::size_t half = samples_.size() / 2;
    if (half < static_cast<std::size_t>(kMinSamples)) return;
    std::stable_sort(samples_.begin(), samples_.end(), [&](const Sample& a, const Sample& b) {
      return gradient(a.x, a.y) > gradient(b.x, b.y);
    });
    samples_.resize(half);
  }

  double median_difference(Displacement kind, double scale) const {
    std::vector<float> differences;
    differences.reserve(samples_.size());
    for (const Sample& s : samples_) {
      const float difference = std::abs(warped(s, kind, scale) - s.value);
      if (!std::isnan(difference)) differences.push_back(difference);
    }
    if (differences.size() < samples_.size() / 4) return std::numeric_limits<double>::infinity();
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    return *middle;
  }

  bool vertical_;
  double ratio_;
  const DisparityMap& disparity_p_;
  const DisparityMap& disparity_q_;
  Plane<float> luminance_p_, luminance_q_;
  std::vector<Sample> samples_;
};

}  // namespace

double scale_at(int i) {
  return kSmallestScale * std::pow(kLargestScale / kSmallestScale, static_cast<double>(i) / (kScales - 1));
}

PairErrors compare_neighbours(const KeyView<SceneReferred>& p, const KeyView<SceneReferred>& q, bool vertical,
                              double ratio, int max_samples) {
  return PairComparison(p, q, vertical, ratio, max_samples).compare();
}

PairErrors compare_neighbours(const KeyView<DisplayReferred>& p, const KeyView<DisplayReferred>& q,
                              bool vertical, double ratio, int max_samples) {
  return PairComparison(p, q, vertical, ratio, max_samples).compare();
}

}  // namespace plenolab
