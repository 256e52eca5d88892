#include "experiments/reproduce/tonemap/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "experiments/frame_mapper.h"
#include "metrics/consistency.h"

namespace plenolab {

namespace {

SynthesisOptions synthesis_options(const Mapping& mapping, int threads) {
  SynthesisOptions options;
  options.border_weight = mapping.border_weight;
  options.threads = threads;
  return options;
}

std::size_t largest_peak_step(const std::vector<ReferenceFrame>& frames) {
  std::size_t event = 1;
  double largest = -1;
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (const double step = std::abs(log_peak(frames[i].hdr) - log_peak(frames[i - 1].hdr)); step > largest) {
      largest = step;
      event = i;
    }
  return event;
}

/// Pixels of each row (or column) whose set of contributing views differs from that of their neighbour.
int busiest_line(const std::vector<ReferenceFrame>& frames, EpiDirection direction) {
  const int width = frames.front().hdr.width(), height = frames.front().hdr.height();
  const bool rows = direction == EpiDirection::kRow;
  std::vector<std::int64_t> crossings(static_cast<std::size_t>(rows ? height : width));
  for (const ReferenceFrame& frame : frames)
    for (int y = 0; y + (rows ? 0 : 1) < height; ++y)
      for (int x = 0; x + (rows ? 1 : 0) < width; ++x)
        if (frame.contributors.at(x, y) != frame.contributors.at(x + (rows ? 1 : 0), y + (rows ? 0 : 1)))
          ++crossings[static_cast<std::size_t>(rows ? y : x)];
  return static_cast<int>(std::max_element(crossings.begin(), crossings.end()) - crossings.begin());
}

/// One line of each frame, stacked as analysis/epi.h does, without keeping the frames.
class EpiCollector {
 public:
  explicit EpiCollector(const RecordedMotion& recording)
      : direction_(recording.epi_direction()), line_(recording.epi_line) {}

  void add(const DisplayImage& frame) {
    const bool rows = direction_ == EpiDirection::kRow;
    DisplayImage one(rows ? frame.width() : 1, rows ? 1 : frame.height());
    for (int i = 0; i < (rows ? frame.width() : frame.height()); ++i)
      one.at(rows ? i : 0, rows ? 0 : i) = rows ? frame.at(i, line_) : frame.at(line_, i);
    lines_.push_back(std::move(one));
  }

  DisplayImage image() const { return epi(std::span<const DisplayImage>(lines_), direction_, 0); }

 private:
  EpiDirection direction_;
  int line_;
  std::vector<DisplayImage> lines_;
};

}  // namespace

double log_peak(const SceneImage& view) {
  float peak = 0;
  for (const Rgb& c : view.pixels())
    if (const float y = luminance(c); std::isfinite(y)) peak = std::max(peak, y);
  return peak > 0 ? std::log10(static_cast<double>(peak)) : -300;
}

std::string Mapping::key() const {
  return fmt::format("{} {} {} {} {} {}", choice.info->id, choice.variant_name(), settings_text(choice),
                     adaptation.time_constant_s, static_cast<int>(adaptation.scheme),
                     static_cast<int>(border_weight));
}

Mapping mapping_of(std::string label, const std::string& name, const std::string& variant,
                   const std::vector<std::string>& settings) {
  return {.label = std::move(label),
          .choice = choose_operator({.name = name, .variant = variant, .settings = settings}),
          .adaptation = {},
          .border_weight = BorderWeight::kPrinted};
}

int frames_per_spacing(const Motion& motion) {
  const double spacings =
      std::abs(motion.vertical() ? motion.to.t - motion.from.t : motion.to.s - motion.from.s);
  return spacings > 0 ? std::max(1, static_cast<int>(std::lround((motion.frames - 1) / spacings))) : 1;
}

RecordedMotion record_motion(const Synthesizer& synthesizer, const Motion& motion, int threads) {
  PLENOLAB_CHECK(motion.frames >= 2, "a motion has at least two frames");
  RecordedMotion recording{.motion = motion, .frames = {}};
  SynthesisOptions options;
  options.threads = threads;
  for (const CameraPosition& position : straight_path(motion.from, motion.to, motion.frames))
    recording.frames.push_back(reference_frame(synthesizer, position, options));
  recording.epi_line = busiest_line(recording.frames, recording.epi_direction());
  recording.event = largest_peak_step(recording.frames);
  return recording;
}

RecordedMotion faster(const RecordedMotion& recording, int stride) {
  PLENOLAB_CHECK(stride >= 1, "stride");
  RecordedMotion fast{.motion = recording.motion, .frames = {}, .epi_line = recording.epi_line};
  for (std::size_t i = 0; i < recording.frames.size(); i += static_cast<std::size_t>(stride))
    fast.frames.push_back(recording.frames[i]);
  PLENOLAB_CHECK(fast.frames.size() >= 2, "a motion has at least two frames");
  fast.motion.frames = static_cast<int>(fast.frames.size());
  fast.motion.to = fast.frames.back().position;
  fast.event = largest_peak_step(fast.frames);
  return fast;
}

MappedKeyViews map_key_views(const LightField& field, const LightFieldStatistics& statistics,
                             const Mapping& mapping, int threads) {
  const OperatorChoice& choice = mapping.choice;
  std::vector<KeyView<DisplayReferred>> views;
  std::vector<FitSummary> fits;
  const auto sink = [&](int column, int row, const ToneMapped& mapped, const FittedOperator& fitted) {
    views.push_back({mapped.image, field.view(column, row)->disparity});
    if (fits.empty() || choice.variant.scope == OperatorScope::kView)
      fits.push_back({fitted.values, fitted.notes});
  };
  const MappingCounts counts =
      map_light_field(*choice.info, choice.variant.id, choice.values, field, statistics, sink, threads);
  const auto as_field = [&field](std::vector<KeyView<DisplayReferred>> all) {
    return DisplayLightField::from_views(field.grid(), field.unit(), field.name(), std::move(all));
  };
  DisplayLightField mapped = as_field(std::move(views));
  if (choice.adjusted) {
    std::vector<KeyView<DisplayReferred>> adjusted;
    const auto keep = [&](int column, int row, const DisplayImage& view) {
      adjusted.push_back({view, field.view(column, row)->disparity});
    };
    KeyViewAdjustmentRun run;
    run.threads = threads;
    adjust_key_views(field, mapped, {}, keep, run);
    mapped = as_field(std::move(adjusted));
  }
  std::vector<double> lumas;
  for (int row = 0; row < field.grid().rows; ++row)
    for (int column = 0; column < field.grid().columns; ++column)
      lumas.push_back(mean_luma(mapped.view(column, row)->colour));
  return {std::move(mapped), std::move(fits), std::move(lumas), counts};
}

void for_each_mapped_frame(const LightField& field, const LightFieldStatistics& statistics,
                           std::span<const ReferenceFrame> frames, double frames_per_second,
                           const Mapping& mapping, const MappedKeyViews* key_views, int threads,
                           const std::function<void(std::size_t index, FrameMapping&& frame)>& receive) {
  if (mapping.place() == MappingPlace::kFrames) {
    FrameMapper mapper(field, statistics, mapping.choice, {mapping.adaptation, frames_per_second, threads});
    for (std::size_t i = 0; i < frames.size(); ++i)
      receive(i, mapper.map(frames[i].hdr, &frames[i].disparity_px, frames[i].position));
    return;
  }
  PLENOLAB_CHECK(key_views != nullptr, "mapped key views");
  std::vector<CameraPosition> positions;
  for (const ReferenceFrame& frame : frames) positions.push_back(frame.position);
  DisplaySynthesizer(key_views->field)
      .synthesize_sequence(positions, synthesis_options(mapping, threads),
                           [&](std::size_t index, NovelView<DisplayReferred>&& view) {
                             receive(index, {.image = std::move(view.image), .fit = {}, .counts = {}});
                           });
}

MappedMotion map_motion(const LightField& field, const LightFieldStatistics& statistics,
                        const RecordedMotion& recording, const Mapping& mapping,
                        const MappedKeyViews* key_views, const Columns& columns, int threads) {
  MappedMotion mapped;
  ConsistencyMeter meter(field.grid(), synthesis_options(mapping, threads), {.threads = threads});
  EpiCollector lines(recording);
  const std::size_t last = recording.frames.size() - 1;
  for_each_mapped_frame(field, statistics, recording.frames, recording.motion.frames_per_second, mapping,
                        key_views, threads, [&](std::size_t i, FrameMapping&& frame) {
                          mapped.frames.push_back(meter.add(recording.frames[i], frame.image));
                          lines.add(frame.image);
                          mapped.fits.push_back(std::move(frame.fit.values));
                          if (i == 0) mapped.first = frame.image;
                          if (i + 1 == recording.event) mapped.before = frame.image;
                          if (i == recording.event) mapped.event = frame.image;
                          if (i == last) mapped.last = frame.image;
                        });
  mapped.summary = meter.summary(columns);
  mapped.track = meter.track();
  mapped.epi = lines.image();
  return mapped;
}

}  // namespace plenolab
