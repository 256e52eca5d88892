#include "experiments/reproduce/tonemap/motion_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/epi.h"
#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/cli/wide_table.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

namespace {

constexpr int kStretchRows = 5, kStretchColumns = 9;  // pixels a frame is drawn with

double position_of(const RecordedMotion& recording, std::size_t frame) {
  const CameraPosition& at = recording.frames[frame].position;
  return recording.motion.vertical() ? at.t : at.s;
}

DisplayImage mark_cut(DisplayImage image, const RecordedMotion& recording) {
  return recording.motion.vertical() ? mark_column(std::move(image), recording.epi_line)
                                     : mark_row(std::move(image), recording.epi_line);
}

/// Stretched along the frame axis, with green lines at the frames before and at the event.
DisplayImage finish_epi(const DisplayImage& epi, const RecordedMotion& recording) {
  const EpiDirection direction = recording.epi_direction();
  const int stretch = recording.motion.vertical() ? kStretchColumns : kStretchRows;
  DisplayImage image = stretch_epi(epi, direction, stretch);
  for (const std::size_t frame : {recording.event - 1, recording.event}) {
    const int line = static_cast<int>(frame) * stretch + stretch / 2;
    image = direction == EpiDirection::kRow ? mark_row(std::move(image), line)
                                            : mark_column(std::move(image), line);
  }
  return image;
}

SceneImage cut_of(const SceneImage& frame, const RecordedMotion& recording) {
  return recording.motion.vertical() ? crop(frame, {recording.epi_line, 0, 1, frame.height()})
                                     : crop(frame, {0, recording.epi_line, frame.width(), 1});
}

DisplayImage hdr_epi(const RecordedMotion& recording, float exposure) {
  std::vector<SceneImage> cuts;
  for (const ReferenceFrame& frame : recording.frames) cuts.push_back(cut_of(frame.hdr, recording));
  return expose(epi(std::span<const SceneImage>(cuts), recording.epi_direction(), 0), exposure);
}

void add_frames(ReproductionResult& result, const MotionStudy& study, bool event,
                const std::vector<ReportImage>& maps) {
  const RecordedMotion& recording = *study.recording;
  const std::size_t frame = event ? recording.event : recording.event - 1;
  const float exposure = figure_exposure(recording.frames[recording.event].hdr);
  const std::string what =
      fmt::format("{} from {}, the frame {} the largest change of peak luminance", study.title,
                  name_of(recording.frames[frame].position), event ? "after" : "before");
  ImageComparison shown{
      fmt::format("{}. Green: the {} of the epipolar images. {}", what,
                  recording.motion.vertical() ? "column" : "row", kShortLabels),
      what + ", tone mapped in several ways",
      {{"HDR, one exposure", mark_cut(expose(recording.frames[frame].hdr, exposure), recording)}}};
  for (const MotionShown& m : study.mappings)
    shown.images.push_back(
        {short_label(m.mapping.label), mark_cut(event ? m.motion->event : m.motion->before, recording)});
  for (const ReportImage& map : maps) shown.images.push_back({map.label, mark_cut(map.image, recording)});
  result.add_comparison(event ? "event" : "before", std::move(shown));
}

void add_epis(ReproductionResult& result, const MotionStudy& study, const std::vector<ReportImage>& maps) {
  const RecordedMotion& recording = *study.recording;
  const bool vertical = recording.motion.vertical();
  const std::string what =
      fmt::format("{}: {} {} of {} frames, camera moving from {} ({}) to {}", study.title,
                  vertical ? "column" : "row", recording.epi_line, recording.frames.size(),
                  name_of(recording.motion.from), vertical ? "left" : "top", name_of(recording.motion.to));
  const float exposure = figure_exposure(recording.frames[recording.event].hdr);
  ImageComparison shown{what + ". Green: the two frames shown above. " + kShortLabels,
                        what,
                        {{"HDR, one exposure", finish_epi(hdr_epi(recording, exposure), recording)}}};
  for (const MotionShown& m : study.mappings)
    shown.images.push_back({short_label(m.mapping.label), finish_epi(m.motion->epi, recording)});
  for (const ReportImage& map : maps) shown.images.push_back({map.label, finish_epi(map.image, recording)});
  result.add_comparison("epi", std::move(shown));
}

/// One line for each mapping; the frame of the event is ringed.
template <class Track>
ReportPlot track_plot(const MotionStudy& study, const std::string& y, const std::string& caption,
                      const Track& track) {
  const RecordedMotion& recording = *study.recording;
  Plot plot;
  plot.x = {.title = recording.motion.vertical() ? "Camera position t" : "Camera position s",
            .unit = recording.motion.vertical() ? "row spacings" : "column spacings",
            .minimum = {},
            .maximum = {}};
  plot.y = {.title = y, .unit = {}, .minimum = {}, .maximum = {}};
  plot.key = KeyPosition::kOutside;
  plot.marked_title = "peak luminance changes most";
  plot.width_px = 960;
  for (const MotionShown& m : study.mappings) {
    PlotSeries series{short_label(m.mapping.label), PlotSeries::Style::kLines, {}};
    const std::vector<double> values = track(*m.motion);
    for (std::size_t i = 0; i < values.size(); ++i)
      series.points.push_back({.x = position_of(recording, i),
                               .y = values[i],
                               .y_low = {},
                               .y_high = {},
                               .label = {},
                               .marked = i == recording.event});
    plot.series.push_back(std::move(series));
  }
  return {std::move(plot), fmt::format("{}: {}. {}", study.title, caption, kShortLabels),
          y + " over the camera position"};
}

void add_plots(ReproductionResult& result, const MotionStudy& study) {
  result.add_plot("mean-luma",
                  track_plot(study, "Mean luma", "mean luma of the frames over the camera position",
                             [](const MappedMotion& motion) { return motion.track.mean_luma; }));
  result.add_plot(
      "adaptation",
      track_plot(
          study, "Luma added since the first frame",
          "luma of surfaces whose light does not change, added up along epipolar lines: adaptation alone, "
          "whatever enters or leaves the view",
          [](const MappedMotion& motion) { return adaptation_track(motion); }));
}

void add_numbers(ReproductionResult& result, const MotionStudy& study) {
  ResultTable rows;
  for (const MotionShown& m : study.mappings) {
    rows.append(m.motion->summary);
    const Columns columns{{"scene", study.scene}, {"mapping", m.mapping.label}};
    rows.add({"adaptation_range", m.adaptation.range, "luma", columns});
    rows.add({"adaptation_step_max", m.adaptation.largest_step, "luma", columns});
    rows.add({"adaptation_change_max", m.adaptation.largest_change, "luma", columns});
    rows.add({"adaptation_frames", m.adaptation.duration_frames, "frames", columns});
    if (m.adaptation.share_before)
      rows.add({"adaptation_before_event", *m.adaptation.share_before, "1", columns});
  }
  ReportTable table = wide_table(
      rows, {"mapping"},
      {{"adaptation_range", "range"},
       {"adaptation_step_max", "step"},
       {"adaptation_frames", "frames"},
       {"adaptation_before_event", "before"},
       {"line_change_rms", "lines"},
       {"border_excess", "borders"}},
      fmt::format(
          "Consistency over {} frames, {} a spacing; variants without a name: Reinhard 2005. Luma of "
          "surfaces "
          "under the same light: its range, the largest step from frame to frame, the frames that the change "
          "around it would take at that rate, the share of changes within one spacing of the event that lies "
          "before it, and the RMS change along epipolar lines. Borders: steps at borders of visibility over "
          "those of the HDR frames",
          study.recording->frames.size(), frames_per_spacing(study.recording->motion)));
  for (std::vector<Cell>& row : table.rows) row[0] = short_label(std::get<std::string>(row[0]));
  table.digits = 3;
  result.add_table(std::move(table));
  result.rows.append(rows);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : "; ") + parts[i];
  return text;
}

}  // namespace

const MotionShown& MotionStudy::of(Shown shown) const {
  const auto found = std::find_if(mappings.begin(), mappings.end(),
                                  [shown](const MotionShown& m) { return m.shown == shown; });
  PLENOLAB_CHECK(found != mappings.end(), "a mapping of the study");
  return *found;
}

MotionStudy study_motion(MappingBench& bench, const std::string& scene, const std::vector<Shown>& shown) {
  MotionStudy study{scene, bench.laboratory().scene(scene).title, &bench.recording(scene), {}};
  for (const Shown one : shown) {
    Mapping mapping = mapping_for(bench, scene, one);
    const MappedMotion& motion = bench.motion(scene, mapping);
    study.mappings.push_back({one, std::move(mapping), &motion,
                              adaptation_of(adaptation_track(motion), study.recording->event,
                                            frames_per_spacing(study.recording->motion))});
  }
  return study;
}

void show_motion(ReproductionResult& result, const MotionStudy& study, const MotionMaps& maps) {
  add_frames(result, study, false, maps.before);
  add_frames(result, study, true, maps.event);
  add_epis(result, study, maps.epi);
  add_plots(result, study);
  add_numbers(result, study);
}

MotionMaps visibility_over(MappingBench& bench, const MotionStudy& study) {
  const RecordedMotion& recording = *study.recording;
  std::vector<CameraPosition> positions;
  for (const ReferenceFrame& frame : recording.frames) positions.push_back(frame.position);
  SynthesisOptions options;
  options.threads = bench.threads();
  MotionMaps maps;
  std::vector<DisplayImage> cuts;
  bench.laboratory()
      .synthesizer(study.scene)
      .synthesize_sequence(positions, options, [&](std::size_t i, NovelView<SceneReferred>&& view) {
        DisplayImage map = visibility_map(view);
        cuts.push_back(recording.motion.vertical() ? crop(map, {recording.epi_line, 0, 1, map.height()})
                                                   : crop(map, {0, recording.epi_line, map.width(), 1}));
        if (i + 1 == recording.event) maps.before.push_back({"Visibility", map});
        if (i == recording.event) maps.event.push_back({"Visibility", std::move(map)});
      });
  maps.epi.push_back({"Visibility", epi(std::span<const DisplayImage>(cuts), recording.epi_direction(), 0)});
  return maps;
}

std::string pace_words(const MotionStudy& study) {
  std::string text;
  const auto group = [&](Pace pace, const std::string& start) {
    std::vector<std::string> parts;
    for (const MotionShown& m : study.mappings)
      if (m.adaptation.pace == pace)
        parts.push_back(fmt::format("{} ({:.3f} in all, at most {:.4f} a frame, at {:.2f})",
                                    short_label(m.mapping.label), m.adaptation.range,
                                    m.adaptation.largest_step,
                                    position_of(*study.recording, m.adaptation.steepest)));
    if (!parts.empty()) text += fmt::format(" {}: {}.", start, joined(parts));
  };
  group(Pace::kAbrupt,
        "Abruptly (visibly from frame to frame, in less than half the way between two key views)");
  group(Pace::kGradual, "Gradually");
  group(Pace::kSteady, "By less than one step of an 8-bit display between two key views");
  return "Luma of surfaces under the same light changes as follows (variants without a name: Reinhard "
         "2005)." +
         text;
}

std::string event_words(const MotionStudy& study) {
  const RecordedMotion& recording = *study.recording;
  const double step =
      log_peak(recording.frames[recording.event].hdr) - log_peak(recording.frames[recording.event - 1].hdr);
  std::string text =
      fmt::format("The largest luminance of a frame changes most at {:.2f}, by {:+.2f} log10 units.",
                  position_of(recording, recording.event), step);
  const auto whole = [](double v) { return std::abs(v - std::round(v)) < 1e-6; };
  const CameraPosition& before = recording.frames[recording.event - 1].position;
  if (step < 0 && whole(before.s) && whole(before.t))
    text +=
        " The frame before it is a key view; frames between key views average what only one of them shows.";
  std::vector<std::string> parts;
  for (const MotionShown& m : study.mappings)
    if (m.adaptation.share_before)
      parts.push_back(
          fmt::format("{} {}", percent(*m.adaptation.share_before), short_label(m.mapping.label)));
  if (!parts.empty())
    text += fmt::format(" Of all changes within one spacing of that event, those ahead of it are: {}.",
                        joined(parts));
  return text;
}

std::string comparison_words(const MotionStudy& study, const std::vector<ExpectedPace>& expected) {
  std::vector<std::string> agree, differ;
  for (const ExpectedPace& e : expected) {
    const MotionShown& m = study.of(e.shown);
    const bool same = std::find(e.paces.begin(), e.paces.end(), m.adaptation.pace) != e.paces.end();
    (same ? agree : differ)
        .push_back(fmt::format("{} ({}{})", short_label(m.mapping.label), name_of(m.adaptation.pace),
                               same ? "" : fmt::format(" here, {} there", name_of(e.paces.front()))));
  }
  std::string text;
  if (!agree.empty()) text += "They agree on: " + joined(agree) + ".";
  if (!differ.empty()) text += (text.empty() ? "" : " ") + ("They differ on: " + joined(differ) + ".");
  return text;
}

}  // namespace plenolab
