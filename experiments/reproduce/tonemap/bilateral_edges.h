#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiments/reproduce/laboratory.h"

namespace plenolab {

/// What the variants of the bilateral operator do to contrast across depth edges of a scene's key views.

/// The edges that count as of low contrast: those that the range weight does not keep apart, up to σ_l.
inline constexpr double kLowContrast_log10 = 0.4;

/// Contrast of one view along its layers. The target is linear in them, so that the contrast of every
/// operator follows from these sums for any compression.
struct LayerContrast {
  double input = 0, naive_base = 0, base = 0, foreground = 0;
  std::int64_t edges = 0;
};

/// One scene: what decides, and the same over edges of any contrast.
struct SceneContrast {
  std::string id, title;
  double compression = 1;
  std::vector<LayerContrast> low, any;  ///< of each view
};

/// Of at most six key views, spread over the grid: neighbours share most of what they show.
SceneContrast measure_edge_contrast(Laboratory& laboratory, const std::string& id);

/// Contrast of the target, log10 units, summed over views: log L_target = I − (1 − compression)·base +
/// scale·foreground, scale = 1 − compression.
struct TargetContrast {
  double input = 0, naive = 0, without = 0, with = 0;
  std::int64_t edges = 0;

  double fall() const { return without / naive; }
  double returned() const { return (with - without) / (naive - without); }
};

/// `drawn`: numbers of the views, each as often as it is drawn.
TargetContrast sum_contrast(const std::vector<LayerContrast>& views, double compression,
                            std::span<const double> drawn);
/// Each view once.
TargetContrast sum_contrast(const std::vector<LayerContrast>& views, double compression);

}  // namespace plenolab
