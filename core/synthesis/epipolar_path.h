#pragma once

#include <cstdint>
#include <vector>

#include "core/lightfield/view_grid.h"
#include "core/synthesis/novel_view.h"
#include "core/synthesis/options.h"

namespace plenolab {

/// One position on the search path relative to the pixel: A = p + (ox + fx, oy + fy) for every pixel p of the
/// novel view, because all pixels share the baseline. `d` is the search variable there.
struct PathSample {
  float d = 0;
  int ox = 0, oy = 0;    ///< whole pixels
  float fx = 0, fy = 0;  ///< in [0, 1)
  float dx = 0, dy = 0;  ///< way from the previous sample of the same table
};

/// Sub-samples of a step in the second pass.
inline constexpr int kSubSamples = 8;

/// A counts as inside the image up to this far (px) beyond the outermost pixel centres, so that a path that
/// moves by less over its whole length (|b| → 0) does not lose the outermost pixels to rounding.
inline constexpr double kInsideTolerance_px = 1e-6;

/// Larger disparities are refused: nothing a light field could mean, and float would not hold sub-pixel
/// steps.
inline constexpr double kMaxDisparity_px = 1e9;

/// Nearest fixed screen, as the disparity of its plane.
inline constexpr double kMaxScreenDisparity_px = 1e5;

/// Where the paths of one column (or row) of the novel view run inside the key view along that axis.
struct AxisClip {
  double near = 0, far = 0;  ///< interval of d, within [0, start]; empty if near > far
  PathSample entry;          ///< at d = far, if that is below start: there the path enters through the border
  int first = 0;             ///< index of the first tabulated sample with d_k < far
};

/// The path A(d) = B + (b_x, b_y·b_v/b_h)·d of one key view (section 4.1.3) and its samples, shared by all
/// pixels: d_k = d_max + (1 − k)·Δ for k = 0, 1, … while positive, then exactly 0, with Δ = step_px / |(b_x,
/// b_y·b_v/b_h)|. Only samples at which some pixel of the novel view is inside the key view are tabulated,
/// from k = `first` on.
struct EpipolarPath {
  int width = 0, height = 0;
  double vx = 0, vy = 0;  ///< A moves by this many pixels per pixel of disparity
  double sx = 0, sy = 0;  ///< B − p: 0 for the shifted frustum, (I₀ − I)·d_s for the fixed screen
  double d_max = 0, step = 0, start = 0;  ///< start = d_max + step
  std::int64_t first = 0;
  std::vector<PathSample> samples;  ///< of k = first + index; the last one is d = 0
  std::vector<PathSample>
      sub_samples;  ///< kSubSamples + 1 for each of `samples`: from d_(k−1) to d_k, both included
  std::vector<AxisClip> columns, rows;  ///< of the novel view; empty where no search takes place

  bool is_key_view() const { return vx == 0 && vy == 0; }
  int last() const { return static_cast<int>(samples.size()) - 1; }
  /// d_k of the tabulated sample `index`, in full precision; also valid for index −1.
  double disparity(int index) const;
  /// The position for an arbitrary d.
  PathSample at(double d) const;
  /// Sub-sample 0 … kSubSamples between two values of d; the last one is exactly `d_to`.
  PathSample sub_sample(double d_from, double d_to, int sub) const;
};

/// The path of `view` for a novel view at `position`. For |b| = 0 it has the single sample d = 0. Throws
/// InputError if the fixed screen is nearer than kMaxScreenDisparity_px.
EpipolarPath make_path(const ViewGrid& grid, CameraPosition position, const UsedView& view, double d_max,
                       const SynthesisOptions& options);

/// The part of a pixel's path inside the key view's image, as an interval of d. `entered` tells whether the
/// path, coming from d = start, enters through the image border at d = far.
struct ClippedPath {
  double near = 0, far = 0;
  bool inside = false, entered = false;
};

/// Clips the path of pixel (x, y) analytically to [0.5, w − 0.5] × [0.5, h − 0.5].
ClippedPath clip_path(const EpipolarPath& path, int x, int y);

}  // namespace plenolab
