#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

/// How the figures find the position and the part of the view that show an effect: by measuring it at many
/// positions, never by coordinates. All of it works without ground truth, so nothing is rendered for it.

/// One position per cell of the grid and offset from the cell's top-left key view, as far as it lies on the
/// grid; the grid's centre if none does.
std::vector<CameraPosition> cell_positions(const ViewGrid& grid, std::span<const CameraPosition> offsets);

/// Offsets inside a cell: its centre and the middles of its quarters.
std::span<const CameraPosition> offsets_inside_cells();
/// Offset of the middle between two neighbouring key views of a row: only these two contribute there.
std::span<const CameraPosition> offsets_on_rows();

/// How strongly an effect shows at each pixel of a view, ≥ 0.
using EffectMeasure = std::function<Plane<float>(const NovelView<SceneReferred>& view)>;

/// Where an effect shows most.
struct Place {
  NovelView<SceneReferred> view;  ///< with provenance
  Plane<float> effect;
  PixelBox box;      ///< the crop (crop_size) with most of it
  double sum = 0;    ///< of the effect inside the box
  int searched = 0;  ///< positions looked at
};

/// Synthesises all candidate positions and keeps the one whose best crop shows most of the effect (the first
/// of equal ones).
Place find_place(const Synthesizer& synthesizer, std::span<const CameraPosition> candidates, int threads,
                 const EffectMeasure& measure);

/// What one key view says about the novel view: encoded, unclipped colours of its correspondences (its own
/// pixels, bilinear at A), and where it contributes.
struct WarpedView {
  Plane<Rgb> encoded;   ///< max(C, 0)^(1/2.2), 0 where it has no correspondence
  Plane<float> weight;  ///< share in the output colour, restored pixels left out
};

/// The key views that took part, in the order of view.views. The view needs its provenance.
std::vector<WarpedView> warp_key_views(const NovelView<SceneReferred>& view, const LightField& field);

/// Above 0 where no key view sees the surface and at least one looks past it because its image ends (rules 2
/// and 1 failed together): the share of such pixels among the 5×5 around, so that areas count more than rims.
Plane<float> unseen_beyond_frustum(const NovelView<SceneReferred>& view);

/// 1 where the background was restored (rule 4).
Plane<float> restored_pixels(const NovelView<SceneReferred>& view);

/// Weighted variance, over the key views that contribute, of encoded luma at the exposure of the view, each
/// view's deviation from the mean smoothed over 5×5 px first (those seen by the same key views): what the
/// blend mixes because the surface looks different from each key view, hardly noise.
EffectMeasure disagreement_of_views(const LightField& field);

/// Squared change of encoded luma, smoothed over 5×5 px, that a surface point undergoes where some key views
/// cease to contribute from one pixel to the next on the same surface (disparities differ by less than 1 px).
EffectMeasure jump_at_visibility_borders(const LightField& field);

}  // namespace plenolab
