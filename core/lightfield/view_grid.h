#pragma once

namespace plenolab {

/// A point (s, t) on the camera plane in units of the column and row spacing: s to the right, t down, the
/// top-left key view at (0, 0).
struct CameraPosition {
  double s = 0, t = 0;
  friend bool operator==(const CameraPosition&, const CameraPosition&) = default;
};

/// The regular grid of parallel pinhole cameras of a light field, and the images they record: same
/// resolution, same opening angles, square pixels, principal point at the image centre (thesis of Altmeier,
/// sections 3.1 and 4.1).
struct ViewGrid {
  int columns = 1, rows = 1;                ///< key views; row 0 is the top row, column 0 the left one
  double spacing_x_m = 1, spacing_y_m = 1;  ///< between neighbouring focal points, > 0
  int width = 1, height = 1;                ///< pixels
  double fov_h_deg = 60;                    ///< full horizontal opening angle, in (0, 180)

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;

  /// Vertical over horizontal spacing: scales disparity for vertical displacements.
  double vertical_ratio() const { return spacing_y_m / spacing_x_m; }

  /// Disparity in pixels per column spacing of planar depth z > 0 (∞ gives 0): w·b / (2·z·tan(fov_h/2)).
  double disparity_px(double depth_m) const;

  /// Inverse of disparity_px: depth in metres, ∞ for disparity 0.
  double depth_m(double disparity_px) const;

  /// Whether a camera position lies on the grid, borders included.
  bool contains(CameraPosition position) const;

  friend bool operator==(const ViewGrid&, const ViewGrid&) = default;
};

}  // namespace plenolab
