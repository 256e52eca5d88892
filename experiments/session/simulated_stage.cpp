#include "experiments/session/simulated_stage.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr std::int64_t kFrame_us = 16'667;  // whole, so that a repeated trial has the times it had before
constexpr std::int64_t kLongestSession_us = 6LL * 3600 * 1'000'000;

std::int64_t flip_time_us(std::int64_t frame) {
  return frame * kFrame_us;
}

}  // namespace

SimulatedStage::SimulatedStage(ObserverOptions observer) : observer_(std::move(observer)) {
  pad_.plug();
}

DisplayReport SimulatedStage::open_display(int screen) {
  return {screen, "simulated", 1920, 1080, 1e6 / kFrame_us, true, 1e-3 * kFrame_us};
}

void SimulatedStage::load(const std::vector<Picture>& pictures) {
  for (const Picture& picture : pictures)
    if (!std::filesystem::is_regular_file(picture.file))
      throw InputError(fmt::format("the image {} is not there", picture.file.string()));
}

void SimulatedStage::draw(const Picture& picture) {
  picture_ = picture;
  fresh_ = true;
}

std::int64_t SimulatedStage::flip() {
  now_us_ = flip_time_us(++frame_);
  PLENOLAB_CHECK(now_us_ < kLongestSession_us, "a simulated participant does not come to an end");
  if (fresh_) observer_.sees(picture_, now_us_);
  fresh_ = false;
  return now_us_;
}

void SimulatedStage::perform(const PadAction& action) {
  if (action.kind == PadAction::Kind::kButton) pad_.button(action.name, action.down);
  if (action.kind == PadAction::Kind::kTrigger) pad_.trigger(action.name, action.down);
  if (action.kind == PadAction::Kind::kUnplug) pad_.unplug();
  if (action.kind == PadAction::Kind::kPlug) pad_.plug();
  if (action.kind != PadAction::Kind::kType) return;
  SDL_Event event;
  SDL_zero(event);
  event.type = SDL_TEXTINPUT;
  action.name.copy(event.text.text, sizeof event.text.text - 1);
  SDL_PushEvent(&event);
}

std::vector<RawInput> SimulatedStage::poll() {
  std::vector<RawInput> inputs;
  const auto collect = [&](std::int64_t t_us) {
    for (RawInput& input : input_.poll(t_us, t_us)) inputs.push_back(std::move(input));
  };
  if (!input_.has_pad() && pad_.plugged()) collect(now_us_);
  while (const auto action = observer_.next(flip_time_us(frame_ + 1))) {
    perform(*action);
    collect(std::max(action->t_us, now_us_));
  }
  return inputs;
}

}  // namespace plenolab
