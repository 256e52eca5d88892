#pragma once

#include <filesystem>
#include <functional>

#include "core/lightfield/hci.h"

namespace plenolab {

/// Signed disparity of view (column, row) in the benchmark's image coordinates.
using HciTruth = std::function<Plane<float>(int column, int row)>;

/// Finds the ground truth of a scene, in the order import_hci states. Throws InputError if there is none.
HciTruth find_hci_truth(const std::filesystem::path& folder, const HciParameters& parameters);

/// Spreads signed disparity, recorded at the grid's centre, to a view (columns, rows) away from it: every
/// pixel moves by −offset·d, the nearest surface (highest d) wins, one-pixel cracks are closed, and holes
/// take the farther of their neighbours in the row (or, in an empty row, the farthest value of the map).
Plane<float> spread_disparity(const Plane<float>& centre, double columns_away, double rows_away);

}  // namespace plenolab
