#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/display/subimages.h"
#include "core/image/image.h"

namespace plenolab {

/// Pixel reprojection for a light-field display (Hansen & Klein 2016, section 3.2; Hansen, Klein & Kraus):
/// the views of an array of parallel cameras from those of its four corners.

/// The cameras behind a light-field image: one per subimage, parallel, square frusta.
struct CameraArray {
  SubimageLayout layout;
  double spacing_m = 0.001;  ///< between neighbouring cameras, across and down
  double fov_deg = 19.86;    ///< full opening angle, across and down

  /// Disparity in px per camera of planar depth z: size·spacing / (2·z·tan(fov/2)); 0 for ∞.
  double disparity_px(double depth_m) const;
  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

/// A rendered camera: what it sees, one sample at the centre of each pixel (no anti-aliasing, which would mix
/// depths), encoded.
struct RenderedCamera {
  int column = 0, row = 0;  ///< place in the array, from 0
  DisplayImage colour;
  Plane<float> depth_m;  ///< planar, ∞ for nothing; pixels with NaN or depth ≤ 0 match nothing
};

enum class ReprojectionMethod {
  kTwoStep,  ///< the top and bottom row from their two corners, then every column from those two rows
  kOneStep,  ///< every camera straight from all corners, along slanted epipolar lines
};

/// What pixels get that no corner camera sees.
enum class HoleFill {
  kMean,        ///< mean of the corner cameras' pixels at the same position (the thesis)
  kEdge,        ///< the nearest filled pixel of the row, repeated: streaks (figure 3.8)
  kBackground,  ///< of the two filled pixels beside the hole in its row the farther one
  kNearest,     ///< the nearest filled pixel of the subimage
  kBlack,       ///< 0 (appendix E)
};

struct ReprojectionOptions {
  ReprojectionMethod method = ReprojectionMethod::kTwoStep;
  HoleFill holes = HoleFill::kMean;
  bool record_maps = false;  ///< fill ReprojectionResult::disparity_px and offset_px
  int threads = 0;           ///< 0 = all cores, no influence on the result
};

struct ReprojectionResult {
  DisplayImage light_field;         ///< all subimages, the rendered ones as they were
  std::int64_t pixels = 0;          ///< of reprojected subimages
  std::int64_t holes = 0;           ///< of them, seen by no rendered camera
  std::int64_t ignored_pixels = 0;  ///< of rendered cameras, with no usable depth or colour
  double seconds = 0;
  /// With record_maps, of the size of light_field: disparity (px per camera) of the pixel taken, −1 in holes;
  /// and the larger of |x| and |y| of the distance (px) between where that pixel lands and the centre of the
  /// pixel it is taken for, before colour is corrected for it.
  Plane<float> disparity_px, offset_px;
};

/// Positions of the corner cameras: 4, or fewer in arrays of one row or column.
std::vector<std::array<int, 2>> corner_positions(const SubimageLayout& layout);
/// Position of the fifth camera, the thesis' centre: column ⌊columns / 2⌋, row ⌊(rows − 1) / 2⌋.
std::array<int, 2> central_position(const SubimageLayout& layout);

/// The light field of an array from rendered cameras: all its corners, and any others (a fifth, central one).
///
/// A pixel of a rendered camera belongs to the one target pixel whose centre is at most half a pixel from
/// where it reprojects to, on both axes. Of all pixels along the epipolar lines of all source cameras that
/// belong to a target pixel, the nearest is taken (largest disparity; then the camera given first; then the
/// first in reading order). Its colour is interpolated (linearly, within its camera's image) at the point
/// that reprojects to the pixel's centre; depth is not interpolated.
///
/// Epipolar lines are walked pixel by pixel along the axis on which the cameras are farther apart, with the
/// nearest pixel on the other and its two neighbours, up to the largest disparity of the rendered cameras:
/// all pixels that can belong to the target pixel. In two steps, both cameras of a row are sources of its
/// subimages, then the top and bottom subimage of a column of those between them; holes of the first step are
/// filled, but match nothing in the second. Cameras that are not corners are sources of every subimage in
/// either method.
///
/// Pixels with non-finite colour are set to black and match nothing. Throws InputError if a corner is
/// missing, a position is outside the array or given twice, or an image has another size than the layout.
///
/// `buffer`: a light field that is no longer needed; its memory is written over if it has the size of the new
/// one. Frames after the first are faster with it: no fresh memory has to be cleared.
ReprojectionResult reproject(const CameraArray& array, std::span<const RenderedCamera> cameras,
                             const ReprojectionOptions& options = {}, DisplayImage buffer = {});

/// The same by testing every pixel of every epipolar line of every target pixel, as the thesis' shader does:
/// slow, the reference that reproject() equals bit by bit.
ReprojectionResult reproject_literally(const CameraArray& array, std::span<const RenderedCamera> cameras,
                                       const ReprojectionOptions& options = {});

}  // namespace plenolab
