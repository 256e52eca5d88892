#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "metrics/error_map.h"

namespace plenolab {

ReproductionResult reproduce_claim_g6(Laboratory& laboratory);

namespace {

// Restoration looks right where it is no worse than the rest of the same views, and wrong where it is worse.
constexpr double kAsTheRest = 1;

/// Restored background counts as truly background if the true view shows a surface of its disparity, to what
/// rule 2 tells surfaces apart by.
constexpr double kSameSurface_px = 1;

/// Error of one scene, restored regions as units.
struct RestorationErrors {
  std::vector<ErrorSum> regions;  ///< restored pixels where the true view shows background
  ErrorSum foreground;  ///< restored pixels where the true view shows something nearer: lost structures
  ErrorSum rest;        ///< all other seen pixels
};

/// Disparity of the restored background: the weighted mean of its correspondences.
double restored_disparity(const PixelProvenance& pixel) {
  double sum = 0, weights = 0;
  for (const Correspondence& c : pixel) {
    if (c.state != CorrespondenceState::kRestored) continue;
    sum += static_cast<double>(c.weight) * static_cast<double>(c.disparity_px);
    weights += static_cast<double>(c.weight);
  }
  return weights > 0 ? sum / weights : 0;
}

struct JudgedView {
  NovelView<SceneReferred> novel;
  KeyView<SceneReferred> truth;
  float exposure = 1;
};

void add_view(const JudgedView& view, RestorationErrors& errors) {
  const Plane<float> error = squared_error(view.novel.image, view.truth.colour, view.exposure);
  for (const auto& region : regions_of(view.novel.restored)) {
    ErrorSum background;
    for (const std::size_t i : region) {
      const double nearer = static_cast<double>(view.truth.disparity.pixels()[i]) -
                            restored_disparity(view.novel.provenance.pixels()[i]);
      (nearer <= kSameSurface_px ? background : errors.foreground)
          .add(static_cast<double>(error.pixels()[i]));
    }
    if (background.pixels > 0) errors.regions.push_back(background);
  }
  for (std::size_t i = 0; i < error.size(); ++i)
    if (view.novel.restored.pixels()[i] == 0 && view.novel.unseen.pixels()[i] == 0)
      errors.rest.add(static_cast<double>(error.pixels()[i]));
}

void show(ReproductionResult& result, Laboratory& laboratory, const std::string& id, const JudgedView& view) {
  ComparisonConditions conditions;
  conditions.exposure = view.exposure;
  const std::string& title = laboratory.scene(id).title;
  result.add_comparison(
      id,
      {fmt::format("{} from ({:.2f}, {:.2f}); {} px are restored, red in the visibility map", title,
                   view.novel.position.s, view.novel.position.t, view.novel.restored_pixels),
       fmt::format("Truth, synthesised view, difference and visibility map of {}", title),
       {{"Ground truth", expose(view.truth.colour, view.exposure)},
        {"Synthesised", expose(view.novel.image, view.exposure)},
        {"Difference", error_map(view.novel.image, view.truth.colour, conditions)},
        {"Visibility", visibility_map(view.novel)}}},
      {view.truth.colour, view.novel.image});
}

RestorationErrors measure_scene(Laboratory& laboratory, const std::string& id, ReproductionResult& result) {
  RestorationErrors errors;
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  options.record_provenance = true;
  bool shown = false;
  for (const CameraPosition position : judged_positions(laboratory.grid(id), laboratory.options().effort)) {
    JudgedView view{laboratory.synthesizer(id).synthesize(position, options), laboratory.truth(id, position),
                    1};
    view.exposure = exposure_from(view.truth.colour);
    add_view(view, errors);
    if (!shown) show(result, laboratory, id, view);
    shown = true;
  }
  return errors;
}

ErrorSum pooled(const std::vector<ErrorSum>& regions) {
  ErrorSum sum;
  for (const ErrorSum& region : regions) sum += region;
  return sum;
}

/// RMS error in restored background over that of the rest of the same views.
Interval ratio_of(const RestorationErrors& errors, std::uint64_t seed) {
  const double rest = std::max(errors.rest.rms(), 1e-9);
  return bootstrap_units(
      errors.regions.size(),
      [&](std::span<const double> drawn) {
        ErrorSum sum;
        for (const double i : drawn) sum += errors.regions[static_cast<std::size_t>(i)];
        return sum.rms() / rest;
      },
      seed);
}

void add_rows(ResultTable& rows, const std::string& id, const RestorationErrors& errors) {
  const ErrorSum background = pooled(errors.regions);
  const auto add = [&](const char* region, const ErrorSum& sum) {
    rows.add({"rms_error", sum.rms(), "1", {{"scene", id}, {"region", std::string(region)}}});
    rows.add({"pixels", sum.pixels, "px", {{"scene", id}, {"region", std::string(region)}}});
  };
  add("restored, truly background", background);
  add("restored, truly nearer", errors.foreground);
  add("rest", errors.rest);
}

Verdict decide_scene(const std::string& id, const RestorationErrors& errors, Comparison comparison,
                     std::uint64_t seed) {
  if (errors.regions.empty())
    return undecidable(fmt::format("No background was restored in the views of {} judged here.", id));
  const Interval ratio = ratio_of(errors, seed);
  Verdict verdict =
      decide_claim(ratio, comparison, kAsTheRest, "restored_error_over_rest", "1",
                   fmt::format("95 % bootstrap over {} restored regions", errors.regions.size()));
  verdict.scenes = {id};
  verdict.explanation = fmt::format(
      "RMS error of encoded values in restored regions of {} where the true view shows background too (a "
      "surface not "
      "more than 1 px of disparity nearer than what was restored), divided by that of all pixels that were "
      "not "
      "restored, in the same views: {}. Below 1 restored background is no worse than the rest. Restored "
      "pixels where "
      "the true view shows something nearer are structures lost by rule 2 and belong to A-G3.",
      id, interval_text(ratio));
  return verdict;
}

std::string words_of(const Verdict& verdict, const RestorationErrors& errors) {
  if (!verdict.interval) return "no background is restored";
  return fmt::format("the error of {:.0f} px of restored background is {} times that of the rest",
                     pooled(errors.regions).pixels, interval_text(*verdict.interval));
}

Plot plot_of(const std::vector<std::string>& titles, const std::vector<Verdict>& verdicts) {
  Plot plot;
  plot.x.title = "Scene";
  plot.y = {.title = "RMS error of restored background over that of the rest",
            .unit = "1",
            .minimum = 0,
            .maximum = {}};
  plot.key = KeyPosition::kNone;
  plot.series = {{.title = "ratio", .points = {}}};
  for (std::size_t i = 0; i < titles.size(); ++i) {
    if (!verdicts[i].interval) continue;
    plot.categories.push_back(titles[i]);
    plot.series[0].points.push_back({.y = verdicts[i].number,
                                     .y_low = verdicts[i].interval->low,
                                     .y_high = verdicts[i].interval->high,
                                     .label = {}});
  }
  return plot;
}

}  // namespace

ReproductionResult reproduce_claim_g6(Laboratory& laboratory) {
  ReproductionResult result;
  const std::uint64_t seed = laboratory.options().seed;
  const RestorationErrors tree = measure_scene(laboratory, "tree", result);
  const RestorationErrors cellar = measure_scene(laboratory, "cellar", result);
  const Verdict right = decide_scene("tree", tree, Comparison::kBelow, seed);
  const Verdict wrong = decide_scene("cellar", cellar, Comparison::kAbove, seed);
  add_rows(result.rows, "tree", tree);
  add_rows(result.rows, "cellar", cellar);
  result.paper_shows =
      "Filling unseen background from the pixels beside it looks free of artefacts before the sky of the "
      "Tree (figure "
      "32) and shows artefacts before the walls of the Cellar (figure 31).";
  result.ours_shows =
      fmt::format("In Tree {}: {} In Cellar {}: {}", words_of(right, tree), outcome_text(right.outcome),
                  words_of(wrong, cellar), outcome_text(wrong.outcome));
  result.differs = fmt::format(
      "In {:.0f} restored pixels of Tree and {:.0f} of Cellar the true view shows no background but a "
      "structure too thin "
      "to be found (RMS error {} and {}); they do not count here.",
      tree.foreground.pixels, cellar.foreground.pixels, format_number(tree.foreground.rms(), 3),
      format_number(cellar.foreground.rms(), 3));
  const Plot plot =
      plot_of({laboratory.scene("tree").title, laboratory.scene("cellar").title}, {right, wrong});
  if (!plot.categories.empty())
    result.add_plot(
        "restored-over-rest",
        {plot,
         "Error of restored background as a multiple of the error of the rest of the same views; 95 % "
         "bootstrap intervals over restored regions",
         result.ours_shows});
  conclude(result,
           {"A-G6a", "Altmeier 2018, section 6.1.1, figure 32",
            "Restored background looks right before a uniform background (Tree)."},
           right);
  conclude(result,
           {"A-G6b", "Altmeier 2018, section 6.1.1, figure 31",
            "Restored background does not look right before a structured background (Cellar)."},
           wrong);
  return result;
}

}  // namespace plenolab
