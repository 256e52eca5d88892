#pragma once

#include "core/luminance/ray_display.h"

namespace plenolab {

/// A panel behind lenses or a barrier (Doronin & Barsi, sections 6.2 and 6.3). All lenses send the same place
/// below them to the same observer position, as the slightly smaller pitch of real lens sheets does: a pixel
/// at the share f of the way across its lens is seen best from x_min + (1 − f)·(x_max − x_min), for lenses
/// turn pictures around.
struct LensArrayDisplayOptions {
  enum class Kind {
    kLenticular,       ///< upright cylinders: horizontal parallax; neighbouring pixels blend into each other
    kParallaxBarrier,  ///< upright slits: each observer position sees one pixel of a slit
    kFullParallax,     ///< lenses across and down: observers on a plane
  };
  Kind kind = Kind::kLenticular;
  DisplaySpace space{.x_min_m = -0.5, .x_max_m = 0.5};  ///< for kFullParallax y_min_m < y_max_m
  int width = 1280, height = 360;                       ///< pixels of the panel
  int lenses_across = 160, lenses_down = 1;             ///< lenses_down matters for kFullParallax only
  /// Lenses a cylinder or slit is shifted to the right by from the upper to the lower edge of the screen.
  double slant_lenses = 0;

  void validate() const;
};

/// Weight of a ray: for lenses the profile of core/luminance/projector_display.h whose width is the distance
/// between the positions of neighbouring pixels, for a barrier 1 within half that distance and 0 beyond.
class LensArrayDisplay : public RayDisplay {
 public:
  explicit LensArrayDisplay(const LensArrayDisplayOptions& options);

  RayCount size() const override { return {1, options_.width, options_.height}; }
  const DisplaySpace& space() const override { return options_.space; }
  /// The middle of the ray's lens; with upright lenses at the height of the pixel.
  ScreenPoint screen_point(const Ray& ray) const override;
  ObserverPosition position(const Ray& ray) const override;
  double weight(const Ray& ray, ObserverPosition observer) const override;
  double reach_m() const override;
  /// All pixels below the lens of the point; with upright lenses those of its row.
  void rays_at(ScreenPoint point, std::vector<Ray>& rays) const override;
  PinholeSize resolution() const override {
    return {options_.lenses_across, full_parallax() ? options_.lenses_down : options_.height};
  }
  bool in_columns() const override { return !full_parallax() && options_.slant_lenses == 0; }

 private:
  bool full_parallax() const { return options_.kind == LensArrayDisplayOptions::Kind::kFullParallax; }
  /// Across in lenses: whole part = number of the lens, fraction = share of the way across it.
  double phase(double across, double down) const;
  double profile(double t) const;

  LensArrayDisplayOptions options_;
  double spread_x_m_ = 0, spread_y_m_ = 0;
};

}  // namespace plenolab
