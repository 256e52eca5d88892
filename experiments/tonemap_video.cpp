#include "experiments/tonemap_video.h"

#include <fmt/format.h>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/lightfield/light_field_folder.h"
#include "core/synthesis/synthesizer.h"
#include "core/tonemap/light_field_mapping.h"

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

/// Maps HDR frames one after the other.
class FrameMapper {
 public:
  FrameMapper(const LightField& field, const MappedVideoOptions& options)
      : grid_(field.grid()),
        options_(options),
        choice_(options.mapping.choice),
        statistics_(measure_light_field(field, threads())) {
    if (choice_.variant.scope == OperatorScope::kLightField)
      of_light_field_ = choice_.info->fit(choice_.variant.id, choice_.values,
                                          scope_of_light_field(field, statistics_, threads()));
  }

  FitSummary fit_of_light_field() const { return {of_light_field_.values, of_light_field_.notes}; }

  void map(SceneImage image, MappedVideoFrame& frame) {
    const Stopwatch watch;
    const auto shared = std::make_shared<const SceneImage>(std::move(image));
    if (choice_.maps_frames())
      map_adaptively(*shared, frame);
    else if (choice_.variant.scope == OperatorScope::kLightField)
      take(of_light_field_.apply({shared, nullptr}, threads()), frame);
    else
      map_by_itself({shared, nullptr}, frame);
    frame.seconds_postprocess = watch.seconds();
  }

 private:
  int threads() const { return options_.mapping.threads; }

  static void take(ToneMapped mapped, MappedVideoFrame& frame) {
    frame.image = std::move(mapped.image);
    frame.counts = mapped.counts;
  }

  void map_adaptively(const SceneImage& image, MappedVideoFrame& frame) {
    FrameInput input;
    input.view = &image;
    set_key_views(statistics_, grid_, frame.position, input);
    input.step_s = 1 / options_.frames_per_second;
    input.adaptation = options_.adaptation;
    input.threads = threads();
    MappedFrame mapped = choice_.info->map_frame(choice_.variant.id, choice_.values, input, state_);
    state_ = mapped.state;
    frame.fit.values = std::move(mapped.values);
    take(std::move(mapped.mapped), frame);
  }

  /// A fit to the frame alone, but for the log floor, which is that of the light field.
  void map_by_itself(const OperatorView& view, MappedVideoFrame& frame) {
    FitScope scope;
    scope.load = [&view](int) { return view; };
    scope.statistics = evaluate(measure_view(*view.colour, threads()), statistics_.floor);
    scope.floor = statistics_.floor;
    scope.threads = threads();
    scope.scale = statistics_.scale;
    const FittedOperator fitted = choice_.info->fit(choice_.variant.id, choice_.values, scope);
    frame.fit = {fitted.values, fitted.notes};
    take(fitted.apply(view, threads()), frame);
  }

  ViewGrid grid_;
  const MappedVideoOptions& options_;
  const OperatorChoice& choice_;
  LightFieldStatistics statistics_;
  FittedOperator of_light_field_;
  std::optional<FrameState> state_;
};

VideoPreprocessing map_frames(const LightField& field, std::span<const CameraPosition> positions,
                              const MappedVideoOptions& options,
                              const std::function<void(const MappedVideoFrame&)>& receive) {
  const Stopwatch watch;
  VideoPreprocessing preprocessing;
  FrameMapper mapper(field, options);
  preprocessing.fit = mapper.fit_of_light_field();
  field.max_disparity_px();
  preprocessing.seconds = watch.seconds();
  Synthesizer(field).synthesize_sequence(positions, options.synthesis,
                                         [&](std::size_t index, NovelView<SceneReferred>&& view) {
                                           MappedVideoFrame frame = synthesised_frame(index, view);
                                           mapper.map(std::move(view.image), frame);
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
  options.adaptation.validate();
  require_possible(options.mapping.choice, options.place);
  return options.place == MappingPlace::kFrames ? map_frames(field, positions, options, receive)
                                                : map_key_views(field, positions, options, scratch, receive);
}

}  // namespace plenolab
