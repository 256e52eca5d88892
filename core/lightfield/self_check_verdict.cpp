#include "core/lightfield/self_check_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace plenolab {
namespace {

using D = Displacement;

// A hypothesis must beat the stated one by this factor, and the stated one the opposite sign, to be believed.
constexpr double kClearlyBetter = 0.8;
constexpr double kScaleTolerance = 0.12;
// A scale is wrong if the stated one costs this share of what the opposite sign costs: noise, which raises
// all errors alike, then does not hide it.
constexpr double kScaleShare = 0.15;

double combined(const AxisErrors& x, D dx, const AxisErrors& y, D dy) {
  return (x.error[static_cast<std::size_t>(dx)] + y.error[static_cast<std::size_t>(dy)]) /
         (x.pairs + y.pairs);
}

void fill_errors(const AxisErrors& x, const AxisErrors& y, SelfCheckResult& result) {
  using H = DisparityHypothesis;
  const auto add = [&](H h, D dx, D dy) { result.errors.push_back({h, combined(x, dx, y, dy)}); };
  add(H::kAsStated, D::kStated, D::kStated);
  if (x.pairs > 0) add(H::kFlippedX, D::kFlipped, D::kStated);
  if (y.pairs > 0) add(H::kFlippedY, D::kStated, D::kFlipped);
  if (x.pairs > 0 && y.pairs > 0) add(H::kFlippedBoth, D::kFlipped, D::kFlipped);
  add(H::kSwappedAxes, D::kSwapped, D::kSwapped);
  add(H::kHalved, D::kHalf, D::kHalf);
  add(H::kDoubled, D::kTwice, D::kTwice);
  add(H::kNoShift, D::kNone, D::kNone);
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
  const double stated = combined(x, D::kStated, y, D::kStated),
               opposite = combined(x, D::kFlipped, y, D::kFlipped);
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

void fill_scales(const AxisErrors& x, const AxisErrors& y, SelfCheckResult& result) {
  const AxisErrors nothing;
  result.best_scale = best_scale(x, y).first;
  if (x.pairs > 0) result.best_scale_x = best_scale(x, nothing).first;
  if (y.pairs > 0) result.best_scale_y = best_scale(nothing, y).first;
}

bool is_wrong_scale_along_an_axis(const AxisErrors& x, const AxisErrors& y) {
  const AxisErrors nothing;
  return (x.pairs > 0 && is_wrong_scale(x, nothing)) || (y.pairs > 0 && is_wrong_scale(nothing, y));
}

// From the errors in `result`, which are filled.
SelfCheckVerdict verdict(const AxisErrors& x, const AxisErrors& y, const SelfCheckResult& result) {
  const auto by_error = [](const HypothesisError& a, const HypothesisError& b) { return a.error < b.error; };
  const HypothesisError best = *std::min_element(result.errors.begin(), result.errors.end(), by_error);
  const double stated = result.error(DisparityHypothesis::kAsStated);
  const bool flipped = best.hypothesis != DisparityHypothesis::kAsStated &&
                       verdict_of(best.hypothesis) != SelfCheckVerdict::kWrongScale &&
                       best.error <= best_scale(x, y).second;
  if (flipped && best.error < kClearlyBetter * stated) return verdict_of(best.hypothesis);
  // How much a mistake in sign shows at all; a light field without disparity or texture shows none.
  const double mistaken =
      std::max(combined(x, D::kFlipped, y, D::kFlipped), result.error(DisparityHypothesis::kNoShift));
  const bool explains = stated < kClearlyBetter * mistaken;
  if (is_wrong_scale(x, y) || (explains && is_wrong_scale_along_an_axis(x, y)))
    return SelfCheckVerdict::kWrongScale;
  return explains ? SelfCheckVerdict::kConsistent : SelfCheckVerdict::kUndecidable;
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
          "correct the spacings, the opening angle or the unit of depth",
          r.best_scale_x, r.best_scale_y);
    case SelfCheckVerdict::kInconsistent:
      return "the views match best without any displacement, although disparity is not zero";
    case SelfCheckVerdict::kUndecidable:
      return "there is too little texture, disparity or overlap between neighbouring views to judge";
  }
  return {};
}

}  // namespace

void AxisErrors::add(const PairErrors& pair) {
  ++pairs;
  for (std::size_t i = 0; i < error.size(); ++i) error[i] += pair.error[i];
  for (std::size_t i = 0; i < scale_error.size(); ++i) scale_error[i] += pair.scale_error[i];
}

SelfCheckResult judge(const AxisErrors& x, const AxisErrors& y) {
  SelfCheckResult result;
  result.pairs = x.pairs + y.pairs;
  if (result.pairs > 0) {
    fill_errors(x, y, result);
    fill_scales(x, y, result);
    result.verdict = verdict(x, y, result);
  }
  result.explanation = explain(result);
  return result;
}

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

void require_consistent(const SelfCheckResult& result, const std::string& light_field_name) {
  if (result.verdict == SelfCheckVerdict::kConsistent || result.verdict == SelfCheckVerdict::kUndecidable)
    return;
  throw InputError(fmt::format("{} contradicts itself: {}", light_field_name, result.explanation));
}

}  // namespace plenolab
