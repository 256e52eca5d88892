#pragma once

#include "core/display/near_eye_optics.h"
#include "core/image/image.h"

namespace plenolab {

/// A light-field image: square subimages of equal size side by side, as a display behind an array of lenses
/// shows them. The subimage of column c and row r covers pixels [c·size, (c + 1)·size) × [r·size, (r +
/// 1)·size) and is upright; row 0 is the top one.
struct SubimageLayout {
  int columns = 15, rows = 8;
  int size_px = 162;

  int width() const { return columns * size_px; }
  int height() const { return rows * size_px; }
  /// Throws InputError for fewer than one subimage or pixel, or more than 2³¹ pixels along an axis.
  void validate() const;
  friend bool operator==(const SubimageLayout&, const SubimageLayout&) = default;
};

/// One subimage cut out. `column` and `row` count from 0: the thesis' centre [4, 8] is row 3, column 7.
DisplayImage subimage(const DisplayImage& light_field, const SubimageLayout& layout, int column, int row);

/// The subimages at half the size: each output pixel is the mean of 4 × 4 input pixels, 2i − 1 … 2i + 2 on
/// each axis, those beyond the border replaced by the border's (section 3.2.3). Neighbouring subimages never
/// mix. The size must be even. `threads`: 0 = all cores, no influence on the result.
DisplayImage halve_subimages(const DisplayImage& light_field, const SubimageLayout& layout, int threads = 0);

/// The light-field image as it is sent to the panel: subimages scaled to the pitch of the display, centred,
/// bilinear and clamped within each subimage; black around them. Throws InputError if the layout's numbers of
/// subimages are not the display's.
DisplayImage panel_image(const DisplayImage& light_field, const SubimageLayout& layout,
                         const NearEyeDisplay& display, int threads = 0);

}  // namespace plenolab
