#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/pruned_stage.h"
#include "core/image/image.h"
#include "core/lightfield/view_grid.h"

namespace plenolab {

/// Most key views that take part in one novel view.
inline constexpr int kMaxViews = 4;

/// A key view that takes part: its grid position, baseline b = I − F in spacings, and bilinear weight
/// W_bi = (1 − |b_x|)(1 − |b_y|).
struct UsedView {
  int column = 0, row = 0;
  double b_x = 0, b_y = 0;
  double weight = 0;
  friend bool operator==(const UsedView&, const UsedView&) = default;
};

/// What became of one pixel's correspondence in one key view.
enum class CorrespondenceState : std::uint8_t {
  kNotUsed,  ///< the key view takes no part (I on another key view, or fewer key views asked for or present)
  kUsed,     ///< visible, contributes with `weight`
  kOutOfFrustum,  ///< rule 1: the surface may lie outside the key view's image
  kDisocclusion,  ///< rule 2: A lies on a pseudo-surface between two surfaces
  kOccluded,      ///< rule 3: another view sees a nearer surface
  kRestored,      ///< rule 4: background pixel beside A, used because every view in frustum failed rule 2
  kWeightZero,    ///< visible, but its weight is exactly 0 beside views that have one
};

/// One pixel's correspondence in one key view, for inspection.
struct Correspondence {
  CorrespondenceState state = CorrespondenceState::kNotUsed;
  bool thin = false;  ///< found by the keep_thin variant
  /// Disparity samples looked at along the path, refinement included (saturates); see
  /// SynthesisOptions::count_probes.
  std::uint16_t probes = 0;
  float x = 0, y = 0;      ///< A in image coordinates of the key view (pixel centres at integer + 0.5)
  float disparity_px = 0;  ///< at A
  float weight = 0;        ///< share in the output colour, 0 … 1; sums to 1 over the views of a seen pixel
};

/// Correspondences of one pixel in the order of NovelView::views.
using PixelProvenance = std::array<Correspondence, kMaxViews>;

/// Counts over all pixels and used views (a pixel in two views counts twice).
struct SynthesisStatistics {
  std::uint64_t searches = 0;        ///< pixels × used views
  std::uint64_t search_samples = 0;  ///< disparity samples of the first pass
  std::uint64_t refine_samples = 0;  ///< disparity samples of the second pass (sub-samples)
  std::uint64_t used = 0, out_of_frustum = 0, disoccluded = 0, occluded = 0, restored = 0, weight_zero = 0;
  std::uint64_t thin = 0;  ///< correspondences of the keep_thin variant
  double samples_per_search() const {
    return searches == 0 ? 0 : static_cast<double>(search_samples) / static_cast<double>(searches);
  }
};

/// Seconds per stage. Those of a stage that runs inside worker threads are summed over the threads; `total`
/// is wall time.
struct SynthesisTimings {
  double prepare_s = 0;    ///< loading and encoding key views that were not prepared yet
  double occupancy_s = 0;  ///< building the tile occupancy (fast search), wall time
  double search_s = 0;     ///< rule 1, thread seconds
  double lookup_s = 0;     ///< fetching colours and disparities at A, thread seconds
  double blend_s = 0;      ///< rules 2 to 5 and decoding, thread seconds
  double total_s = 0;      ///< wall time of the call
};

/// A synthesised view.
template <class Referral>
struct NovelView {
  RgbImage<Referral> image;  ///< radiance (scene-referred) or code values (display-referred)
  CameraPosition position;
  std::vector<UsedView> views;  ///< the key views that took part, nearest first
  Plane<std::uint8_t>
      visible_views;  ///< per pixel: views that see it, before restoration (0 = red in the map)
  Mask unseen;        ///< 1 where nothing at all was found: the image is 0 there
  Mask restored;      ///< 1 where rule 4 filled the pixel
  std::size_t unseen_pixels = 0;
  std::size_t restored_pixels = 0;
  std::size_t repaired_values = 0;  ///< values of the used key views replaced before use, see PreparedView
  float d_max_px = 0;               ///< where the search started
  SynthesisStatistics statistics;
  SynthesisTimings timings;
  std::vector<PrunedStage> pruned;
  Plane<PixelProvenance> provenance;  ///< empty unless asked for
};

}  // namespace plenolab
