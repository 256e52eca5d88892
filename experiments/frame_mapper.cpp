#include "experiments/frame_mapper.h"

#include <utility>

namespace plenolab {

namespace {

/// An image that someone else owns.
template <class Image>
std::shared_ptr<const Image> borrowed(const Image* image) {
  return {std::shared_ptr<const void>{}, image};
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

FrameMapping FrameMapper::map(const SceneImage& frame, const DisparityMap* disparity,
                              CameraPosition position) {
  if (choice_.maps_frames()) return map_adaptively(frame, position);
  const OperatorView view{borrowed(&frame), borrowed(disparity)};
  if (choice_.variant.scope == OperatorScope::kView) return map_by_itself(view);
  ToneMapped mapped = of_light_field_.apply(view, options_.threads);
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
FrameMapping FrameMapper::map_by_itself(const OperatorView& frame) const {
  FitScope scope;
  scope.load = [&frame](int) { return frame; };
  scope.statistics = evaluate(measure_view(*frame.colour, options_.threads), statistics_.floor);
  scope.floor = statistics_.floor;
  scope.threads = options_.threads;
  scope.scale = statistics_.scale;
  const FittedOperator fitted = choice_.info->fit(choice_.variant.id, choice_.values, scope);
  ToneMapped mapped = fitted.apply(frame, options_.threads);
  return {std::move(mapped.image), {fitted.values, fitted.notes}, mapped.counts};
}

}  // namespace plenolab
