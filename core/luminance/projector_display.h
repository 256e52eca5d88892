#pragma once

#include <vector>

#include "core/luminance/ray_display.h"

namespace plenolab {

/// Projectors behind a holographic diffuser: horizontal parallax only. The defaults are the HoloVizio 80WLT
/// of Doronin & Barsi (section 7.1: screen 645 × 360 mm, observers at 2 m over 10 m); the paper gives no
/// more, so number, place and images of the projectors and the diffuser are ours. Every projector fills the
/// screen.
struct ProjectorDisplayOptions {
  DisplaySpace space;
  double projector_distance_m = 0.5;  ///< D: projectors stand at z = −D
  int projectors = 96;                ///< K
  int width = 640, height = 360;      ///< pixels of a projector's image
  /// Places of the projectors on their line: equally far apart, or at equal angles from the middle of the
  /// screen (a denser middle; then ΔX grows towards the ends).
  enum class Layout { kLine, kArc } layout = Layout::kLine;

  void validate() const;
  /// Half the length of the projectors' line, P = (W/2)(1 + D/Z) + R·D/Z: every observer in ±R then sees
  /// light at every point of the screen.
  double half_line_m() const;
};

/// The display's sizes by name.
enum class DisplayPreset {
  kQuick,  ///< 24 projectors of 160 × 90 pixels
  kSmall,  ///< 96 of 160 × 90: blurs depth as the full display does, with fewer pixels
  kFull,   ///< 96 of 640 × 360
  kPaper,  ///< 96 of 1280 × 720
};
ProjectorDisplayOptions projector_display_options(DisplayPreset preset);

/// A ray of projector k through the point s of the screen contributes most at X = s + (s − p_k)·Z/D. The
/// diffuser spreads it fully along y and along x with the weight exp(−4 ln2·((x − X)/ΔX)²), 0 beyond 1.5 ΔX,
/// where ΔX is the distance between the X of neighbouring projectors (for Layout::kArc their mean distance on
/// both sides): its width at half maximum. With a single projector ΔX is the whole line, 2P·Z/D.
class ProjectorDisplay : public RayDisplay {
 public:
  explicit ProjectorDisplay(const ProjectorDisplayOptions& options);

  RayCount size() const override;
  const DisplaySpace& space() const override { return options_.space; }
  ScreenPoint screen_point(const Ray& ray) const override;
  ObserverPosition position(const Ray& ray) const override;
  double weight(const Ray& ray, ObserverPosition observer) const override;
  double reach_m() const override { return reach_m_; }
  void rays_at(ScreenPoint point, std::vector<Ray>& rays) const override;
  PinholeSize resolution() const override { return {options_.width, options_.height}; }
  bool in_columns() const override { return true; }

  const ProjectorDisplayOptions& options() const { return options_; }
  /// p_k, from left to right as observers see it.
  double projector_x_m(int k) const { return projector_x_m_[static_cast<std::size_t>(k)]; }
  /// ΔX of a projector.
  double spread_m(int k) const { return spread_m_[static_cast<std::size_t>(k)]; }

 private:
  ProjectorDisplayOptions options_;
  std::vector<double> projector_x_m_, spread_m_;
  double reach_m_ = 0;
};

/// The profile of the diffuser, exp(−4 ln2·t²) for |t| ≤ 1.5, else 0; t in widths at half maximum.
double diffuser_profile(double t);

}  // namespace plenolab
