#include "experiments/frame_mapper.h"

#include <utility>

namespace plenolab {

namespace {

/// A view that someone else owns.
OperatorView borrowed(const SceneImage& image) {
  return {{std::shared_ptr<const void>{}, &image}, nullptr};
}

}  // namespace

FrameMapper::FrameMapper(const LightField& field, LightFieldStatistics statistics,
                         const OperatorChoice& choice, const FrameMapperOptions& options)
    : grid_(field.grid()), statistics_(std::move(statistics)), choice_(choice), options_(options) {
  options_.adaptation.validate();
  if (choice_.variant.scope == OperatorScope::kLightField)
    of_light_field_ = choice_.info->fit(choice_.variant.id, choice_.values,
                                        scope_of_light_field(field, statistics_, options_.threads));
}

FrameMapping FrameMapper::map(const SceneImage& frame, CameraPosition position) {
  if (choice_.maps_frames()) return map_adaptively(frame, position);
  if (choice_.variant.scope == OperatorScope::kView) return map_by_itself(frame);
  ToneMapped mapped = of_light_field_.apply(borrowed(frame), options_.threads);
  return {std::move(mapped.image), {}, mapped.counts};
}

FrameMapping FrameMapper::map_adaptively(const SceneImage& frame, CameraPosition position) {
  FrameInput input;
  input.view = &frame;
  set_key_views(statistics_, grid_, position, input);
  input.step_s = 1 / options_.frames_per_second;
  input.adaptation = options_.adaptation;
  input.threads = options_.threads;
  MappedFrame mapped = choice_.info->map_frame(choice_.variant.id, choice_.values, input, state_);
  state_ = mapped.state;
  return {std::move(mapped.mapped.image), {std::move(mapped.values), {}}, mapped.mapped.counts};
}

// A fit to the frame alone, but for the log floor, which is that of the light field.
FrameMapping FrameMapper::map_by_itself(const SceneImage& frame) const {
  FitScope scope;
  scope.load = [&frame](int) { return borrowed(frame); };
  scope.statistics = evaluate(measure_view(frame, options_.threads), statistics_.floor);
  scope.floor = statistics_.floor;
  scope.threads = options_.threads;
  const FittedOperator fitted = choice_.info->fit(choice_.variant.id, choice_.values, scope);
  ToneMapped mapped = fitted.apply(borrowed(frame), options_.threads);
  return {std::move(mapped.image), {fitted.values, fitted.notes}, mapped.counts};
}

}  // namespace plenolab
