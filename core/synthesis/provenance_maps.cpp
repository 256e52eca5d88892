#include "core/synthesis/provenance_maps.h"

#include <algorithm>

namespace plenolab {

float shown_disparity(const PixelProvenance& pixel) {
  float sum = 0;
  for (const Correspondence& c : pixel) sum += c.weight * c.disparity_px;
  return sum;
}

DisparityMap shown_disparity(const Plane<PixelProvenance>& provenance) {
  DisparityMap map(provenance.width(), provenance.height());
  std::transform(provenance.pixels().begin(), provenance.pixels().end(), map.pixels().begin(),
                 [](const PixelProvenance& pixel) { return shown_disparity(pixel); });
  return map;
}

Plane<std::uint8_t> contributing_views(const Plane<PixelProvenance>& provenance) {
  Plane<std::uint8_t> sets(provenance.width(), provenance.height());
  std::transform(provenance.pixels().begin(), provenance.pixels().end(), sets.pixels().begin(),
                 [](const PixelProvenance& pixel) {
                   unsigned set = 0;
                   for (std::size_t v = 0; v < pixel.size(); ++v)
                     if (pixel[v].state == CorrespondenceState::kUsed && pixel[v].weight > 0) set |= 1u << v;
                   return static_cast<std::uint8_t>(set);
                 });
  return sets;
}

}  // namespace plenolab
