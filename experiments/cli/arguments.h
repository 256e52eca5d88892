#pragma once

#include <string>
#include <vector>

#include "core/lightfield/view_grid.h"

namespace plenolab {

/// Parses "S,T" (two finite numbers) as a camera position. Throws UsageError that names the option it was
/// given to and shows the expected form.
CameraPosition parse_position(const std::string& text, const std::string& option);

/// Parses "S0,T0:S1,T1[:S2,T2…]" and spreads `frames` ≥ 1 positions at equal distances along the polyline,
/// both ends included (one frame: its start). Throws UsageError that shows the expected form.
std::vector<CameraPosition> parse_path(const std::string& text, int frames);

/// Splits at commas, empty parts removed.
std::vector<std::string> split_list(const std::string& text);

}  // namespace plenolab
