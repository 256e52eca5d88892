#include "experiments/mapped_frames.h"

#include <fmt/format.h>

#include <optional>

#include "analysis/timing.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/score.h"
#include "experiments/tonemap_consistency.h"
#include "metrics/consistency.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

Columns frame_columns(const MappedVideoFrame& frame, const std::string& file, double fps) {
  return {{"frame", static_cast<long long>(frame.index)},
          {"file", file},
          {"s", frame.position.s},
          {"t", frame.position.t},
          {"time_s", static_cast<double>(frame.index) / fps}};
}

/// Everything about one frame, for frames.csv.
void add_frame_rows(ResultTable& table, const MappedVideoFrame& frame, const Columns& columns) {
  table.add({"mean_luma", mean_luma(frame.image), "luma", columns});
  add_fit_rows(table, frame.fit.values, frame.fit.notes, columns);
  add_count_rows(table, frame.counts, columns);
  table.add({"unseen_pixels", static_cast<double>(frame.unseen_pixels), "px", columns});
  table.add({"seconds_synthesis", frame.seconds_synthesis, "s", columns});
  table.add({"seconds_postprocess", frame.seconds_postprocess, "s", columns});
}

/// What the three stages took, and what is the same for all frames.
class StageTimes {
 public:
  void add(const MappedVideoFrame& frame) {
    prepare_s_ += frame.seconds_prepare;
    synthesis_s_.push_back(frame.seconds_synthesis);
    postprocess_s_.push_back(frame.seconds_postprocess);
  }

  ResultTable rows(const VideoPreprocessing& preprocessing, const ViewGrid& grid,
                   const Columns& columns) const {
    ResultTable table;
    add_fit_rows(table, preprocessing.fit.values, preprocessing.fit.notes, columns);
    if (preprocessing.key_views) table.append(rows_of(*preprocessing.key_views, grid, columns));
    const double synthesis = summarise_times(synthesis_s_).median_s;
    const double postprocess = summarise_times(postprocess_s_).median_s;
    table.add({"seconds_preprocess", preprocessing.seconds + prepare_s_, "s", columns});
    table.add({"seconds_synthesis_median", synthesis, "s", columns});
    table.add({"seconds_postprocess_median", postprocess, "s", columns});
    table.add({"frames_per_second", 1 / (synthesis + postprocess), "1/s", columns});
    return table;
  }

 private:
  double prepare_s_ = 0;  ///< of key views for synthesis, once each where the memory bound allows
  std::vector<double> synthesis_s_, postprocess_s_;
};

/// Judges mapped frames by the HDR frames at their positions.
class FrameJudge {
 public:
  FrameJudge(const LightField& field, const SynthesisOptions& synthesis)
      : synthesizer_(field),
        synthesis_(synthesis),
        meter_(field.grid(), synthesis, {.threads = synthesis.threads}) {}

  void add(ResultTable& rows, const MappedVideoFrame& frame, const Columns& columns) {
    add_consistency_rows(
        rows, meter_.add(reference_frame(synthesizer_, frame.position, synthesis_), frame.image), columns);
  }

  ResultTable summary(const Columns& columns) const { return meter_.summary(columns); }

 private:
  Synthesizer synthesizer_;
  SynthesisOptions synthesis_;
  ConsistencyMeter meter_;
};

}  // namespace

ResultTable write_mapped_frames(const LightField& field, const std::vector<CameraPosition>& positions,
                                const MappedVideoOptions& mapping, bool consistency, const fs::path& folder) {
  ResultTable frames;
  StageTimes times;
  std::optional<FrameJudge> judge;
  if (consistency) judge.emplace(field, mapping.synthesis);
  ProgressBar bar("synthesising and mapping");
  const fs::path scratch = folder / "key-views";
  fs::create_directory(scratch);
  const auto receive = [&](const MappedVideoFrame& frame) {
    const std::string file = fmt::format("frame_{:04}.png", frame.index);
    write_display_image(folder / file, frame.image);
    const Columns columns = frame_columns(frame, file, mapping.frames_per_second);
    add_frame_rows(frames, frame, columns);
    if (judge) judge->add(frames, frame, columns);
    times.add(frame);
    bar.update(static_cast<double>(frame.index + 1) / static_cast<double>(positions.size()));
  };
  const VideoPreprocessing preprocessing = make_mapped_video(field, positions, mapping, scratch, receive);
  fs::remove_all(scratch);
  write_text_file(folder / "frames.csv", to_csv(frames));
  const OperatorChoice& choice = mapping.mapping.choice;
  const Columns columns{{"operator", choice.info->id}, {"variant", choice.variant_name()}};
  ResultTable table = times.rows(preprocessing, field.grid(), columns);
  if (judge) table.append(judge->summary(columns));
  return table;
}

}  // namespace plenolab
