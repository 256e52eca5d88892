#pragma once

#include <string>

#include "analysis/result_table.h"

namespace plenolab {

/// What metrics there are, for people: each with what it takes, its quantities, their units and which way is
/// better.
std::string metric_list_text();

/// The same as rows, one a quantity: its name with the least possible value, its unit, and columns metric,
/// family, takes, better, of_equal_images, meaning.
ResultTable metric_list_rows();

}  // namespace plenolab
