#pragma once

#include "core/luminance/ray_display.h"

namespace plenolab {

/// A display with a few observer positions, each of which sees pixels of its own (Doronin & Barsi,
/// section 6.1): view i of n is seen from the i-th of n equal cells of the observers' range and from there
/// only. The samples of such a display are its views: samples_of(display, views).
struct MultiViewDisplayOptions {
  DisplaySpace space{.x_min_m = -0.5, .x_max_m = 0.5};
  int views = 8;
  int width = 640, height = 360;  ///< pixels of an image
  /// false: one image for each view, e.g. from a captured light field. true: a single image on the panel in
  /// which the views take turns: pixel (u, v) belongs to view (u + v·shift_px_per_row) mod views, so that a
  /// view has width/views columns of its own.
  bool interleaved = false;
  int shift_px_per_row = 0;

  void validate() const;
};

class MultiViewDisplay : public RayDisplay {
 public:
  explicit MultiViewDisplay(const MultiViewDisplayOptions& options);

  RayCount size() const override;
  const DisplaySpace& space() const override { return options_.space; }
  ScreenPoint screen_point(const Ray& ray) const override;
  ObserverPosition position(const Ray& ray) const override;
  /// 1 within the cell of the view, else 0.
  double weight(const Ray& ray, ObserverPosition observer) const override;
  double reach_m() const override;
  /// One ray a view: its nearest pixel of the row.
  void rays_at(ScreenPoint point, std::vector<Ray>& rays) const override;
  PinholeSize resolution() const override;
  bool in_columns() const override { return !options_.interleaved || options_.shift_px_per_row == 0; }

  int view_of(const Ray& ray) const;

 private:
  int nearest_pixel_of(int view, double across, int v) const;
  MultiViewDisplayOptions options_;
  ObserverSamples cells_;
};

}  // namespace plenolab
