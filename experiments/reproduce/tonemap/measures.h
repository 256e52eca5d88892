#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/statistics.h"
#include "experiments/reproduce/tonemap/mappings.h"

namespace plenolab {

/// What the claims on consistency measure beside metrics/consistency.h.

/// The smallest step that a display of 8 bits can show. Differences below it are called invisible.
inline constexpr double kSmallestStep = 1.0 / 255;

/// Pairs of neighbouring key views.
enum class Neighbours { kAcross, kDown, kBoth };

/// A pair of key views and what mapping adds to the luma of surfaces that both show under the same light.
struct PairChange {
  int column = 0, row = 0;  ///< of the first
  bool down = false;        ///< the second lies below, else to the right
  LineChange change;
  double log_peak_step = 0;  ///< of the largest HDR luminance, second over first, log10
};

/// All pairs `distance` key views apart, row by row; across before down. Pairs of which less than a twentieth
/// of the pixels takes part are left out.
std::vector<PairChange> pair_changes(const LightField& hdr, const DisplayLightField& mapped,
                                     Neighbours neighbours, int threads, int distance = 1);

/// |mean change| of each pair.
std::vector<double> brightness_changes(std::span<const PairChange> pairs);
/// RMS change of each pair.
std::vector<double> rms_changes(std::span<const PairChange> pairs);

/// Luma of an image less that of another of the same size.
Plane<float> luma_difference(const DisplayImage& image, const DisplayImage& other);

/// Steps of a plane across borders of visibility of a frame: differences of neighbouring pixels of one
/// surface (disparities within 0.25 px) that different key views see. Unit of the plane, ≥ 0; 0 without such
/// pixels.
struct BorderStep {
  double rms = 0;      ///< in quadrature beyond that of pixels seen by the same key views
  double largest = 0;  ///< of all; noise counts
};
BorderStep border_step(const Plane<float>& values, const ReferenceFrame& frame);

/// Squares of these steps, each at the left or upper pixel of its pair; 0 elsewhere. To find the part of a
/// view where they show most.
Plane<float> border_step_weights(const Plane<float>& values, const ReferenceFrame& frame);

/// How far a mapped frame is from a reference mapping at the same place of the pipeline, which treats all key
/// views alike. Of the difference in luma, what the reference's luma alone explains (its mean over pixels of
/// the same 64th of the range) is taken out: another curve is no inconsistency.
struct FrameInconsistency {
  /// Step of the rest across borders of visibility: RMS difference of neighbouring pixels of one surface
  /// (disparities within 0.25 px) seen by different key views, in quadrature beyond that of pixels seen by
  /// the same ones; luma, ≥ 0.
  double border_step = 0;
  /// Mean of the rest in the border region of the image (a tenth of width and height on each side) less that
  /// elsewhere, luma, signed.
  double border_region = 0;
};

/// Of HDR frames at some positions, in order. Mapping and reference stand at the same place.
std::vector<FrameInconsistency> frame_inconsistencies(MappingBench& bench, const std::string& scene,
                                                      const Mapping& mapping, const Mapping& reference,
                                                      std::span<const ReferenceFrame> frames);

/// The mapping with the variant of its operator that has one fit for all views, without key-view adjustment.
/// As the reference of a variant for frames it maps frames.
Mapping with_one_fit(const Mapping& mapping);

/// A variant for views or light fields applied to the frames themselves.
std::vector<DisplayImage> frames_mapped_alike(MappingBench& bench, const std::string& scene,
                                              const Mapping& mapping, std::span<const ReferenceFrame> frames);

/// One of the numbers of each.
std::vector<double> border_steps(std::span<const FrameInconsistency> frames);
std::vector<double> border_regions(std::span<const FrameInconsistency> frames);  ///< absolute

/// Ratio of the means of two equally long series whose values belong together pairwise, with its 95 %
/// bootstrap interval over pairs; nothing for fewer than two pairs or a denominator of 0.
std::optional<Interval> mean_ratio(std::span<const double> numerator, std::span<const double> denominator,
                                   std::uint64_t seed, int block_length = 1);

/// The number of decades by which the largest luminance of two views must differ for a light source to have
/// appeared or gone: highlights differ by less.
inline constexpr double kLightSourceStep_log10 = 2;

}  // namespace plenolab
