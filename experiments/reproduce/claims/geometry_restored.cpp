#include "experiments/reproduce/claims/geometry_restored.h"

#include <algorithm>

namespace plenolab {

namespace {

/// Disparity of the restored background: the weighted mean of its correspondences.
double restored_disparity(const PixelProvenance& pixel) {
  double sum = 0, weights = 0;
  for (const Correspondence& c : pixel) {
    if (c.state != CorrespondenceState::kRestored) continue;
    sum += static_cast<double>(c.weight) * static_cast<double>(c.disparity_px);
    weights += static_cast<double>(c.weight);
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

RestorationErrors& RestorationErrors::operator+=(const RestorationErrors& other) {
  background += other.background;
  foreground += other.foreground;
  rest += other.rest;
  return *this;
}

RestorationErrors restoration_errors(const NovelView<SceneReferred>& view,
                                     const KeyView<SceneReferred>& truth, float exposure) {
  const Plane<float> squares = squared_error(view.image, truth.colour, exposure);
  RestorationErrors errors;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto square = static_cast<double>(squares.pixels()[i]);
    if (view.restored.pixels()[i] != 0) {
      const double nearer =
          static_cast<double>(truth.disparity.pixels()[i]) - restored_disparity(view.provenance.pixels()[i]);
      (nearer <= kSameSurface_px ? errors.background : errors.foreground).add(square);
    } else if (view.unseen.pixels()[i] == 0) {
      errors.rest.add(square);
    }
  }
  return errors;
}

RestorationErrors pooled(const std::vector<RestorationErrors>& units) {
  RestorationErrors sum;
  for (const RestorationErrors& unit : units) sum += unit;
  return sum;
}

std::optional<Interval> restored_over_rest(const std::vector<RestorationErrors>& units, std::uint64_t seed) {
  std::vector<RestorationErrors> restored;
  std::copy_if(units.begin(), units.end(), std::back_inserter(restored),
               [](const RestorationErrors& unit) { return unit.background.pixels > 0; });
  const auto has_no_error = [](const RestorationErrors& unit) { return unit.rest.squares <= 0; };
  if (restored.size() < 2 || std::any_of(restored.begin(), restored.end(), has_no_error)) return std::nullopt;
  return bootstrap_units(
      restored.size(),
      [&](std::span<const double> drawn) {
        RestorationErrors sum;
        for (const double i : drawn) sum += restored[static_cast<std::size_t>(i)];
        return sum.background.rms() / sum.rest.rms();
      },
      seed);
}

}  // namespace plenolab
