#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image/image.h"

/// Consistency of tone mapped views: how much of the differences that a viewer sees, within one view and from
/// one view to the next, comes from tone mapping and not from the light (thesis of Altmeier, sections 5.1 to
/// 5.3, judges this by eye on epipolar images; the measures are ours). Every measure is taken relative to the
/// HDR view at the same place.
///
/// Luma is the luminance-weighted sum of the encoded channels, in [0, 1]. Log luminance is log10 of HDR
/// luminance, in any unit. Pixels whose HDR luminance is not positive and finite take no part.
namespace plenolab {

/// A tone mapped view, the HDR view at the same position, and the disparity of what both show. All of one
/// size; held only during a call. Disparity in pixels per spacing, finite and ≥ 0.
struct ConsistencyView {
  const DisplayImage& mapped;
  const SceneImage& hdr;
  const DisparityMap& disparity_px;
};

struct ConsistencyOptions {
  /// Disparities up to this apart belong to one surface, pixels, > 0.
  double same_surface_px = 0.25;
  /// Changes of HDR luminance up to this count as none, log10 units, > 0.
  double same_light_log10 = 0.02;
  int threads = 0;

  /// Throws InputError with one sentence that names the value out of range.
  void validate() const;
};

/// Camera motion from one view to another, F_to − F_from, in column spacings; rows times b_v/b_h. Views onto
/// a fixed screen shift with the camera: a point on the screen, of disparity `screen_px`, stays where it is.
struct ViewMotion {
  double x = 0, y = 0;
  double screen_px = 0;  ///< 0 for cameras that look straight ahead
};

/// Changes of luma along epipolar lines from one view to the next, over the pixels whose surface both views
/// show under the same light. One curve for both views leaves what sampling makes, and the slope of the curve
/// times changes of light too small to count.
struct LineChange {
  std::int64_t pixels = 0;  ///< that took part
  double mean = 0;          ///< signed: the view as a whole turns brighter (> 0) or darker
  double rms = 0;
  double share = 0;  ///< pixels that took part, of those of the view
};

/// A pixel p of `from` is found in `to` at q = p − motion·(disp(p) − screen), bilinearly; it takes part if q
/// lies inside, disparities there agree within same_surface_px and HDR luminances within same_light_log10.
/// Bit-identical for any number of threads. Throws InputError for views of different sizes.
LineChange change_along_lines(const ConsistencyView& from, const ConsistencyView& to,
                              const ViewMotion& motion, const ConsistencyOptions& options = {});

/// The single changes behind change_along_lines, at the pixels of `from`; NaN where a pixel takes no part.
Plane<float> change_map_along_lines(const ConsistencyView& from, const ConsistencyView& to,
                                    const ViewMotion& motion, const ConsistencyOptions& options = {});

/// Mean absolute differences of neighbouring pixels of one surface, across visibility borders and elsewhere.
struct BorderChange {
  std::int64_t border_pairs = 0, inside_pairs = 0;
  double luma_border = 0, luma_inside = 0;  ///< of the tone mapped view
  double log_border = 0, log_inside = 0;    ///< of log luminance

  /// (luma_border / luma_inside) / (log_border / log_inside): 1 where borders of visibility show in the
  /// tone mapped view as much as in the HDR view, above where mapping adds to them. Nothing without pairs of
  /// both kinds or where one of the means it divides by is 0.
  std::optional<double> excess() const;
};

/// Pairs of pixels beside or above each other whose disparities agree within same_surface_px. They lie across
/// a border of visibility where `contributors` (one bit for each key view that contributes to a pixel)
/// differ; pixels without contributors take no part.
BorderChange change_across_borders(const ConsistencyView& view, const Plane<std::uint8_t>& contributors,
                                   const ConsistencyOptions& options = {});

/// Mean luma over a camera motion beside the mean log luminance of the HDR views.
struct LumaTrack {
  std::vector<double> mean_luma;           ///< of each frame
  std::vector<double> mean_log_luminance;  ///< of each frame

  double largest_luma_step() const;  ///< between neighbouring frames, absolute; 0 for fewer than two
  double largest_log_step() const;
  /// Rank correlation (Spearman) of the two tracks: whether the mapped motion turns brighter where the light
  /// does. Changes below 1e-6 are ties. Nothing for fewer than three frames or where a track does not change.
  std::optional<double> agreement() const;
};

/// Mean of the luminance-weighted sum of the encoded channels, in [0, 1]. At least one pixel.
double mean_luma(const DisplayImage& image);

/// Adds a frame; one whose HDR view has no lit pixel is left out, as it has no log luminance.
void append_frame(LumaTrack& track, const DisplayImage& mapped, const SceneImage& hdr);

}  // namespace plenolab
