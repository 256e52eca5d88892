#pragma once

#include "core/luminance/projector_display.h"

namespace plenolab {

/// A projector display behind another diffuser: its profile `factor` times as wide as the distance ΔX between
/// the observer positions of neighbouring projectors. 1 is the display itself; from 1/3 on, every place is
/// reached by some projector, and just above that by little more than one. For estimates with a spread that
/// is not the diffuser's. The display must outlive it.
class WidenedDisplay : public RayDisplay {
 public:
  /// Throws InputError unless factor is in [1/3, 100].
  WidenedDisplay(const ProjectorDisplay& display, double factor);

  RayCount size() const override { return display_.size(); }
  const DisplaySpace& space() const override { return display_.space(); }
  ScreenPoint screen_point(const Ray& ray) const override { return display_.screen_point(ray); }
  ObserverPosition position(const Ray& ray) const override { return display_.position(ray); }
  double weight(const Ray& ray, ObserverPosition observer) const override;
  double reach_m() const override { return factor_ * display_.reach_m(); }
  void rays_at(ScreenPoint point, std::vector<Ray>& rays) const override { display_.rays_at(point, rays); }
  PinholeSize resolution() const override { return display_.resolution(); }
  bool in_columns() const override { return true; }

 private:
  const ProjectorDisplay& display_;
  double factor_;
};

}  // namespace plenolab
