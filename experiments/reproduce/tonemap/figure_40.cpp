// Figure 40: the border regions of key views in the Dunes, with and without border weights, and adjusted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/synthesis/provenance_maps.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"
#include "experiments/reproduce/tonemap/view_figure.h"

namespace plenolab {

ReproductionResult reproduce_border_regions(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "dunes";

/// An HDR view and the pixels whose surface lies outside the image of a key view that takes part.
struct BorderFrame {
  ReferenceFrame reference;
  Mask beyond;
};

BorderFrame border_frame(const Synthesizer& synthesizer, CameraPosition position, int threads) {
  SynthesisOptions options;
  options.threads = threads;
  options.record_provenance = true;
  NovelView<SceneReferred> view = synthesizer.synthesize(position, options);
  BorderFrame frame{{position, std::move(view.image), shown_disparity(view.provenance),
                     contributing_views(view.provenance)},
                    Mask(view.provenance.width(), view.provenance.height())};
  for (std::size_t n = 0; n < frame.beyond.size(); ++n)
    for (const Correspondence& c : view.provenance.pixels()[n])
      if (c.state == CorrespondenceState::kOutOfFrustum) frame.beyond.pixels()[n] = 1;
  return frame;
}

/// Views a tenth of a spacing from the corners of every cell, where one key view dominates and others take
/// over at its border.
std::vector<BorderFrame> views_near_key_views(Laboratory& laboratory) {
  static constexpr std::array<CameraPosition, 4> kOffsets{{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}}};
  std::vector<BorderFrame> frames;
  for (const CameraPosition& position : cell_positions(laboratory.grid(kScene), kOffsets))
    frames.push_back(border_frame(laboratory.synthesizer(kScene), position, laboratory.options().threads));
  return frames;
}

/// Difference of a mapping's luma from joint statistics, synthesised with the same weights: what the fits of
/// single key views add.
Plane<float> added_luma(MappingBench& bench, const Mapping& mapping, Mapping joint,
                        const ReferenceFrame& frame) {
  joint.border_weight = mapping.border_weight;
  const std::span<const ReferenceFrame> one(&frame, 1);
  return luma_difference(bench.frames(kScene, mapping, one).front(),
                         bench.frames(kScene, joint, one).front());
}

/// RMS step across the line where key views end; 0 without one.
double end_step(const Plane<float>& values, const BorderFrame& frame) {
  const Plane<float> weights = border_step_weights(values, frame.reference);
  const Mask& beyond = frame.beyond;
  double sum = 0;
  int steps = 0;
  for (int y = 0; y + 1 < beyond.height(); ++y)
    for (int x = 0; x + 1 < beyond.width(); ++x) {
      const bool ends = beyond.at(x, y) != beyond.at(x + 1, y) || beyond.at(x, y) != beyond.at(x, y + 1);
      if (!ends || !(weights.at(x, y) > 0)) continue;
      sum += static_cast<double>(weights.at(x, y));
      ++steps;
    }
  return steps > 0 ? std::sqrt(sum / steps) : 0;
}

/// One way to show the view, and its numbers there.
struct BorderView {
  std::string label;
  DisplayImage image;
  double step = 0;    ///< RMS luma, where key views end
  double region = 0;  ///< FrameInconsistency::border_region
};

BorderView border_view(MappingBench& bench, const Mapping& mapping, const Mapping& joint,
                       const BorderFrame& frame) {
  const std::span<const ReferenceFrame> one(&frame.reference, 1);
  return {mapping.label, bench.frames(kScene, mapping, one).front(),
          end_step(added_luma(bench, mapping, joint, frame.reference), frame),
          frame_inconsistencies(bench, kScene, mapping, with_one_fit(mapping), one).front().border_region};
}

/// The view whose border region naive mapping with border weights changes most.
std::size_t strongest_region(MappingBench& bench, const Mapping& naive,
                             const std::vector<BorderFrame>& frames) {
  std::vector<ReferenceFrame> references;
  for (const BorderFrame& frame : frames) references.push_back(frame.reference);
  const std::vector<double> regions =
      border_regions(frame_inconsistencies(bench, kScene, naive, with_one_fit(naive), references));
  return static_cast<std::size_t>(std::max_element(regions.begin(), regions.end()) - regions.begin());
}

/// The part of the view where border weights change most of what the naive mapping adds.
PixelBox part_that_weights_change(MappingBench& bench, const Mapping& naive, const Mapping& unweighted,
                                  const Mapping& joint, const ReferenceFrame& frame) {
  Plane<float> change = added_luma(bench, naive, joint, frame);
  const Plane<float> without = added_luma(bench, unweighted, joint, frame);
  for (std::size_t n = 0; n < change.size(); ++n) {
    const float difference = change.pixels()[n] - without.pixels()[n];
    change.pixels()[n] = difference * difference;
  }
  return densest_box(change, crop_size(change.width(), change.height()));
}

std::string outcome(const BorderView& naive, const BorderView& unweighted, const BorderView& adjusted) {
  const auto size = [](double value) { return std::abs(value) >= kSmallestStep ? "more than" : "less than"; };
  std::string text = fmt::format(
      "With border weights the border region is {} than the rest by {:.4f}, {} one step of an 8-bit display "
      "({:.4f}){}.",
      naive.region > 0 ? "brighter" : "darker", std::abs(naive.region), size(naive.region), kSmallestStep,
      naive.region > 0
          ? ", brighter as in the thesis"
          : "; in the thesis it is brighter, because the key view cut off there is the darker one");
  text += fmt::format(
      " Without them the step where key views end is {:.4f}, {} one of the display, and with them "
      "{:.4f}: {} in the thesis.",
      unweighted.step, size(unweighted.step), naive.step,
      unweighted.step > naive.step ? "they spread it, as" : "they do not lower it, unlike");
  text +=
      std::abs(adjusted.region) < std::abs(naive.region)
          ? fmt::format(" Key-view adjustment leaves {} of the difference of the region, as in the thesis.",
                        percent(std::abs(adjusted.region / naive.region)))
          : " Key-view adjustment does not lower the difference of the region, unlike in the thesis.";
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
  const std::vector<BorderFrame> frames = views_near_key_views(laboratory);
  const Mapping naive = mapping_for(bench, kScene, Shown::kReinhardNaive),
                joint = mapping_for(bench, kScene, Shown::kReinhardJoint);
  Mapping unweighted = naive;
  unweighted.label += ", no border weights";
  unweighted.border_weight = BorderWeight::kNone;
  const BorderFrame& chosen = frames[strongest_region(bench, naive, frames)];
  const ReferenceFrame& frame = chosen.reference;
  const std::array views{
      border_view(bench, naive, joint, chosen), border_view(bench, unweighted, joint, chosen),
      border_view(bench, mapping_for(bench, kScene, Shown::kReinhardAdjusted), joint, chosen)};
  ViewPictures pictures{.what = laboratory.scene(kScene).title,
                        .frame = &frame,
                        .mapped = {},
                        .maps = {visibility_at(laboratory, kScene, frame.position)},
                        .box = part_that_weights_change(bench, naive, unweighted, joint, frame),
                        .choice =
                            "Of the views a tenth of a spacing from the corners of every cell, the one whose "
                            "border region naive "
                            "mapping changes most; enlarged where border weights change most of that"};
  result.ours_shows =
      "In the view shown, step where key views end (RMS luma, beyond joint statistics), and mean luma of the "
      "border "
      "region, a tenth of the view, against the rest (beyond one fit for all key views):";
  for (const BorderView& view : views) {
    pictures.mapped.push_back({view.label, view.image});
    const Columns columns{{"scene", std::string(kScene)}, {"mapping", view.label}};
    result.rows.add({"border_region", view.region, "luma", columns});
    result.rows.add({"key_view_end_step", view.step, "luma", columns});
    result.ours_shows += fmt::format("{} {} {:.4f} and {:+.4f}", &view == &views.front() ? "" : ";",
                                     view.label, view.step, view.region);
  }
  result.ours_shows += ".";
  add_view(result, pictures);
  result.differs = outcome(views[0], views[1], views[2]);
  return result;
}

}  // namespace plenolab
