// Figure 22 (section 5.1.2): the naive bilateral operator on a key view.
#include <fmt/format.h>

#include "experiments/reproduce/tonemap/bilateral_view.h"

namespace plenolab {

ReproductionResult reproduce_naive_bilateral_view(Laboratory& laboratory);

namespace {

ImageComparison pictures_of(const BilateralView& view) {
  ImageComparison comparison{fmt::format("{}: result, base layer (black to white: its range without 1 % at "
                                         "each end) and detail layer (middle grey: none; "
                                         "black and white: {:.2f} log10 units to either side)",
                                         view.title, view.shown.detail_scale),
                             "Result, base and detail layer of the naive bilateral operator",
                             {{"Naive bilateral", view.mapped}}};
  comparison.images.push_back({"Base layer", view.shown.pictures[0].image});
  comparison.images.push_back({"Detail layer", view.shown.pictures[1].image});
  return comparison;
}

}  // namespace

ReproductionResult reproduce_naive_bilateral_view(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 22 shows a key view of the Cellar through the naive bilateral operator, with base and detail "
      "layer: the base holds large differences of light, the detail textures and profiles at edges.";
  const BilateralView view = map_middle_of_cellar(laboratory, cellar_scene(laboratory), false);
  add_view_rows(result, view, "naive");
  const double input = range_without_outliers(view.layers.log_luminance);
  const double base = range_without_outliers(view.layers.base);
  const double target = range_without_outliers(target_log_luminance(view.parameters, view.layers));
  result.ours_shows = fmt::format(
      "Of {:.2f} log10 units that the view spans (1st to 99th percentile) the base holds {:.2f}; compressed "
      "to "
      "{:.0f} % (one number for all key views) and with the detail as it was the result spans {:.2f}. 99 % "
      "of "
      "the detail lies within ±{:.2f}.",
      input, base, 100 * view.parameters.compression, target, view.shown.detail_scale);
  result.differs =
      target < input
          ? "They agree in what each layer holds. Our scene is not the thesis' and our views carry path "
            "tracing "
            "noise, which the operator keeps whole: it is in the detail layer, which is not compressed."
          : "They differ: the result spans no less than the view.";
  result.add_comparison("naive-bilateral", pictures_of(view));
  return result;
}

}  // namespace plenolab
