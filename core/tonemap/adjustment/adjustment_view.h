#pragma once

#include <span>

#include "core/image/image.h"
#include "core/lightfield/light_field.h"
#include "core/tonemap/adjustment/key_view_adjustment.h"

namespace plenolab {

/// Below this luma a factor would be noise; such pixels have factor 1.
inline constexpr float kDarkestLuma = 1.0f / 1024;

/// What the adjustment reads of a key view, all of one size.
struct AdjustmentView {
  Plane<float> log_luminance;  ///< log10 of HDR luminance, floored
  Plane<float> luma;           ///< of the tone mapped view, in [0, 1]
  DisparityMap disparity;
};

/// Throws InputError unless both light fields have the same grid of views and the same image size.
void require_same_grid(const LightField& hdr, const DisplayLightField& tone_mapped);

/// Smallest positive luminance of all views; 1 if there is none.
float smallest_luminance(const LightField& hdr, int threads);

/// Reads a view of both light fields. Repairs and floored pixels are added to `counts`.
AdjustmentView read_adjustment_view(const LightField& hdr, const DisplayLightField& tone_mapped, int column,
                                    int row, float floor, int threads, KeyViewAdjustmentCounts& counts);

/// A tone mapped channel value in [0, 1]: NaN becomes 0, others the nearest value.
float display_value(float v);

/// r, g and b times the factor of each pixel, cut at 1.
DisplayImage apply_factors(const DisplayImage& view, const Plane<float>& factors,
                           KeyViewAdjustmentCounts& counts);

/// The second filter.
Plane<float> smooth_factors(const Plane<float>& factors, const AdjustmentView& view,
                            const KeyViewAdjustmentOptions& options, bool exact, int threads);

/// Where the pixels of one view appear in another: q = p + step·disp(p), nearest pixel.
struct ViewStep {
  float x = 0, y = 0;  ///< (F_p − F_q) in columns and in rows times the vertical ratio
};
ViewStep step_between(const ViewGrid& grid, int from_column, int from_row, int to_column, int to_row);

}  // namespace plenolab
