#pragma once

#include <cstddef>
#include <vector>

namespace plenolab {

/// Displays that show light fields, through one interface: every pixel of the images that a display is fed
/// with is a ray, which leaves the screen at one place and contributes most at one position of the observers
/// (Doronin & Barsi, sections 3 and 6). Lengths in metres; the screen is the plane z = 0, centred, x to the
/// right, y up, observers on the side of positive z.

/// The images of a display: `images` of width × height pixels.
struct RayCount {
  int images = 1, width = 1, height = 1;
  std::size_t total() const {
    return static_cast<std::size_t>(images) * static_cast<std::size_t>(width) *
           static_cast<std::size_t>(height);
  }
  friend bool operator==(const RayCount&, const RayCount&) = default;
};

/// Pixel (u, v) of an image, u from the left, v from the top.
struct Ray {
  int image = 0, u = 0, v = 0;
  friend bool operator==(const Ray&, const Ray&) = default;
};

/// A place an observer may stand at: on a line parallel to the screen (y = 0), or on a plane for displays
/// with full parallax.
struct ObserverPosition {
  double x_m = 0, y_m = 0;
};

/// A point of the screen, from its left and upper edge, as shares of its width and height in [0, 1].
struct ScreenPoint {
  double across = 0.5, down = 0.5;
};

/// Pixels of the picture of an observer: a pinhole camera that stands at the observer's position, looks
/// perpendicularly to the screen and whose picture is exactly the screen (section 3).
struct PinholeSize {
  int width = 256, height = 144;
  /// Throws InputError unless both are in [1, 16384].
  void validate() const;
  /// Middle of pixel (a, b) on the screen.
  ScreenPoint middle(int a, int b) const { return {(a + 0.5) / width, (b + 0.5) / height}; }
  friend bool operator==(const PinholeSize&, const PinholeSize&) = default;
};

/// Screen and observers in space.
struct DisplaySpace {
  double width_m = 0.645, height_m = 0.360;  ///< of the screen
  double observer_distance_m = 2;            ///< of the observers' line or plane from the screen
  double x_min_m = -5, x_max_m = 5;          ///< where observers stand
  double y_min_m = 0, y_max_m = 0;           ///< equal: observers on a line

  /// Throws InputError that names the first value out of range.
  void validate() const;
  bool on_a_plane() const { return y_max_m > y_min_m; }
};

/// A display: which observer position and weight each of its pixels has. Implementations do not change once
/// made and may be used from many threads.
class RayDisplay {
 public:
  virtual ~RayDisplay() = default;

  virtual RayCount size() const = 0;
  virtual const DisplaySpace& space() const = 0;
  /// Where the ray leaves the screen.
  virtual ScreenPoint screen_point(const Ray& ray) const = 0;
  /// X(ray): where the ray contributes most. May lie outside the range of observers.
  virtual ObserverPosition position(const Ray& ray) const = 0;
  /// Share of the ray's light that reaches an observer, relative to one at position(ray): in [0, 1].
  virtual double weight(const Ray& ray, ObserverPosition observer) const = 0;
  /// No observer farther than this from position(ray), along either axis, gets anything.
  virtual double reach_m() const = 0;
  /// Appends the rays that light a point of the screen, for observers anywhere.
  virtual void rays_at(ScreenPoint point, std::vector<Ray>& rays) const = 0;
  /// Pixels of the finest picture that the display can show to an observer: finer pinhole images only repeat
  /// them.
  virtual PinholeSize resolution() const = 0;
  /// Whether columns are all there is: position and weight do not depend on v, and the rays of a point are
  /// columns chosen by `across`, at v = floor(down·height). True for displays with horizontal parallax only
  /// and upright columns. The methods are much faster for these.
  virtual bool in_columns() const = 0;
};

/// Positions at which the luminance is estimated: the centres of equal cells that cover the range of the
/// observers without a gap (the "non-overlapping regions" of section 6.2). rows = 1 on a line.
struct ObserverSamples {
  int columns = 1000, rows = 1;
  double x_min_m = -5, x_max_m = 5, y_min_m = 0, y_max_m = 0;

  /// Throws InputError that names the first value out of range.
  void validate() const;
  int size() const { return columns * rows; }
  double step_x_m() const { return (x_max_m - x_min_m) / columns; }
  double step_y_m() const { return (y_max_m - y_min_m) / rows; }
  /// Sample number row·columns + column.
  ObserverPosition position(int sample) const;
  /// The sample whose cell holds the position, both ends of the range included; −1 outside.
  int nearest(ObserverPosition position) const;
};

/// `columns` samples over the range of a display's observers; on a plane also `rows` (0: as many as columns).
ObserverSamples samples_of(const RayDisplay& display, int columns, int rows = 0);

}  // namespace plenolab
