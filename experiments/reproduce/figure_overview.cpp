#include "experiments/reproduce/figure_overview.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/statistics.h"

namespace plenolab {

namespace {

bool is_seen_by_all(const NovelView<SceneReferred>& view, const PixelBox& box) {
  int seen = 0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) seen += view.visible_views.at(x, y) == view.views.size();
  return 2 * seen >= box.width * box.height;
}

std::string text_of(const Spread& spread, const char* format) {
  return fmt::format(fmt::runtime(format), spread.median, spread.low, spread.high);
}

}  // namespace

std::optional<Spread> spread_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Spread{median(values), quantile(values, 0), quantile(values, 1), values.size()};
}

std::vector<PixelBox> eligible_squares(const NovelView<SceneReferred>& view, int size) {
  std::vector<PixelBox> squares;
  for (int y = 0; y + size <= view.image.height(); y += size)
    for (int x = 0; x + size <= view.image.width(); x += size)
      if (const PixelBox square{x, y, size, size}; is_seen_by_all(view, square)) squares.push_back(square);
  return squares;
}

Overview overview_of(const NovelView<SceneReferred>& view, const SceneImage& truth, const PixelBox& box,
                     const EpiPair* epi) {
  const float exposure = figure_exposure(truth);
  Overview overview{.rms_of_box = rms_difference(view.image, truth, exposure, box),
                    .rms = {},
                    .row = truth.height() / 2,
                    .fading = {}};
  std::vector<double> errors, fading;
  for (const PixelBox& square : eligible_squares(view, box.width)) {
    errors.push_back(rms_difference(view.image, truth, exposure, square));
    if (epi == nullptr || square.y > overview.row || square.y + square.height <= overview.row) continue;
    const EpiNumbers numbers = measure_epi(*epi, square, exposure);
    if (numbers.rms_at_keys > 0) fading.push_back(numbers.rms_between / numbers.rms_at_keys);
  }
  overview.rms = spread_of(errors);
  overview.fading = spread_of(fading);
  return overview;
}

std::string overview_text(const Overview& overview) {
  if (!overview.rms) return "";
  std::string text = fmt::format(
      "For comparison: the {} squares of this size that tile the view and are seen by all key views "
      "to at least a half have an encoded RMS error of {}, the enlarged part {:.3f}.",
      overview.rms->count, text_of(*overview.rms, "{:.3f} (median; {:.3f} to {:.3f})"), overview.rms_of_box);
  if (overview.fading)
    text += fmt::format(
        " In the columns of the {} of them on the image's middle row the error between key views is {} times "
        "that at them.",
        overview.fading->count, text_of(*overview.fading, "{:.1f} (median; {:.1f} to {:.1f})"));
  return text;
}

void add_overview_rows(ResultTable& rows, const Overview& overview, const Columns& columns) {
  const auto add = [&](const char* quantity, const char* statistic, double value) {
    Columns all = columns;
    all.emplace_back("statistic", std::string(statistic));
    rows.add({quantity, value, "1", all});
  };
  add("overview_rms", "enlarged", overview.rms_of_box);
  for (const auto& [quantity, spread] :
       {std::pair{"overview_rms", overview.rms}, {"overview_fading", overview.fading}}) {
    if (!spread) continue;
    add(quantity, "median", spread->median);
    add(quantity, "low", spread->low);
    add(quantity, "high", spread->high);
  }
}

}  // namespace plenolab
