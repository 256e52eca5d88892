#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// What the geometry claims measure with.

/// The rim is what sampling alone costs: occluders lose half a pixel a side, and the disparity map knows
/// their outline to a pixel. One pixel lost on each of two opposite sides makes strips of up to two pixels,
/// so a pixel of the mask lies beyond the rim if it belongs to a 3 × 3 block that is wholly in the mask. With
/// `block_px` 2 only strips of one pixel are rim: one of the two sides alone.
Mask beyond_rim(const Mask& mask, int block_px = 3);

/// 1 where no key view sees the surface before restoration (red in the visibility map).
Mask where_zero(const Plane<std::uint8_t>& visible_views);

/// Mean over the channels of the squared difference of clamp(exposure·C, 0, 1)^(1/2.2), pixel by pixel.
Plane<float> squared_error(const SceneImage& test, const SceneImage& truth, float exposure);

/// Sum and number of squared errors over some pixels, to be pooled.
struct ErrorSum {
  double squares = 0;
  double pixels = 0;
  void add(double square) { squares += square, pixels += 1; }
  ErrorSum& operator+=(const ErrorSum& other) {
    squares += other.squares, pixels += other.pixels;
    return *this;
  }
  double rms() const;  ///< 0 for no pixels
};

/// "0.12 (0.10 to 0.15)".
std::string interval_text(const Interval& interval, int digits = 3);
/// "The claim is confirmed." in the words of the outcome.
std::string outcome_text(Outcome outcome);

/// Files a decided claim in the result: ledger entry and its row.
void conclude(ReproductionResult& result, Claim claim, Verdict verdict);

/// Positions at which rendered scenes are judged: scored_positions, in a tiny run the first of them alone.
std::vector<CameraPosition> judged_positions(const ViewGrid& grid, Effort effort);

}  // namespace plenolab
