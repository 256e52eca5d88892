#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/parallel.h"
#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/reproduce/claims/geometry_occluders.h"
#include "experiments/reproduce/claims/geometry_restored.h"
#include "experiments/reproduce/figure_places.h"
#include "experiments/reproduce/figure_tools.h"
#include "experiments/score.h"
#include "metrics/error_map.h"

namespace plenolab {

ReproductionResult reproduce_claim_g6(Laboratory& laboratory);

namespace {

// Restoration looks right where it is no worse than the rest of the same views, and wrong where it is worse.
constexpr double kAsTheRest = 1;

// Cells of a scene at whose centres it is judged, spread over the grid.
constexpr std::size_t kJudgedCells = 8, kJudgedCellsTiny = 2;

constexpr int kPlacements = 12;  // of each concave kind
constexpr std::uint64_t kPurpose = 0x4736;

/// What restoration was measured on: a scene or a set of probes.
struct Subject {
  std::string name;   ///< of scene or probes, for rows
  std::string title;  ///< for people
  std::string unit;   ///< what is drawn together, plural
  std::vector<RestorationErrors> units;
  std::optional<Interval> ratio;
};

std::vector<CameraPosition> judged_cells(const ViewGrid& grid, Effort effort) {
  const std::vector<CameraPosition> centres = cell_positions(grid, offsets_inside_cells().first(1));
  const std::size_t count =
      std::min(centres.size(), effort == Effort::kTiny ? kJudgedCellsTiny : kJudgedCells);
  std::vector<CameraPosition> chosen;
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(centres[(2 * i + 1) * centres.size() / (2 * count)]);
  return chosen;
}

void show(ReproductionResult& result, const Subject& subject, const NovelView<SceneReferred>& novel,
          const SceneImage& truth) {
  const float exposure = figure_exposure(truth);  // for looking; errors are taken at that of the metrics
  ComparisonConditions conditions;
  conditions.exposure = exposure;
  result.add_comparison(
      subject.name,
      {fmt::format("{} from ({:.2f}, {:.2f}), the first of the views judged; {} px are restored, red in the "
                   "visibility map",
                   subject.title, novel.position.s, novel.position.t, novel.restored_pixels),
       fmt::format("Truth, synthesised view, difference and visibility map of {}", subject.title),
       {{"Ground truth", expose(truth, exposure)},
        {"Synthesised", expose(novel.image, exposure)},
        {"Difference", error_map(novel.image, truth, conditions)},
        {"Visibility", visibility_map(novel)}}},
      {truth, novel.image});
}

Subject measure_scene(Laboratory& laboratory, const std::string& id, ReproductionResult& result) {
  Subject subject{.name = id, .title = laboratory.scene(id).title, .unit = "views", .units = {}, .ratio = {}};
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  options.record_provenance = true;
  for (const CameraPosition position : judged_cells(laboratory.grid(id), laboratory.options().effort)) {
    const auto novel = laboratory.synthesizer(id).synthesize(position, options);
    const KeyView<SceneReferred> truth = laboratory.truth(id, position);
    const float exposure = exposure_from(truth.colour);
    if (subject.units.empty()) show(result, subject, novel, truth.colour);
    subject.units.push_back(restoration_errors(novel, truth, exposure));
  }
  subject.ratio = restored_over_rest(subject.units, laboratory.options().seed);
  return subject;
}

/// One placement, from all positions.
RestorationErrors judge_probe(const OccluderPlacement& placement, Patterned patterned, std::uint64_t seed) {
  const FlatWorld world = world_of(placement, patterned);
  const Synthesizer synthesizer(flat_light_field(world, occluder_grid(), "restoration probe", 1));
  SynthesisOptions options;
  options.threads = 1;
  options.record_provenance = true;
  RestorationErrors errors;
  for (const CameraPosition position : positions_in_cell(seed))
    errors += restoration_errors(synthesizer.synthesize(position, options),
                                 flat_view(world, occluder_grid(), position, 1), 1);
  return errors;
}

/// Patterned concave occluders, which leave background unseen, before the same background with or without
/// pattern.
Subject measure_probes(const Laboratory& laboratory, Patterned patterned) {
  const bool structured = patterned == Patterned::kEverything;
  const std::string background = structured ? "structured" : "uniform";
  Subject subject{.name = "probes, " + background + " background",
                  .title = fmt::format("probes with a {} background", background),
                  .unit = "placements",
                  .units = {},
                  .ratio = {}};
  const auto kinds = concave_shapes();
  const auto count = static_cast<std::size_t>(placements_per_kind(laboratory, kPlacements));
  subject.units.resize(count * kinds.size());
  parallel_for(static_cast<int>(subject.units.size()), 1, laboratory.options().threads,
               [&](int begin, int end) {
                 for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
                   RandomStream random(laboratory.options().seed, kPurpose, i);
                   const OccluderPlacement placement = place_inside(kinds[i / count], random);
                   subject.units[i] = judge_probe(placement, patterned, random.next_u64());
                 }
               });
  subject.ratio = restored_over_rest(subject.units, laboratory.options().seed);
  return subject;
}

void add_rows(ResultTable& rows, const Subject& subject) {
  const RestorationErrors errors = pooled(subject.units);
  const auto add = [&](const char* region, const ErrorSum& sum) {
    const Columns columns{{"scene", subject.name}, {"region", std::string(region)}};
    rows.add({"rms_error", sum.rms(), "1", columns});
    rows.add({"pixels", sum.pixels, "px", columns});
  };
  add("restored, truly background", errors.background);
  add("restored, truly nearer", errors.foreground);
  add("rest", errors.rest);
}

Verdict decide(const Subject& subject, Comparison comparison) {
  const auto used = std::count_if(subject.units.begin(), subject.units.end(),
                                  [](const RestorationErrors& u) { return u.background.pixels > 0; });
  if (!subject.ratio)
    return undecidable(
        fmt::format("Background was restored in {} of {} {} of {}: too few, or the rest shows no error.",
                    used, subject.units.size(), subject.unit, subject.title));
  Verdict verdict = decide_claim(*subject.ratio, comparison, kAsTheRest, "restored_error_over_rest", "1",
                                 uncertainty_over(static_cast<std::size_t>(used), subject.unit));
  verdict.scenes = {subject.name};
  verdict.explanation = fmt::format(
      "RMS error of encoded values in restored pixels of {} where the true view shows background too (a "
      "surface not more than 1 px of disparity nearer than what was restored), divided by that of all pixels "
      "that were not restored, in the same views: {}. Below 1 restored background is no worse than the rest. "
      "Restored pixels where the true view shows something nearer are structures lost by rule 2 and belong "
      "to A-G3.",
      subject.title, interval_text(*subject.ratio));
  if (verdict.outcome == Outcome::kUndecided)
    verdict.explanation +=
        " The interval holds 1: from these views restored background can be told neither worse nor better "
        "than the rest.";
  return verdict;
}

std::string words_of(const Subject& subject) {
  if (!subject.ratio) return fmt::format("in {} too little background is restored to tell", subject.title);
  return fmt::format("in {} the error of {:.0f} px of restored background is {} times that of the rest",
                     subject.title, pooled(subject.units).background.pixels, interval_text(*subject.ratio));
}

ReportPlot ratio_plot(std::span<const Subject* const> subjects, std::string alt) {
  Plot plot;
  plot.y = {.title = "RMS error, restored background over rest", .unit = "1", .minimum = 0, .maximum = {}};
  plot.key = KeyPosition::kNone;
  plot.series = {{.title = "ratio", .points = {}}};
  for (const Subject* subject : subjects) {
    if (!subject->ratio) continue;
    plot.categories.push_back(subject->title);
    plot.series[0].points.push_back({.y = subject->ratio->estimate,
                                     .y_low = subject->ratio->low,
                                     .y_high = subject->ratio->high,
                                     .label = {}});
  }
  return {plot,
          "Error of restored background as a multiple of the error of the rest of the same views; 95 % "
          "bootstrap intervals over views (scenes) and placements (probes)",
          std::move(alt)};
}

struct Subjects {
  Subject tree, cellar, uniform, structured;
  std::array<const Subject*, 4> all() const { return {&tree, &cellar, &uniform, &structured}; }
};

void conclude_all(ReproductionResult& result, const Subjects& s) {
  const auto file = [&](const char* id, const char* figure, const char* statement, const Subject& subject,
                        Comparison comparison) {
    conclude(result, {id, fmt::format("Altmeier 2018, section 6.1.1, {}", figure), statement},
             decide(subject, comparison));
  };
  file("A-G6a", "figure 32", "Restored background looks right before the sky of the Tree.", s.tree,
       Comparison::kBelow);
  file("A-G6b", "figure 31", "Restored background does not look right before the walls of the Cellar.",
       s.cellar, Comparison::kAbove);
  file("A-G6c", "figure 32", "Restored background looks right before a uniform background (probes).",
       s.uniform, Comparison::kBelow);
  file("A-G6d", "figure 31",
       "Restored background does not look right before a structured background (probes).", s.structured,
       Comparison::kAbove);
}

}  // namespace

ReproductionResult reproduce_claim_g6(Laboratory& laboratory) {
  ReproductionResult result;
  const Subjects subjects{.tree = measure_scene(laboratory, "tree", result),
                          .cellar = measure_scene(laboratory, "cellar", result),
                          .uniform = measure_probes(laboratory, Patterned::kOccluders),
                          .structured = measure_probes(laboratory, Patterned::kEverything)};
  for (const Subject* subject : subjects.all()) add_rows(result.rows, *subject);
  result.paper_shows =
      "Filling unseen background from the pixels beside it looks free of artefacts before the sky of the "
      "Tree (figure 32) and shows artefacts before the walls of the Cellar (figure 31).";
  result.ours_shows = fmt::format(
      "Of the scenes, {}, and {}. Of probes that differ in nothing but the background, {}, and {}.",
      words_of(subjects.tree), words_of(subjects.cellar), words_of(subjects.uniform),
      words_of(subjects.structured));
  const ErrorSum tree = pooled(subjects.tree.units).foreground,
                 cellar = pooled(subjects.cellar.units).foreground;
  result.differs = fmt::format(
      "In the scenes the rest of the view has errors of its own (noise, edges, appearance) that restored "
      "pixels are measured against; in the probes it has hardly any. In {:.0f} restored pixels of Tree and "
      "{:.0f} of Cellar the true view shows no background but a structure too thin to be found (RMS error {} "
      "and {}); they do not count here.",
      tree.pixels, cellar.pixels, format_number(tree.rms(), 3), format_number(cellar.rms(), 3));
  const auto all = subjects.all();
  if (std::any_of(all.begin(), all.end(), [](const Subject* s) { return s->ratio.has_value(); }))
    result.add_plot("restored-over-rest", ratio_plot(all, result.ours_shows));
  conclude_all(result, subjects);
  return result;
}

}  // namespace plenolab
