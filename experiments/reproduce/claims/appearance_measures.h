#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "experiments/reproduce/claims/appearance_probes.h"
#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/laboratory.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// What the claims on appearance measure. All images are gamma-encoded at a fixed exposure, clamped to
/// [0, 1], so errors are shares of the display range.

/// RMS errors and steps below this share of the display range are too small to call a surface wrongly
/// reproduced: five grey levels of 256. Stricter than the threshold above which single pixels count as
/// differing in comparisons of images (ComparisonConditions), because it is held against means.
inline constexpr double kSmallError = 0.02;

/// A scene, four key views of it and the positions between them to look at.
struct Probe {
  Scene scene;
  ViewGrid grid;
  float exposure = 1;
  int paths_per_pixel = 16;  ///< of each of two renderings with independent noise
  std::vector<CameraPosition> positions;
};

/// 2 × 2 key views of 192 × 108 px (a third of it in a tiny run).
ViewGrid appearance_grid(const Laboratory& laboratory, double spacing_m);

/// A synthesised view S and its ground truth T, both twice (1, 2) with independent path tracing noise.
struct TwinView {
  CameraPosition position;
  std::array<DisplayImage, 2> synthesised, truth;
  std::array<SceneImage, 2> synthesised_radiance, truth_radiance;
  DisparityMap disparity;     ///< of the truth
  Plane<std::uint8_t> views;  ///< which key views contribute, one bit each
  Mask valid;                 ///< 1 where all four key views contribute
};

std::vector<TwinView> render_twins(Laboratory& laboratory, const Probe& probe);

/// Key views whose colour is interpolated at each pixel, one bit each; `weightless`: also those whose weight
/// is 0.
Plane<std::uint8_t> contributing_views(const NovelView<SceneReferred>& novel, bool weightless);

/// Squared errors of rectangles of the image, one value each.
struct TileErrors {
  std::vector<int> tile;  ///< which rectangle of which view, for pairing; increasing
  /// Mean of (S₁ − T₁)(S₂ − T₂): the squared error of the synthesis without noise, because the noises of the
  /// two factors are independent. May be slightly negative where there is no error.
  std::vector<double> error;
  /// Mean of (T₁ − T₂)² / 2: variance of the noise of one truth.
  std::vector<double> noise;
};

/// Errors of 6 × 4 tiles of every view over the pixels that all four key views see; tiles with less than half
/// of those are left out.
inline constexpr int kTilesX = 6, kTilesY = 4;
TileErrors tile_errors(std::span<const TwinView> views);

/// Root of the mean of squared errors (0 if negative), with its 95 % bootstrap interval over the values;
/// `block_length` neighbours are drawn together (BootstrapOptions).
Interval root_mean_interval(std::span<const double> squared_errors, std::uint64_t seed, int block_length);
/// Over tiles, one row of tiles drawn together: neighbouring tiles share what they show.
Interval root_mean_interval(const TileErrors& tiles, std::uint64_t seed);

/// The same as a ratio of two root mean squares over paired values, resampled together. The second must be
/// positive.
Interval root_ratio_interval(std::span<const double> numerator, std::span<const double> denominator,
                             std::uint64_t seed, int block_length);
/// Over the tiles that both hold. Throws InputError if there are none.
Interval root_ratio_interval(const TileErrors& numerator, const TileErrors& denominator, std::uint64_t seed);

/// A rectangle of the image, clipped to it.
struct Window {
  int x = 0, y = 0, width = 0, height = 0;
};
Window window_around(const ViewGrid& grid, double x, double y, double half_width, double half_height);

/// Luma of encoded colours, the mean of both renderings.
Plane<float> luma_of(const std::array<DisplayImage, 2>& images);

/// Bright spots in a window: connected groups (8 neighbours) of at least 3 pixels brighter than the window's
/// median by more than `height`. Single bright pixels are noise.
int count_spots(const Plane<float>& luma, const Window& window, float height);

/// How far the window's maximum rises above its median.
float peak_height(const Plane<float>& luma, const Window& window);

/// Autocorrelation of a window (its median subtracted) at a horizontal displacement, 1 at displacement 0;
/// 0 for an even window. Linear interpolation between pixels.
double autocorrelation(const Plane<float>& luma, const Window& window, double displacement_px);

/// Truth, synthesis and their difference, for add_comparison.
ImageComparison truth_and_synthesis(const TwinView& view, const std::string& caption);
/// Files the radiance of both with it.
void add_twin_comparison(ReproductionResult& result, const std::string& name, const TwinView& view,
                         const std::string& caption);

/// "0.012 [0.010, 0.014]"
std::string text_of(const Interval& interval, int digits = 2);
/// The same, or "not measurable".
std::string text_of(const std::optional<Interval>& interval);

/// A plot point with its interval.
PlotPoint plot_point(double x, const Interval& y);

}  // namespace plenolab
