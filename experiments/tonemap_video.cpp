#include "experiments/tonemap_video.h"

#include <fmt/format.h>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/lightfield/light_field_folder.h"
#include "core/synthesis/synthesizer.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/frame_mapper.h"

namespace plenolab {

namespace {

template <class Referral>
MappedVideoFrame synthesised_frame(std::size_t index, const NovelView<Referral>& view) {
  MappedVideoFrame frame;
  frame.index = index;
  frame.position = view.position;
  frame.unseen_pixels = view.unseen_pixels;
  frame.seconds_prepare = view.timings.prepare_s;
  frame.seconds_synthesis = view.timings.total_s - view.timings.prepare_s;
  return frame;
}

VideoPreprocessing map_frames(const LightField& field, std::span<const CameraPosition> positions,
                              const MappedVideoOptions& options,
                              const std::function<void(const MappedVideoFrame&)>& receive) {
  const Stopwatch watch;
  VideoPreprocessing preprocessing;
  const int threads = options.mapping.threads;
  FrameMapper mapper(field, measure_light_field(field, threads), options.mapping.choice,
                     {options.adaptation, options.frames_per_second, threads});
  preprocessing.fit = mapper.fit_of_light_field();
  field.max_disparity_px();
  preprocessing.seconds = watch.seconds();
  Synthesizer(field).synthesize_sequence(
      positions, options.synthesis, [&](std::size_t index, NovelView<SceneReferred>&& view) {
        MappedVideoFrame frame = synthesised_frame(index, view);
        const Stopwatch map_watch;
        FrameMapping mapped = mapper.map(view.image, nullptr, view.position);
        frame.seconds_postprocess = map_watch.seconds();
        frame.image = std::move(mapped.image);
        frame.fit = std::move(mapped.fit);
        frame.counts = mapped.counts;
        receive(frame);
      });
  return preprocessing;
}

VideoPreprocessing map_key_views(const LightField& field, std::span<const CameraPosition> positions,
                                 const MappedVideoOptions& options, const std::filesystem::path& scratch,
                                 const std::function<void(const MappedVideoFrame&)>& receive) {
  const Stopwatch watch;
  VideoPreprocessing preprocessing;
  preprocessing.key_views = write_mapped_light_field(scratch, field, options.mapping);
  const DisplayLightField mapped =
      open_display_light_field(scratch, {.memory_bound_bytes = options.mapping.memory_bound_bytes});
  mapped.max_disparity_px();
  preprocessing.seconds = watch.seconds();
  DisplaySynthesizer(mapped).synthesize_sequence(positions, options.synthesis,
                                                 [&](std::size_t index, NovelView<DisplayReferred>&& view) {
                                                   MappedVideoFrame frame = synthesised_frame(index, view);
                                                   frame.image = std::move(view.image);
                                                   receive(frame);
                                                 });
  return preprocessing;
}

}  // namespace

MappingPlace default_place(const OperatorChoice& choice) {
  return choice.maps_frames() ? MappingPlace::kFrames : MappingPlace::kKeyViews;
}

void require_possible(const OperatorChoice& choice, MappingPlace place) {
  const bool frames = place == MappingPlace::kFrames;
  if (choice.maps_frames() && !frames)
    throw UsageError(
        fmt::format("--map key-views: variant {} maps frames, with what came before them: "
                    "leave it out or choose another variant",
                    choice.variant.id));
  if (frames && choice.adjusted)
    throw UsageError("--map frames: key-view adjustment needs mapped key views: leave it out");
  if (frames && choice.variant.needs_disparity)
    throw UsageError(
        fmt::format("--map frames: variant {} needs disparity, which only key views have: leave "
                    "it out",
                    choice.variant.id));
}

VideoPreprocessing make_mapped_video(const LightField& field, std::span<const CameraPosition> positions,
                                     const MappedVideoOptions& options, const std::filesystem::path& scratch,
                                     const std::function<void(const MappedVideoFrame&)>& receive) {
  require_possible(options.mapping.choice, options.place);
  return options.place == MappingPlace::kFrames ? map_frames(field, positions, options, receive)
                                                : map_key_views(field, positions, options, scratch, receive);
}

}  // namespace plenolab
