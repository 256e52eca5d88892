#pragma once

#include <cstddef>

namespace plenolab {

/// How correspondences are searched. Both find the same correspondences, bit for bit; they differ in time
/// only.
enum class SearchKind {
  kLinear,  ///< the literal search of the thesis (section 4.1.3): every sample of the path in turn, pixel by
            ///< pixel
  kFast,  ///< the same samples, but only those where a tile occupancy built from the disparity maps allows a
          ///< hit
};

/// How key views fade out towards their image border (thesis, section 4.2.1).
enum class BorderWeight {
  kPrinted,         ///< g⁴ + (1 − g³)·g·(|b| + δ_bo), the weight the thesis uses
  kLinearGradient,  ///< g, which the thesis rejects because it leaves visible edges near key views
  kNone,            ///< 1
};

/// The two cameras of section 4.3.
enum class CameraKind {
  kShiftedFrustum,  ///< viewing axis orthogonal to the camera plane, resolution and opening angles of the key
                    ///< views
  kFixedScreen,     ///< a viewer moving parallel to a monitor that stands still in the scene
};

/// Everything that can be chosen about a synthesis (thesis of Altmeier, section 4). The defaults are the
/// thesis' choices.
struct SynthesisOptions {
  SearchKind search = SearchKind::kFast;
  double step_px = 1;  ///< distance of the samples along the search path, ¼ … 4
  double disocclusion_px =
      1;  ///< rule 2: a larger disparity range among the pixels around A discards it, > 0
  double occlusion_margin_px = 0.25;  ///< rule 3: δ_occ, ≥ 0
  double border_fraction = 0.1;  ///< width of the border region as a share of the image dimension, (0, 0.5]
  double border_delta = 0.01;    ///< δ_bo, ≥ 0 … 1
  BorderWeight border_weight = BorderWeight::kPrinted;
  bool restore = true;     ///< rule 4: fill from the background where every view in frustum failed rule 2
  bool keep_thin = false;  ///< keep structures thinner than 2 × 2 px, see thin_structures.h
  int key_views = 4;       ///< 4, 2 or 1: the nearest of the cell's four, for sweeps of error against time
  CameraKind camera = CameraKind::kShiftedFrustum;
  double screen_depth_m = 0;  ///< z_s of the fixed screen, > 0 (∞ allowed); ignored by the shifted frustum
  bool prune = true;          ///< leave out stages that provably cannot change the result (NovelView::pruned)
  bool record_provenance = false;  ///< fill NovelView::provenance (costs memory)
  bool count_probes = false;       ///< and Correspondence::probes: searches pixel by pixel, which is slow
  int threads = 0;                 ///< 0 = all cores; results do not depend on it

  /// Throws InputError with one sentence that names the first value out of range.
  void validate() const;
};

}  // namespace plenolab
