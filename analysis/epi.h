#pragma once

#include <span>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// Epipolar-plane images: the same row (horizontal camera motion) or column (vertical motion) of every frame
/// of a straight, evenly spaced camera motion, stacked. A point of disparity d (pixels per column spacing)
/// leaves a straight line of slope −d·Δs pixels per frame, Δs being the camera step in column spacings
/// (vertical: Δt in row spacings, times b_v/b_h); kinks and breaks show inconsistencies (thesis of Altmeier,
/// section 4.4).
enum class EpiDirection { kRow, kColumn };

/// Row `line` (or column) of all frames. Horizontal: width of the frames × number of frames, frame 0 at the
/// top; vertical: number of frames × height, frame 0 at the left. Throws InputError for no frames, frames of
/// different sizes or a line outside of them.
SceneImage epi(std::span<const SceneImage> frames, EpiDirection direction, int line);
DisplayImage epi(std::span<const DisplayImage> frames, EpiDirection direction, int line);

/// Enlarges an EPI's frame axis by repeating each frame `factor` ≥ 1 times, for looking at it.
DisplayImage stretch_epi(const DisplayImage& image, EpiDirection direction, int factor);

/// Slope a point of `disparity_px` must have: −disparity·step (times vertical_ratio = b_v/b_h for columns).
double expected_epi_slope(double disparity_px, double step_in_spacings, double vertical_ratio = 1);

/// A line drawn onto an EPI: in the middle of frame `frame` it stands at `position_px` along the row or
/// column (image coordinates: the first pixel's centre is at 0.5).
struct EpiLine {
  double position_px = 0, frame = 0, slope_px_per_frame = 0;
  Rgb colour{0, 1, 1};
};

/// The EPI with lines drawn over it, one pixel wide.
DisplayImage draw_epi_lines(DisplayImage image, EpiDirection direction, std::span<const EpiLine> lines);

}  // namespace plenolab
