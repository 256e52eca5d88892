#include "experiments/colour_error.h"

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/cielab.h"

namespace plenolab {

ColourError colour_error(const DisplayImage& test, const DisplayImage& reference, int threads) {
  PLENOLAB_CHECK(test.width() == reference.width() && test.height() == reference.height() && !test.empty(),
                 "pictures of equal sizes");
  std::vector<ColourError> rows(static_cast<std::size_t>(test.height()));
  parallel_for(test.height(), 4, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      ColourError& row = rows[static_cast<std::size_t>(y)];
      for (int x = 0; x < test.width(); ++x) {
        const double e = delta_e(lab_of_display(test.at(x, y)), lab_of_display(reference.at(x, y)));
        row.mean += e;
        row.largest = std::max(row.largest, e);
      }
    }
  });
  ColourError all;
  for (const ColourError& row : rows) {
    all.mean += row.mean / static_cast<double>(test.size());
    all.largest = std::max(all.largest, row.largest);
  }
  return all;
}

}  // namespace plenolab
