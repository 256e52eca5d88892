#pragma once

#include <vector>

#include "core/lightfield/view_grid.h"
#include "core/synthesis/novel_view.h"

namespace plenolab {

/// The key views that take part in the view from `position`: the corners of its cell
/// (min(⌊s⌋, columns − 2), min(⌊t⌋, rows − 2)); a grid of one column or row has two, a single view one. Only
/// one if `position` is a key view (|b| = 0: that view alone). Sorted by baseline length in metres, ties by
/// row, then column, and cut to the `count` nearest. The weights of an uncut selection sum to 1. Throws
/// InputError if `position` is not on the grid.
std::vector<UsedView> select_key_views(const ViewGrid& grid, CameraPosition position, int count = kMaxViews);

}  // namespace plenolab
