#include "experiments/tonemap_consistency.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/synthesis/provenance_maps.h"

namespace plenolab {

namespace {

/// Takes `added` over `added_pairs` into a mean over `pairs`.
void take_mean(double& mean, std::int64_t pairs, double added, std::int64_t added_pairs) {
  const auto all = static_cast<double>(pairs + added_pairs);
  if (all > 0) mean += (added - mean) * static_cast<double>(added_pairs) / all;
}

BorderChange pooled(BorderChange a, const BorderChange& b) {
  take_mean(a.luma_border, a.border_pairs, b.luma_border, b.border_pairs);
  take_mean(a.log_border, a.border_pairs, b.log_border, b.border_pairs);
  take_mean(a.luma_inside, a.inside_pairs, b.luma_inside, b.inside_pairs);
  take_mean(a.log_inside, a.inside_pairs, b.log_inside, b.inside_pairs);
  a.border_pairs += b.border_pairs;
  a.inside_pairs += b.inside_pairs;
  return a;
}

}  // namespace

ReferenceFrame reference_frame(const Synthesizer& synthesizer, CameraPosition position,
                               SynthesisOptions options) {
  options.record_provenance = true;
  NovelView<SceneReferred> view = synthesizer.synthesize(position, options);
  return {position, std::move(view.image), shown_disparity(view.provenance),
          contributing_views(view.provenance)};
}

ConsistencyMeter::ConsistencyMeter(const ViewGrid& grid, const SynthesisOptions& synthesis,
                                   ConsistencyOptions options)
    : vertical_ratio_(grid.vertical_ratio()),
      screen_px_(synthesis.camera == CameraKind::kFixedScreen ? grid.disparity_px(synthesis.screen_depth_m)
                                                              : 0),
      options_(options) {
  options_.validate();
}

FrameConsistency ConsistencyMeter::add(ReferenceFrame reference, const DisplayImage& mapped) {
  const ConsistencyView view{mapped, reference.hdr, reference.disparity_px};
  FrameConsistency frame{.change = {},
                         .borders = change_across_borders(view, reference.contributors, options_)};
  borders_ = pooled(borders_, frame.borders);
  append_frame(track_, mapped, reference.hdr);
  if (previous_) {
    const CameraPosition from = previous_->reference.position, to = reference.position;
    const ViewMotion motion{to.s - from.s, (to.t - from.t) * vertical_ratio_, screen_px_};
    frame.change =
        change_along_lines({previous_->mapped, previous_->reference.hdr, previous_->reference.disparity_px},
                           view, motion, options_);
    line_pixels_ += frame.change->pixels;
    squared_change_ += frame.change->rms * frame.change->rms * static_cast<double>(frame.change->pixels);
    if (frame.change->share >= kEnoughOfAFrame)
      largest_change_ = std::max(largest_change_, std::abs(frame.change->mean));
  }
  previous_ = Previous{std::move(reference), mapped};
  return frame;
}

ResultTable ConsistencyMeter::summary(const Columns& columns) const {
  ResultTable table;
  if (line_pixels_ > 0) {
    table.add(
        {"line_change_rms", std::sqrt(squared_change_ / static_cast<double>(line_pixels_)), "luma", columns});
    table.add({"frame_change_max", largest_change_, "luma", columns});
    table.add({"line_pixels", static_cast<double>(line_pixels_), "px", columns});
  }
  if (const std::optional<double> excess = borders_.excess())
    table.add({"border_excess", *excess, "1", columns});
  table.add({"border_pairs", static_cast<double>(borders_.border_pairs), "px", columns});
  if (track_.mean_luma.empty()) return table;
  const auto [darkest, brightest] = std::minmax_element(track_.mean_luma.begin(), track_.mean_luma.end());
  table.add({"motion_luma_min", *darkest, "luma", columns});
  table.add({"motion_luma_max", *brightest, "luma", columns});
  table.add({"motion_luma_step_max", track_.largest_luma_step(), "luma", columns});
  table.add({"motion_log_luminance_step_max", track_.largest_log_step(), "log10", columns});
  if (const std::optional<double> agreement = track_.agreement())
    table.add({"adaptation_agreement", *agreement, "1", columns});
  return table;
}

void add_consistency_rows(ResultTable& table, const FrameConsistency& frame, const Columns& columns) {
  if (frame.change && frame.change->pixels > 0) {
    table.add({"line_change_mean", frame.change->mean, "luma", columns});
    table.add({"line_change_rms", frame.change->rms, "luma", columns});
    table.add({"line_share", frame.change->share, "1", columns});
  }
  if (const std::optional<double> excess = frame.borders.excess())
    table.add({"border_excess", *excess, "1", columns});
}

}  // namespace plenolab
