#pragma once

#include <string>
#include <vector>

#include "analysis/report/report.h"
#include "analysis/result_table.h"

namespace plenolab {

/// A heading of a wide table: the quantity it shows and the words above it.
struct WideColumn {
  std::string quantity;
  std::string heading;
};

/// One line for each setting of the identifying columns `keys` (in order of first appearance), one column for
/// each quantity; rows of other quantities are left out, missing values are empty. For people: the same rows
/// that JSON and CSV hold in long form.
ReportTable wide_table(const ResultTable& results, const std::vector<std::string>& keys,
                       const std::vector<WideColumn>& quantities, std::string caption = {});

/// The same as aligned text.
std::string to_wide_text(const ResultTable& results, const std::vector<std::string>& keys,
                         const std::vector<WideColumn>& quantities);

}  // namespace plenolab
