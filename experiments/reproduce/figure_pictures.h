#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/reproduce/figure_tools.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// True views of the figures take this many times the paths of the key views: their noise would hide effects.
inline constexpr int kTruthPathFactor = 4;

/// Encoded differences above this are called visible in the figures. The metrics' own default, 0.02, suits
/// views without noise; at the quick preset the path tracing noise of single pixels often exceeds it and
/// would be counted. Sentences that use the threshold name it.
inline constexpr double kVisibleDifference = 0.1;

/// A synthesised view and what to call it.
struct LabelledView {
  std::string label;
  const SceneImage* image = nullptr;
};

/// The pictures of one position: the truth, synthesised views, their differences from the truth, and maps.
struct FigurePictures {
  std::string what;  ///< of the captions, e.g. "Cellar from 1.25, 0.75"
  const SceneImage* truth = nullptr;
  std::vector<LabelledView> synthesised;  ///< at least one
  std::vector<ReportImage> maps;          ///< of the views' size, e.g. visibility
  PixelBox box;                           ///< what is enlarged
  std::optional<int> cut_row;             ///< of the epipolar image, marked green
  std::string choice;  ///< how position and box were chosen, for the caption of the whole views; may be empty
  std::string note;    ///< a sentence for the captions, e.g. what a map means; may be empty
};

/// Error of a view or of a part of it.
struct ErrorNumbers {
  double psnr_db = 0, ssim = 0;
  double visible_share = 0;  ///< of pixels that differ by more than kVisibleDifference
};

/// Of each synthesised view, in order.
struct PictureNumbers {
  std::vector<ErrorNumbers> whole, box;
};

/// Adds two comparisons: the whole views, and the box enlarged four times. The whole views are shown and
/// measured at the figure_exposure of the truth, the box at its crop_exposure. Rows: psnr_gamma_db,
/// ssim_gamma, visible_share and exposure with the columns given, then view and region ("whole", "crop").
PictureNumbers add_pictures(ReproductionResult& result, const FigurePictures& pictures,
                            const Columns& columns, int threads);

/// Error of the pixels of a mask, at the exposure of the whole views.
struct MaskedNumbers {
  std::size_t pixels = 0;
  double psnr_db = 0, visible_share = 0;
  double truth_spread = 0;  ///< standard deviation of the truth's encoded luma over the pixels
};

/// Nothing if the mask is empty. Rows: psnr_gamma_db, visible_share and truth_spread with the columns given
/// and region.
std::optional<MaskedNumbers> add_masked_rows(ReproductionResult& result, const SceneImage& test,
                                             const SceneImage& truth, const Mask& mask,
                                             const std::string& region, const Columns& columns);

/// "s, t" for people.
std::string name_of(CameraPosition position);

/// "1.5 %" of a share.
std::string percent(double share);

}  // namespace plenolab
