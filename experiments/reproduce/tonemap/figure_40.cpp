// Figure 40: the border regions of key views in the Dunes, with and without border weights, and adjusted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"
#include "experiments/reproduce/tonemap/view_figure.h"

namespace plenolab {

ReproductionResult reproduce_border_regions(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "dunes";

/// HDR views a tenth of a spacing from the corners of every cell, where one key view dominates and others
/// fill in at its border.
std::vector<ReferenceFrame> views_near_key_views(Laboratory& laboratory) {
  static constexpr std::array<CameraPosition, 4> kOffsets{{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}}};
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  std::vector<ReferenceFrame> frames;
  for (const CameraPosition& position : cell_positions(laboratory.grid(kScene), kOffsets))
    frames.push_back(reference_frame(laboratory.synthesizer(kScene), position, options));
  return frames;
}

/// One way to show the view, and its numbers there.
struct BorderView {
  std::string label;
  DisplayImage image;
  FrameInconsistency numbers;
};

BorderView border_view(MappingBench& bench, const Mapping& mapping, const ReferenceFrame& frame) {
  const std::span<const ReferenceFrame> one(&frame, 1);
  return {mapping.label, bench.frames(kScene, mapping, one).front(),
          frame_inconsistencies(bench, kScene, mapping, with_one_fit(mapping), one).front()};
}

std::string words_of(const BorderView& view) {
  return fmt::format("{}: border region {:+.4f} against the rest, steps across borders of visibility {:.4f}",
                     view.label, view.numbers.border_region, view.numbers.border_step);
}

std::string outcome(const BorderView& naive, const BorderView& unweighted, const BorderView& adjusted) {
  const auto region = [](const BorderView& view) { return std::abs(view.numbers.border_region); };
  std::string text = fmt::format(
      "{} the naive variant's border region differs from the rest by {} one step of an 8-bit display "
      "({:.4f}).",
      region(naive) >= kSmallestStep ? "They agree:" : "They differ in size:",
      region(naive) >= kSmallestStep ? "more than" : "less than", kSmallestStep);
  text += unweighted.numbers.border_step > naive.numbers.border_step
              ? fmt::format(
                    " Without border weights the steps grow to {:.1f} times theirs, a sharp border as in the "
                    "thesis.",
                    unweighted.numbers.border_step / std::max(naive.numbers.border_step, 1e-6))
              : " Without border weights the steps do not grow, unlike in the thesis.";
  text +=
      region(adjusted) < region(naive)
          ? fmt::format(" Key-view adjustment leaves {} of the difference of the border region.",
                        percent(region(adjusted) / region(naive)))
          : " Key-view adjustment does not lower the difference of the border region, unlike in the thesis.";
  return text;
}

}  // namespace

ReproductionResult reproduce_border_regions(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 40: where key views of the Dunes are mapped one by one, novel views are brighter in the border "
      "region "
      "because other key views take over there; without border weights a sharp border shows instead; "
      "key-view "
      "adjustment removes both.";
  MappingBench& bench = laboratory.mapping_bench();
  const std::vector<ReferenceFrame> frames = views_near_key_views(laboratory);
  const Mapping naive = mapping_for(bench, kScene, Shown::kReinhardNaive);
  Mapping unweighted = naive, joint = mapping_for(bench, kScene, Shown::kReinhardJoint);
  unweighted.label += ", no border weights";
  unweighted.border_weight = joint.border_weight = BorderWeight::kNone;
  const StepPlace place =
      largest_steps(frames, bench.frames(kScene, unweighted, frames), bench.frames(kScene, joint, frames));
  const ReferenceFrame& frame = frames[place.index];
  const std::array views{border_view(bench, naive, frame), border_view(bench, unweighted, frame),
                         border_view(bench, mapping_for(bench, kScene, Shown::kReinhardAdjusted), frame)};
  ViewPictures pictures{
      .what = laboratory.scene(kScene).title,
      .frame = &frame,
      .mapped = {},
      .maps = {visibility_at(laboratory, kScene, frame.position)},
      .box = place.box,
      .choice =
          "Of the views a tenth of a spacing from the corners of every cell, the one with the "
          "largest steps without border weights"};
  result.ours_shows = "Luma beyond that of one fit for all key views, in the view shown.";
  for (const BorderView& view : views) {
    pictures.mapped.push_back({view.label, view.image});
    const Columns columns{{"scene", std::string(kScene)}, {"mapping", view.label}};
    result.rows.add({"border_region", view.numbers.border_region, "luma", columns});
    result.rows.add({"border_step", view.numbers.border_step, "luma", columns});
    result.ours_shows += " " + words_of(view) + ".";
  }
  add_view(result, pictures);
  result.differs = outcome(views[0], views[1], views[2]);
  return result;
}

}  // namespace plenolab
