#include "experiments/reproduce/claims/geometry_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"

namespace plenolab {

Mask beyond_rim(const Mask& mask, int block_px) {
  Mask kept(mask.width(), mask.height());
  const auto whole = [&](int x, int y) {
    for (int j = 0; j < block_px; ++j)
      for (int i = 0; i < block_px; ++i)
        if (mask.at(x + i, y + j) == 0) return false;
    return true;
  };
  for (int y = 0; y + block_px <= mask.height(); ++y)
    for (int x = 0; x + block_px <= mask.width(); ++x)
      if (whole(x, y))
        for (int j = 0; j < block_px; ++j)
          std::fill_n(kept.row(y + j) + x, block_px, static_cast<unsigned char>(1));
  return kept;
}

Mask where_zero(const Plane<std::uint8_t>& visible_views) {
  Mask mask(visible_views.width(), visible_views.height());
  std::transform(visible_views.pixels().begin(), visible_views.pixels().end(), mask.pixels().begin(),
                 [](std::uint8_t views) { return static_cast<unsigned char>(views == 0); });
  return mask;
}

Plane<float> squared_error(const SceneImage& test, const SceneImage& truth, float exposure) {
  const DisplayImage a = expose(test, exposure), b = expose(truth, exposure);
  Plane<float> error(a.width(), a.height());
  std::transform(a.pixels().begin(), a.pixels().end(), b.pixels().begin(), error.pixels().begin(),
                 [](Rgb p, Rgb q) {
                   const Rgb d = p - q;
                   return (d.r * d.r + d.g * d.g + d.b * d.b) / 3;
                 });
  return error;
}

double ErrorSum::rms() const {
  return pixels > 0 ? std::sqrt(squares / pixels) : 0;
}

std::string interval_text(const Interval& interval, int digits) {
  return fmt::format("{} ({} to {})", format_number(interval.estimate, digits),
                     format_number(interval.low, digits), format_number(interval.high, digits));
}

std::string outcome_text(Outcome outcome) {
  switch (outcome) {
    case Outcome::kConfirmed:
      return "The claim is confirmed here.";
    case Outcome::kRefuted:
      return "The claim is refuted here.";
    case Outcome::kUndecided:
      return "That does not decide the claim.";
  }
  return "";
}

void conclude(ReproductionResult& result, Claim claim, Verdict verdict) {
  const LedgerEntry entry{std::move(claim), std::move(verdict)};
  add_ledger_rows(result.rows, std::span(&entry, 1));
  result.ledger.push_back(entry);
}

std::vector<CameraPosition> judged_positions(const ViewGrid& grid, Effort effort) {
  std::vector<CameraPosition> positions = scored_positions(grid);
  if (effort == Effort::kTiny) positions.resize(std::min<std::size_t>(positions.size(), 1));
  return positions;
}

}  // namespace plenolab
