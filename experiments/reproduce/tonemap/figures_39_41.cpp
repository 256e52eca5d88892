// Figures 39 and 41: novel views between key views that Reinhard 2005 maps one by one, where the light
// differs between them (Cellar) and where a highlight keeps the peak stable (Dominoes).
#include <fmt/format.h>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/tonemap/claim_tools.h"
#include "experiments/reproduce/tonemap/view_figure.h"

namespace plenolab {

ReproductionResult reproduce_visibility_borders(Laboratory& laboratory);
ReproductionResult reproduce_stable_highlight(Laboratory& laboratory);

namespace {

/// What one mapping leaves at borders of visibility.
struct BorderNumbers {
  std::string label;
  double here = 0;               ///< luma, in the view shown
  std::optional<Interval> mean;  ///< over all views in cells
};

/// The view shown and the numbers of all.
struct BorderStudy {
  StepPlace place;
  std::vector<BorderNumbers> numbers;
};

/// Shows the mappings in the view and the part of it where the first one steps most against joint statistics,
/// and measures the steps of all but joint statistics, which have none by construction.
BorderStudy study_borders(ReproductionResult& result, Laboratory& laboratory, const std::string& scene,
                          const std::vector<Shown>& measured) {
  MappingBench& bench = laboratory.mapping_bench();
  const std::vector<ReferenceFrame>& frames = bench.views_in_cells(scene);
  const Mapping joint = mapping_for(bench, scene, Shown::kReinhardJoint);
  const std::vector<DisplayImage> joint_frames = bench.frames(scene, joint, frames);
  BorderStudy study;
  ViewPictures pictures{.what = laboratory.scene(scene).title,
                        .frame = nullptr,
                        .mapped = {},
                        .maps = {},
                        .box = {},
                        .choice =
                            "Of the views inside all cells, the one whose naive mapping steps most across "
                            "borders of visibility"};
  for (const Mapping& mapping : mappings_for(bench, scene, measured)) {
    const std::vector<DisplayImage> mapped = bench.frames(scene, mapping, frames);
    if (study.numbers.empty()) study.place = largest_steps(frames, mapped, joint_frames);
    pictures.mapped.push_back({mapping.label, mapped[study.place.index]});
    const std::vector<double> steps =
        border_steps(frame_inconsistencies(bench, scene, mapping, with_one_fit(mapping), frames));
    study.numbers.push_back(
        {mapping.label, steps[study.place.index], mean_interval(steps, laboratory.options().seed)});
  }
  pictures.mapped.push_back({joint.label, joint_frames[study.place.index]});
  pictures.frame = &frames[study.place.index];
  pictures.box = study.place.box;
  pictures.maps.push_back(visibility_at(laboratory, scene, pictures.frame->position));
  add_view(result, pictures);
  std::vector<MeasuredNumber> table;
  for (const BorderNumbers& numbers : study.numbers) {
    result.rows.add({"border_step", numbers.here, "luma", {{"scene", scene}, {"mapping", numbers.label}}});
    table.push_back({fmt::format("{}, {} views", numbers.label, frames.size()), numbers.mean});
  }
  add_measured(result, "Steps across borders of visibility against one fit for all key views, RMS",
               "border_step_mean", "luma", table);
  return study;
}

std::string numbers_words(const BorderStudy& study) {
  std::string text = "Steps across borders of visibility, against one fit for all key views (RMS luma):";
  for (const BorderNumbers& numbers : study.numbers)
    text += fmt::format(" {} {:.4f} in the view shown and {} on average over all views.", numbers.label,
                        numbers.here, text_of(numbers.mean));
  return text;
}

}  // namespace

ReproductionResult reproduce_visibility_borders(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 41: in the Cellar, where direct sunlight is seen in some key views only, the naive Reinhard "
      "2005 "
      "leaves artefacts at borders of visibility; key-view adjustment removes them, joint statistics have "
      "none.";
  const BorderStudy study =
      study_borders(result, laboratory, "cellar", {Shown::kReinhardNaive, Shown::kReinhardAdjusted});
  const double naive = study.numbers[0].here, adjusted = study.numbers[1].here;
  result.ours_shows = numbers_words(study) + " Joint statistics have none by construction.";
  result.differs = naive < kSmallestStep
                       ? fmt::format(
                             "They differ: even here the naive steps stay below one step of an 8-bit display "
                             "({:.4f}).",
                             kSmallestStep)
                       : fmt::format(
                             "They agree on the naive variant: its steps exceed one step of an 8-bit display "
                             "({:.4f}).",
                             kSmallestStep);
  result.differs +=
      adjusted < naive
          ? fmt::format(" Key-view adjustment leaves {} of them{}.", percent(adjusted / naive),
                        adjusted < kSmallestStep ? ", below one step" : ", still more than one step")
          : " Key-view adjustment does not lower them here, unlike in the thesis.";
  return result;
}

ReproductionResult reproduce_stable_highlight(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 39: in the Dominoes scene, however noisy, a highlight free of noise keeps the peak luminance "
      "stable, and "
      "the naive Reinhard 2005 is free of visible inconsistency.";
  const BorderStudy study = study_borders(result, laboratory, "dominoes", {Shown::kReinhardNaive});
  const double worst = study.numbers[0].here;
  result.ours_shows = numbers_words(study);
  result.differs =
      worst < kSmallestStep
          ? fmt::format(
                "They agree: even in the view with the largest ones the steps stay below one step "
                "of an 8-bit display ({:.4f}).",
                kSmallestStep)
          : fmt::format(
                "They differ: in the view with the largest ones the steps exceed one step of an "
                "8-bit display ({:.4f}).",
                kSmallestStep);
  return result;
}

}  // namespace plenolab
