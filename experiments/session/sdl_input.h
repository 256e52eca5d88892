#pragma once

#include <SDL.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/session/input.h"

namespace plenolab {

/// SDL is on from construction to destruction; the only place that initialises it. `headless`: the dummy
/// video driver and no audio, for simulated participants. Throws InputError with SDL's reason, or if there is
/// no screen.
class SdlLibrary {
 public:
  enum class Use { kScreen, kHeadless };
  explicit SdlLibrary(Use use);
  ~SdlLibrary();
  SdlLibrary(const SdlLibrary&) = delete;
  SdlLibrary& operator=(const SdlLibrary&) = delete;
};

/// Pads and keyboard through SDL's events. The first pad that is plugged in is used, others are left alone
/// until it is unplugged; then one of those that are there takes over.
class SdlInput {
 public:
  /// Everything that happened since the last call; `t_low_us` is the time of that call, `t_us` of this one.
  std::vector<RawInput> poll(std::int64_t t_low_us, std::int64_t t_us);
  bool has_pad() const { return pad_ != nullptr; }
  /// Name of the pad in use; empty: none.
  std::string pad_name() const;
  /// Strong for `ms`; false if there is no pad or it cannot.
  bool rumble(std::uint32_t ms);

 private:
  struct Close {
    void operator()(SDL_GameController* pad) const { SDL_GameControllerClose(pad); }
  };
  void take(const SDL_Event& event, RawInput input, std::vector<RawInput>& inputs);
  void take_pad(const SDL_Event& event, RawInput input, std::vector<RawInput>& inputs);
  void plug(int device, RawInput input, std::vector<RawInput>& inputs);
  void unplug(RawInput input, std::vector<RawInput>& inputs);
  bool is_ours(SDL_JoystickID id) const;

  std::unique_ptr<SDL_GameController, Close> pad_;
};

}  // namespace plenolab
