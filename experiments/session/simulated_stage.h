#pragma once

#include "experiments/session/observer.h"
#include "experiments/session/sdl_input.h"
#include "experiments/session/stage.h"
#include "experiments/session/virtual_pad.h"

namespace plenolab {

/// A stage with a simulated participant in front of it: a display of 60 Hz that draws nothing, a clock that
/// goes on by a frame at every flip, and a virtual pad whose presses come back through SDL as those of a real
/// one do. Needs an SdlLibrary (headless). Sessions take milliseconds.
class SimulatedStage final : public Stage {
 public:
  explicit SimulatedStage(ObserverOptions observer);

  DisplayReport open_display(int screen) override;
  void load(const std::vector<Picture>& pictures) override;
  void draw(const Picture& picture) override;
  std::int64_t flip() override;
  std::int64_t now_us() const override { return now_us_; }
  std::vector<RawInput> poll() override;
  StageEquipment equipment() override { return {pad_.plugged() ? "virtual pad" : "", false}; }
  bool tone() override { return ++tones_, false; }
  bool vibrate() override { return input_.rumble(200); }

  int tones() const { return tones_; }
  int rumbles() const { return pad_.rumbles(); }

 private:
  void perform(const PadAction& action);

  Observer observer_;
  SdlInput input_;
  VirtualPad pad_;  // after the input, so that it goes first
  Picture picture_;
  bool fresh_ = false;
  std::int64_t frame_ = 0, now_us_ = 0;
  int tones_ = 0;
};

}  // namespace plenolab
