#include "core/synthesis/visibility_map.h"

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"

namespace plenolab {
namespace {

constexpr float kDarkest = 0.6f;  ///< hues stay apart on black, and the scene still shows through

/// Red for 0, green for 1, over yellow.
Rgb hue_of(float share) {
  return {std::min(1.0f, 2 - 2 * share), std::min(1.0f, 2 * share), 0};
}

template <class Referral>
DisplayImage colour_map(const NovelView<Referral>& view, const DisplayImage& shown) {
  DisplayImage map(shown.width(), shown.height());
  const float all = static_cast<float>(std::max<std::size_t>(view.views.size(), 1));
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const Rgb hue = hue_of(static_cast<float>(view.visible_views.at(x, y)) / all);
      const float luma = std::clamp(luminance(shown.at(x, y)), 0.0f, 1.0f);
      map.at(x, y) = view.unseen.at(x, y) != 0 ? hue_of(0) : hue * (kDarkest + (1 - kDarkest) * luma);
    }
  return map;
}

}  // namespace

DisplayImage visibility_map(const NovelView<SceneReferred>& view) {
  return colour_map(view, expose(view.image, exposure_from(view.image)));
}

DisplayImage visibility_map(const NovelView<DisplayReferred>& view) {
  return colour_map(view, view.image);
}

}  // namespace plenolab
