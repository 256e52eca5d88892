#include "core/lightfield/self_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

// Displacements tried along one axis; the hypotheses about the whole light field combine them.
enum Displacement { kStated, kFlipped, kSwapped, kHalf, kTwice, kNone, kDisplacements };

constexpr int kScales = 47;
constexpr double kSmallestScale = 0.4, kLargestScale = 2.5;
constexpr int kMinSamples = 64;             // fewer textured pixels say nothing
constexpr float kMinGradient = 1.0f / 512;  // of gamma-encoded luminance between neighbouring pixels
constexpr float kOccluded_px = 0.5f;
constexpr float kDepthEdge_px = 1.0f;
// A hypothesis must beat the stated one by this factor, and the stated one the opposite sign, to be believed.
constexpr double kClearlyBetter = 0.8;
constexpr double kScaleTolerance = 0.12;
// A scale is wrong if the stated one costs this share of what the opposite sign costs: noise, which raises
// all errors alike, then does not hide it.
constexpr double kScaleShare = 0.15;

double scale_at(int i) {
  return kSmallestScale * std::pow(kLargestScale / kSmallestScale, static_cast<double>(i) / (kScales - 1));
}

struct PairErrors {
  bool usable = false;
  bool vertical = false;
  std::array<double, kDisplacements> error{};
  std::array<double, kScales> scale_error{};
};

struct Pair {
  int column = 0, row = 0;
  bool vertical = false;
};

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
      result.scale_error[static_cast<std::size_t>(i)] = median_difference(kStated, scale_at(i));
    return result;
  }

 private:
  float warped(const Sample& s, Displacement kind, double scale) const {
    const double factor[kDisplacements] = {1, -1, 1, 0.5, 2, 0};
    const bool along_y = vertical_ != (kind == kSwapped);
    const double shift = -factor[kind] * scale * s.disparity * (vertical_ ? ratio_ : 1.0);
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

std::vector<Pair> choose_pairs(const ViewGrid& grid, int max_per_axis) {
  std::vector<Pair> pairs;
  for (const bool vertical : {false, true}) {
    const int columns = grid.columns - (vertical ? 0 : 1), rows = grid.rows - (vertical ? 1 : 0);
    const int all = columns * rows, count = std::min(all, max_per_axis);
    for (int i = 0; i < count; ++i) {
      const int index = static_cast<int>((2 * std::int64_t{i} + 1) * all / (2 * count));
      pairs.push_back({index % columns, index / columns, vertical});
    }
  }
  return pairs;
}

struct AxisErrors {
  int pairs = 0;
  std::array<double, kDisplacements> error{};
  std::array<double, kScales> scale_error{};

  void add(const PairErrors& pair) {
    ++pairs;
    for (std::size_t i = 0; i < error.size(); ++i) error[i] += pair.error[i];
    for (std::size_t i = 0; i < scale_error.size(); ++i) scale_error[i] += pair.scale_error[i];
  }
};

double combined(const AxisErrors& x, Displacement dx, const AxisErrors& y, Displacement dy) {
  return (x.error[dx] + y.error[dy]) / (x.pairs + y.pairs);
}

void fill_errors(const AxisErrors& x, const AxisErrors& y, SelfCheckResult& result) {
  using H = DisparityHypothesis;
  const auto add = [&](H h, Displacement dx, Displacement dy) {
    result.errors.push_back({h, combined(x, dx, y, dy)});
  };
  add(H::kAsStated, kStated, kStated);
  if (x.pairs > 0) add(H::kFlippedX, kFlipped, kStated);
  if (y.pairs > 0) add(H::kFlippedY, kStated, kFlipped);
  if (x.pairs > 0 && y.pairs > 0) add(H::kFlippedBoth, kFlipped, kFlipped);
  add(H::kSwappedAxes, kSwapped, kSwapped);
  add(H::kHalved, kHalf, kHalf);
  add(H::kDoubled, kTwice, kTwice);
  add(H::kNoShift, kNone, kNone);
}

// Scale of least error and that error, per pair.
std::pair<double, double> best_scale(const AxisErrors& x, const AxisErrors& y) {
  std::pair<double, double> best{1.0, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kScales; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    const double error = (x.scale_error[at] + y.scale_error[at]) / (x.pairs + y.pairs);
    if (error < best.second) best = {scale_at(i), error};
  }
  return best;
}

// Whether another scale than the stated one explains the pairs of these axes better, beyond noise.
bool is_wrong_scale(const AxisErrors& x, const AxisErrors& y) {
  const auto [scale, scaled_error] = best_scale(x, y);
  const double stated = combined(x, kStated, y, kStated), opposite = combined(x, kFlipped, y, kFlipped);
  return std::abs(scale - 1) > kScaleTolerance &&
         stated - scaled_error > kScaleShare * (opposite - scaled_error);
}

SelfCheckVerdict verdict_of(DisparityHypothesis hypothesis) {
  switch (hypothesis) {
    case DisparityHypothesis::kAsStated:
      return SelfCheckVerdict::kConsistent;
    case DisparityHypothesis::kFlippedX:
      return SelfCheckVerdict::kWrongSignX;
    case DisparityHypothesis::kFlippedY:
      return SelfCheckVerdict::kWrongSignY;
    case DisparityHypothesis::kFlippedBoth:
      return SelfCheckVerdict::kWrongSignBoth;
    case DisparityHypothesis::kSwappedAxes:
      return SelfCheckVerdict::kSwappedAxes;
    case DisparityHypothesis::kHalved:
    case DisparityHypothesis::kDoubled:
      return SelfCheckVerdict::kWrongScale;
    case DisparityHypothesis::kNoShift:
      return SelfCheckVerdict::kInconsistent;
  }
  return SelfCheckVerdict::kUndecidable;
}

void decide(const AxisErrors& x, const AxisErrors& y, SelfCheckResult& result) {
  fill_errors(x, y, result);
  const auto by_error = [](const HypothesisError& a, const HypothesisError& b) { return a.error < b.error; };
  const HypothesisError best = *std::min_element(result.errors.begin(), result.errors.end(), by_error);
  const double stated = result.errors.front().error;
  const auto [scale, scaled_error] = best_scale(x, y);
  result.best_scale = scale;
  const AxisErrors nothing;
  if (x.pairs > 0) result.best_scale_x = best_scale(x, nothing).first;
  if (y.pairs > 0) result.best_scale_y = best_scale(nothing, y).first;
  const bool wrong_along_an_axis =
      (x.pairs > 0 && is_wrong_scale(x, nothing)) || (y.pairs > 0 && is_wrong_scale(nothing, y));
  // How much a mistake in sign shows at all; a light field without disparity or texture shows none.
  const double none = result.error(DisparityHypothesis::kNoShift);
  const double opposite = combined(x, kFlipped, y, kFlipped);
  const bool flipped_scale = best.hypothesis != DisparityHypothesis::kAsStated &&
                             verdict_of(best.hypothesis) != SelfCheckVerdict::kWrongScale &&
                             best.error <= scaled_error;
  if (flipped_scale && best.error < kClearlyBetter * stated)
    result.verdict = verdict_of(best.hypothesis);
  else if (is_wrong_scale(x, y) ||
           (wrong_along_an_axis && stated < kClearlyBetter * std::max(opposite, none)))
    result.verdict = SelfCheckVerdict::kWrongScale;
  else if (stated < kClearlyBetter * std::max(opposite, none))
    result.verdict = SelfCheckVerdict::kConsistent;
  else
    result.verdict = SelfCheckVerdict::kUndecidable;
}

std::string explain(const SelfCheckResult& r) {
  switch (r.verdict) {
    case SelfCheckVerdict::kConsistent:
      return "disparity explains the neighbouring views";
    case SelfCheckVerdict::kWrongSignX:
      return "the views match if the columns run the other way: mirror the order of the columns";
    case SelfCheckVerdict::kWrongSignY:
      return "the views match if the rows run the other way: mirror the order of the rows";
    case SelfCheckVerdict::kWrongSignBoth:
      return "the views match if disparity has the other sign: mirror the order of rows and columns";
    case SelfCheckVerdict::kSwappedAxes:
      return "the views match if rows and columns are exchanged: swap {row} and {column} in the file names";
    case SelfCheckVerdict::kWrongScale:
      return fmt::format(
          "the views match if disparity is multiplied by {:.2f} between columns and {:.2f} between rows: "
          "correct "
          "the spacings, the opening angle or the unit of depth",
          r.best_scale_x, r.best_scale_y);
    case SelfCheckVerdict::kInconsistent:
      return "the views match best without any displacement, although disparity is not zero";
    case SelfCheckVerdict::kUndecidable:
      return "there is too little texture, disparity or overlap between neighbouring views to judge";
  }
  return {};
}

template <class Referral>
std::vector<PairErrors> compare_pairs(const BasicLightField<Referral>& light_field,
                                      const std::vector<Pair>& pairs, const SelfCheckOptions& options,
                                      const Progress& progress) {
  const ViewGrid& grid = light_field.grid();
  std::vector<PairErrors> errors(pairs.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  parallel_for(static_cast<int>(pairs.size()), 1, options.threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Pair& pair = pairs[static_cast<std::size_t>(i)];
      const auto p = light_field.view(pair.column, pair.row);
      const auto q =
          light_field.view(pair.column + (pair.vertical ? 0 : 1), pair.row + (pair.vertical ? 1 : 0));
      errors[static_cast<std::size_t>(i)] =
          PairComparison(*p, *q, pair.vertical, grid.vertical_ratio(), options.max_samples).compare();
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (progress) progress(static_cast<double>(done) / static_cast<double>(pairs.size()));
    }
  });
  return errors;
}

template <class Referral>
SelfCheckResult check_any(const BasicLightField<Referral>& light_field, const SelfCheckOptions& options,
                          const Progress& progress) {
  options.validate();
  const std::vector<Pair> pairs = choose_pairs(light_field.grid(), options.max_pairs_per_axis);
  AxisErrors x, y;
  for (const PairErrors& pair : compare_pairs(light_field, pairs, options, progress))
    if (pair.usable) (pair.vertical ? y : x).add(pair);
  SelfCheckResult result;
  result.pairs = x.pairs + y.pairs;
  if (result.pairs > 0) decide(x, y, result);
  result.explanation = explain(result);
  return result;
}

}  // namespace

const char* describe(DisparityHypothesis hypothesis) {
  switch (hypothesis) {
    case DisparityHypothesis::kAsStated:
      return "as stated";
    case DisparityHypothesis::kFlippedX:
      return "x flipped";
    case DisparityHypothesis::kFlippedY:
      return "y flipped";
    case DisparityHypothesis::kFlippedBoth:
      return "x and y flipped";
    case DisparityHypothesis::kSwappedAxes:
      return "axes swapped";
    case DisparityHypothesis::kHalved:
      return "disparity halved";
    case DisparityHypothesis::kDoubled:
      return "disparity doubled";
    case DisparityHypothesis::kNoShift:
      return "no shift";
  }
  return "unknown";
}

double SelfCheckResult::error(DisparityHypothesis hypothesis) const {
  const auto found = std::find_if(errors.begin(), errors.end(),
                                  [&](const HypothesisError& e) { return e.hypothesis == hypothesis; });
  return found == errors.end() ? std::numeric_limits<double>::infinity() : found->error;
}

void SelfCheckOptions::validate() const {
  if (max_pairs_per_axis < 1)
    throw InputError(
        fmt::format("the self-check needs at least one pair an axis, not {}", max_pairs_per_axis));
  if (max_samples < kMinSamples)
    throw InputError(
        fmt::format("the self-check needs at least {} samples, not {}", kMinSamples, max_samples));
  resolve_threads(threads);
}

SelfCheckResult self_check(const LightField& light_field, const SelfCheckOptions& options,
                           const Progress& progress) {
  return check_any(light_field, options, progress);
}

SelfCheckResult self_check(const DisplayLightField& light_field, const SelfCheckOptions& options,
                           const Progress& progress) {
  return check_any(light_field, options, progress);
}

void require_consistent(const SelfCheckResult& result, const std::string& light_field_name) {
  if (result.verdict == SelfCheckVerdict::kConsistent || result.verdict == SelfCheckVerdict::kUndecidable)
    return;
  throw InputError(fmt::format("{} contradicts itself: {}", light_field_name, result.explanation));
}

}  // namespace plenolab
