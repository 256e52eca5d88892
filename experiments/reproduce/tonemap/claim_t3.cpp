// A-T3, thesis section 5.1.4: histogram adjustment is consistent between neighbouring bright views; in dark
// scenes the number of trimming passes differs between views and shows; a fixed number restores consistency.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "experiments/reproduce/claims/claim_statistics.h"
#include "experiments/reproduce/tonemap/trimming_study.h"

namespace plenolab {

ReproductionResult reproduce_claim_t3(Laboratory& laboratory);

namespace {

constexpr std::array kBrightScenes{"dunes", "tree"};
constexpr std::array kDarkScenes{"cellar", "boats"};
/// The same scenes as dark as by night: passes are counted at this share of their light, too.
constexpr double kDarker = 0.01;
// Consistent: the change of luma that the curves add between neighbours is on average below one that is just
// visible (visible_luma_change), in the bright scene where it is larger. "Differs between views and shows":
// more than one pair in twenty has different numbers of passes that add a change above that; a claim about
// what users notice does not rest on rarer ones. "Restores": the change falls, any fall counts. These were
// chosen before the first run. After it, the second was made stricter: a change counts as shown only as far
// as it vanishes with equal numbers of passes (as printed, views end linear, and their change has another
// cause).
constexpr double kOften = 0.05;
constexpr double kNoFall = 1;

std::vector<const CeilingStudy*> select(const std::vector<CeilingStudy>& studies, HistogramCeiling ceiling,
                                        bool dark) {
  std::vector<const CeilingStudy*> selected;
  for (const CeilingStudy& study : studies)
    if (study.automatic.ceiling == ceiling && study.dark == dark) selected.push_back(&study);
  return selected;
}

std::vector<double> added_changes(const TrimmingConsistency& run) {
  std::vector<double> changes;
  for (const NeighbourChange& pair : run.pairs) changes.push_back(pair.added());
  return changes;
}

/// Of pairs that both runs of the scenes have, in order.
struct PairedSquares {
  std::vector<double> automatic, fixed;
};

PairedSquares paired_squares(const std::vector<const CeilingStudy*>& studies) {
  PairedSquares squares;
  for (const CeilingStudy* study : studies)
    for (std::size_t i = 0; i < study->automatic.pairs.size(); ++i) {
      squares.automatic.push_back(std::pow(study->automatic.pairs[i].added(), 2));
      squares.fixed.push_back(std::pow(study->fixed.pairs[i].added(), 2));
    }
  return squares;
}

std::vector<std::string> ids_of(const std::vector<const CeilingStudy*>& studies) {
  std::vector<std::string> ids;
  for (const CeilingStudy* study : studies) ids.push_back(study->automatic.scene);
  return ids;
}

/// "A-T3b", or "A-T3b-printed" under the thesis' formula.
Claim claim_of(const char* id, HistogramCeiling ceiling, std::string statement) {
  const bool printed = ceiling == HistogramCeiling::kAsPrinted;
  if (printed) statement += " (Ceiling as printed.)";
  return {id + std::string(printed ? "-printed" : ""), "Altmeier 2018, section 5.1.4", std::move(statement)};
}

LedgerEntry bright_entry(const std::vector<CeilingStudy>& studies, HistogramCeiling ceiling,
                         std::uint64_t seed) {
  LedgerEntry entry{claim_of("A-T3a", ceiling,
                             "In bright scenes histogram adjustment is consistent between neighbouring key "
                             "views."),
                    undecidable("Too few neighbouring key views with corresponding pixels.")};
  const auto bright = select(studies, ceiling, false);
  const CeilingStudy& worst =
      **std::max_element(bright.begin(), bright.end(), [](const CeilingStudy* a, const CeilingStudy* b) {
        return a->automatic.mean_added() < b->automatic.mean_added();
      });
  const auto interval = mean_interval(added_changes(worst.automatic), seed);
  if (!interval) return entry;
  entry.verdict = decide_claim(*interval, Comparison::kBelow, visible_luma_change(), "mean_added_luma_change",
                               "luma", uncertainty_over(worst.automatic.pairs.size(), "pairs of key views"));
  entry.verdict.scenes = ids_of(bright);
  entry.verdict.explanation = fmt::format(
      "RMS change of luma between corresponding pixels of neighbouring key views that their different curves "
      "add, mean of {} pairs of {}, the bright scene where it is larger (largest pair {:.4f}), against a "
      "change "
      "that is just visible at luma 0.5 on a display of 300 cd/m².",
      worst.automatic.pairs.size(), worst.automatic.title, worst.automatic.largest_added());
  return entry;
}

/// The fewest pairs of which none may show a change for the interval to lie below a share.
std::size_t pairs_to_exclude(double share) {
  std::size_t pairs = 1;
  while (share_interval(0, pairs).high > share) ++pairs;
  return pairs;
}

LedgerEntry dark_entry(const std::vector<CeilingStudy>& studies, HistogramCeiling ceiling) {
  LedgerEntry entry{claim_of("A-T3b", ceiling,
                             "In dark scenes the number of trimming passes differs between neighbouring key "
                             "views, and it shows."),
                    undecidable("No neighbouring key views with corresponding pixels.")};
  const auto dark = select(studies, ceiling, true);
  std::size_t pairs = 0, different = 0, shown = 0;
  std::string passes;
  for (const CeilingStudy* study : dark) {
    pairs += study->automatic.neighbours;
    different += study->automatic.different.size();
    shown += count_shown(study->automatic);
    passes += fmt::format("{}{} in {}", passes.empty() ? "" : ", ", passes_text(study->automatic),
                          study->automatic.title);
  }
  if (pairs == 0) return entry;
  entry.verdict = decide_claim(share_interval(shown, pairs), Comparison::kAbove, kOften,
                               "visibly_different_pairs_share", "1", "95 % Wilson interval");
  entry.verdict.scenes = ids_of(dark);
  entry.verdict.explanation = fmt::format(
      "{} of {} pairs of neighbouring key views have different numbers of passes ({}); in {} of them that "
      "adds a "
      "change of luma above {:.4f}, which is just visible. The test that the "
      "change vanishes with equal numbers was added after a first run.",
      different, pairs, passes, shown, visible_luma_change());
  if (shown == 0 && share_interval(0, pairs).high > kOften)
    entry.verdict.explanation +=
        fmt::format(" None of {} pairs shows it, but {} would be needed to exclude a share of {}.", pairs,
                    pairs_to_exclude(kOften), kOften);
  return entry;
}

LedgerEntry fixed_entry(const std::vector<CeilingStudy>& studies, HistogramCeiling ceiling,
                        std::uint64_t seed) {
  LedgerEntry entry{
      claim_of("A-T3c", ceiling, "In dark scenes a fixed number of trimming passes restores consistency."),
      undecidable("No change between neighbouring key views that could fall.")};
  const auto dark = select(studies, ceiling, true);
  const PairedSquares squares = paired_squares(dark);
  const auto ratio = [&](std::span<const double> drawn) {
    double fixed = 0, automatic = 0;
    for (const double index : drawn) {
      fixed += squares.fixed[static_cast<std::size_t>(index)];
      automatic += squares.automatic[static_cast<std::size_t>(index)];
    }
    return automatic > 0 ? std::sqrt(fixed / automatic) : kNoFall;
  };
  if (squares.automatic.size() < 2 || mean(squares.automatic) == 0) return entry;
  const double automatic_rms = std::sqrt(mean(squares.automatic));
  entry.verdict = decide_claim(bootstrap_units(squares.automatic.size(), ratio, seed), Comparison::kBelow,
                               kNoFall, "rms_change_fixed_over_automatic", "1",
                               uncertainty_over(squares.automatic.size(), "pairs of key views"));
  entry.verdict.scenes = ids_of(dark);
  entry.verdict.explanation = fmt::format(
      "RMS over {} pairs of the change of luma that the curves add, with {} passes over that with the "
      "automatic "
      "number: {:.4f} against {:.4f}{}.",
      squares.automatic.size(), kFixedPasses, std::sqrt(mean(squares.fixed)), automatic_rms,
      automatic_rms < visible_luma_change() ? ", which is not visible: nothing is to be restored" : "");
  return entry;
}

void describe_ours(ReproductionResult& result, const std::vector<CeilingStudy>& studies) {
  for (const CeilingStudy& study : studies) {
    const TrimmingConsistency& run = study.automatic;
    const std::string linear =
        run.linear_views > 0 ? fmt::format(" ({} of {} views linear)", run.linear_views, run.passes.size())
                             : "";
    result.ours_shows += fmt::format(
        "{}, ceiling {}: {} passes{}, mean change between neighbours {:.4f}, with {} passes {:.4f}. ",
        run.title, name_of(run.ceiling), passes_text(run), linear, run.mean_added(), kFixedPasses,
        study.fixed.mean_added());
  }
  result.ours_shows += fmt::format("A change of {:.4f} is just visible.", visible_luma_change());
}

/// "Dunes (6 of 38 pairs, …)" of the scenes whose numbers of passes differ, with the corrected ceiling.
std::string scenes_with_different_passes(const std::vector<CeilingStudy>& studies, bool dark) {
  std::string text;
  for (const CeilingStudy* study : select(studies, HistogramCeiling::kPerceptual, dark)) {
    const TrimmingConsistency& run = study->automatic;
    if (run.different.empty()) continue;
    text += fmt::format(
        "{}{} ({} of {} pairs of neighbours; {} fixed passes bring the mean change from "
        "{:.4f} to {:.4f})",
        text.empty() ? "" : ", ", run.title, run.different.size(), run.neighbours, kFixedPasses,
        run.mean_added(), study->fixed.mean_added());
  }
  return text;
}

bool all_linear(const std::vector<CeilingStudy>& studies, HistogramCeiling ceiling) {
  return std::all_of(studies.begin(), studies.end(), [&](const CeilingStudy& study) {
    return study.automatic.ceiling != ceiling ||
           study.automatic.linear_views == study.automatic.passes.size();
  });
}

std::string difference_text(const std::vector<CeilingStudy>& studies) {
  const std::string dark = scenes_with_different_passes(studies, true);
  const std::string bright = scenes_with_different_passes(studies, false);
  std::string text =
      dark.empty()
          ? "With the right ceiling the number of passes is the same in all key views of our dark scenes"
          : "With the right ceiling the number of passes differs in " + dark;
  text +=
      bright.empty() ? "; in the bright ones it does not differ." : "; it differs in bright " + bright + ".";
  if (all_linear(studies, HistogramCeiling::kAsPrinted))
    text +=
        " As printed, trimming goes on until next to nothing is left: all views of all scenes end linear, "
        "scaled by "
        "their "
        "own largest luminance, so that neither the automatic nor the fixed number of passes matters and the "
        "changes come from the brightest pixel.";
  for (const CeilingStudy* study : select(studies, HistogramCeiling::kPerceptual, false))
    if (study->automatic.mean_added() > 0.5 * visible_luma_change() &&
        study->spacing_m > study->paper_spacing_m)
      text += fmt::format(
          " {} is recorded with {:g} m between key views here and {:g} m in the thesis' grid, where "
          "neighbours "
          "share more and change less.",
          study->automatic.title, study->spacing_m, study->paper_spacing_m);
  return text;
}

/// Whether scenes that are darker in cd/m² bear out the thesis.
std::string darker_text(const std::vector<TrimmingConsistency>& darker) {
  std::string text;
  bool varies = false;
  for (const TrimmingConsistency& run : darker) {
    text += fmt::format("{}{}: {}{}", text.empty() ? "" : "; ", run.title, passes_text(run),
                        run.linear_views > 0 ? fmt::format(", {} views linear", run.linear_views) : "");
    varies |=
        std::adjacent_find(run.passes.begin(), run.passes.end(), std::not_equal_to<>()) != run.passes.end();
  }
  return fmt::format(
      " The ceiling depends on absolute luminance, and the thesis does not say how dark its Cellar is: with "
      "less "
      "light the numbers of passes {} ({}).",
      varies ? "do differ between our views" : "do not differ between our views either", text);
}

}  // namespace

ReproductionResult reproduce_claim_t3(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Section 5.1.4: differences between key views of bright scenes are small; in dark ones, such as "
      "Cellar, "
      "trimming ends after a few strong passes and differences between iterations are noticeable; a fixed "
      "number restores consistency. No numbers.";
  std::vector<CeilingStudy> studies;
  std::vector<TrimmingConsistency> counted, darker;
  const int threads = laboratory.options().threads;
  const auto add_scenes = [&](const auto& ids, bool dark) {
    for (const char* id : ids) {
      for (CeilingStudy& study : study_scene(laboratory, id, dark)) {
        counted.push_back(study.automatic);
        studies.push_back(std::move(study));
      }
      const ToneScene scene = tone_scene(laboratory, id);
      counted.push_back(count_trimming_passes(scene, {.ceiling = HistogramCeiling::kLinear}, threads));
      if (dark) darker.push_back(count_trimming_passes(scene, {.cd_m2_per_unit = kDarker}, threads));
    }
  };
  add_scenes(kDarkScenes, true);
  add_scenes(kBrightScenes, false);
  for (TrimmingConsistency& run : darker) {
    run.scene += "-darker";
    run.title += fmt::format(", light × {:g}", kDarker);
    counted.push_back(run);
  }
  for (const TrimmingConsistency& run : counted) add_run_rows(result.rows, run);
  for (const CeilingStudy& study : studies) add_run_rows(result.rows, study.fixed);
  const std::uint64_t seed = laboratory.options().seed;
  for (const HistogramCeiling ceiling : kCeilings) {
    result.ledger.push_back(bright_entry(studies, ceiling, seed));
    result.ledger.push_back(dark_entry(studies, ceiling));
    result.ledger.push_back(fixed_entry(studies, ceiling, seed));
  }
  add_ledger_rows(result.rows, result.ledger);
  describe_ours(result, studies);
  result.differs = difference_text(studies) + darker_text(darker);
  result.add_plot("added-change", change_plot(studies));
  result.add_table(passes_table(counted));
  result.add_table(change_table(studies));
  return result;
}

}  // namespace plenolab
