#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "analysis/psychophysics/csv.h"
#include "core/base/file.h"

namespace plenolab {

/// Values computed by R 4.2.2, or in exact arithmetic where R is not exact: tests/data/psychophysics.csv.
inline const CsvTable& reference() {
  static const CsvTable table =
      parse_csv(read_text_file(PLENOLAB_SOURCE_DIR "/tests/data/psychophysics.csv"), "psychophysics.csv");
  return table;
}

/// A row of it; numbers that stand nowhere are 0.
struct ReferenceRow {
  std::string kind, quantity, note;
  std::int64_t n = 0, k = 0;
  double p = 0, alpha = 0, value = 0;
};

inline ReferenceRow reference_row(const CsvRow& row) {
  const auto field = [&](const char* column) { return row.fields[reference().column(column)]; };
  const auto number = [&](const char* column) {
    return field(column).empty() ? 0 : std::stod(field(column));
  };
  return {field("kind"),
          field("quantity"),
          field("note"),
          static_cast<std::int64_t>(number("n")),
          static_cast<std::int64_t>(number("k")),
          number("p"),
          number("alpha"),
          number("value")};
}

/// Checks `ours` against every row of a kind, to a relative error; at least `least` rows must be there.
inline void expect_reference(const std::string& kind, int least, double relative,
                             const std::function<double(const ReferenceRow&)>& ours) {
  int rows = 0;
  for (const CsvRow& line : reference().rows) {
    const ReferenceRow row = reference_row(line);
    if (row.kind != kind) continue;
    const double value = ours(row);
    if (std::isnan(value)) continue;  // not this function's quantity
    ++rows;
    EXPECT_NEAR(value, row.value, relative * std::abs(row.value) + 1e-300)
        << kind << ' ' << row.quantity << " n=" << row.n << " k=" << row.k << " p=" << row.p;
  }
  EXPECT_GE(rows, least) << "rows of kind " << kind;
}

}  // namespace plenolab
