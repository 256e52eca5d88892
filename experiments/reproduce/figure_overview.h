#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/synthesis/novel_view.h"
#include "experiments/reproduce/figure_epi.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

/// What a figure's enlarged part is compared with, so that it is not taken for the view: the same numbers at
/// all places that could have been enlarged.

/// Median and range of a number over places.
struct Spread {
  double median = 0, low = 0, high = 0;
  std::size_t count = 0;
};
/// Empty for no values.
std::optional<Spread> spread_of(const std::vector<double>& values);

/// The squares of `size` px that tile the view from its top-left corner (what is left over at the right and
/// lower border is not looked at) and at least half of whose pixels all key views see.
std::vector<PixelBox> eligible_squares(const NovelView<SceneReferred>& view, int size);

struct Overview {
  double rms_of_box = 0;         ///< encoded error of the enlarged part, at the exposure of the whole view
  std::optional<Spread> rms;     ///< the same of the eligible squares
  int row = 0;                   ///< middle row of the image
  std::optional<Spread> fading;  ///< error between key views over that at them, for the squares on that row
};

/// `epi`: of the middle row. Squares whose frames at key views show no error have no fading.
Overview overview_of(const NovelView<SceneReferred>& view, const SceneImage& truth, const PixelBox& box,
                     const EpiPair* epi);

/// "For comparison: the 18 squares of this size that tile the view …"; empty without eligible squares.
std::string overview_text(const Overview& overview);

/// Rows overview_rms and overview_fading with columns statistic (enlarged, median, low, high) behind those
/// given.
void add_overview_rows(ResultTable& rows, const Overview& overview, const Columns& columns);

}  // namespace plenolab
