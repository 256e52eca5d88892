#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduce/figure_tools.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// Frames of the figures' epipolar images.
inline constexpr int kEpiFrames = 41;

/// The same row of frames of a horizontal camera motion, synthesised and true, frame 0 at the top.
struct EpiPair {
  std::vector<CameraPosition> positions;
  SceneImage truth, synthesised;
  int row = 0;
  int frame = 0;    ///< nearest to the position of the figure's view
  double at_s = 0;  ///< position of the figure's view
};

/// Two spacings around `at`, moved inwards where the grid ends (all of a grid that is not wider), in
/// kEpiFrames frames: a frame lies on each column of key views if `at` is a multiple of 1/20. Of the true
/// views only the row is rendered.
EpiPair record_epi(Laboratory& laboratory, const std::string& scene, CameraPosition at, int row);

/// What an epipolar image says about the part of the row that is enlarged.
struct EpiNumbers {
  double psnr_db = 0;  ///< all frames, columns of the box
  /// RMS difference of encoded luma smoothed over 5 columns, over the frames within a tenth of the spacing
  /// from the columns of key views to either side of the figure's view.
  double rms_at_keys = 0;
  double rms_between = 0;  ///< the same around the middle between these columns
  /// The same of the frames at key views exactly, which is noise; only if the motion passes through key
  /// views.
  std::optional<double> rms_noise;
  std::optional<double> rms_between_without_noise;  ///< see without_noise
};

/// An effect fades towards key views if the RMS error midway between them is more than this many times that
/// at them, i.e. the squared error more than doubles. The blend averages noise, which does not grow.
inline constexpr double kFadingRatio = 1.5;

bool fades(const EpiNumbers& epi);

/// "…is 0.03 (encoded RMS) at key views and 0.11 midway between them, 3.4 times as much…", with the part that
/// noise does not explain where it is known.
std::string fading_text(const EpiNumbers& epi);

/// RMS error midway between two key views of a row without the noise of key views and truth, at least 0. A
/// frame at a key view shows that key view exactly, so its error is noise only and tells how much there is:
/// let v be the variance of a key view and n = kTruthPathFactor. The truth continues the paths of the key
/// view n-fold, so that its noise is v/n and differs from the key view's by v − v/n. Midway the blend of two
/// views has v/2 and the truth, with paths of its own, v/n. Interpolation inside key views lowers the noise
/// further: what remains is a lower bound.
double without_noise(double rms_between, double rms_noise);

/// The numbers of the columns of a box.
EpiNumbers measure_epi(const EpiPair& epi, const PixelBox& box, float exposure);

/// Adds the epipolar images (truth, synthesis, difference; the frame of the view marked green, what is
/// enlarged red), the columns of the box enlarged, and the error of these columns over the camera position
/// as a plot. A line over the enlarged images shows the slope expected of a surface of `disparity_px` through
/// the middle of the box in the frame of the view. Rows: epi_psnr_gamma_db, epi_rms_at_keys, epi_rms_between
/// and, if known, epi_rms_noise and epi_rms_between_without_noise with the columns given.
EpiNumbers add_epi(ReproductionResult& result, const EpiPair& epi, const PixelBox& box, float exposure,
                   double disparity_px, const std::string& what, const Columns& columns);

}  // namespace plenolab
