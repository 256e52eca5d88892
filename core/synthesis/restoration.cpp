#include "core/synthesis/patch_blend.h"

namespace plenolab {

Hit background_pixel(const PreparedView& prepared, const Hit& hit) {
  Hit lowest;
  float lowest_disparity = 0, lowest_weight = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner % 2, dy = corner / 2;
    const float weight = (dx == 1 ? hit.fx : 1 - hit.fx) * (dy == 1 ? hit.fy : 1 - hit.fy);
    if ((dx == 1 && hit.fx == 0) || (dy == 1 && hit.fy == 0)) continue;
    const float disparity = prepared.disparity_row(hit.j + dy)[hit.i + dx];
    const bool lower = !lowest.found() || disparity < lowest_disparity ||
                       (disparity == lowest_disparity && weight > lowest_weight);
    if (!lower) continue;
    lowest = {hit.i + dx, hit.j + dy, 0, 0};
    lowest_disparity = disparity;
    lowest_weight = weight;
  }
  return lowest;
}

}  // namespace plenolab
