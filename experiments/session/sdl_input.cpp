#include "experiments/session/sdl_input.h"

#include <fmt/format.h>

#include <cstdlib>

#include "core/base/error.h"

namespace plenolab {

namespace {

/// Where SDL finds no screen it draws into memory, and nobody would see the session. Who names such a driver
/// in SDL_VIDEODRIVER wants it.
bool fell_back_to_memory() {
  const char* driver = SDL_GetCurrentVideoDriver();
  const std::string name = driver ? driver : "";
  return !std::getenv("SDL_VIDEODRIVER") && (name == "dummy" || name == "offscreen");
}

}  // namespace

SdlLibrary::SdlLibrary(Use use) {
  SDL_SetMainReady();
  // Without it pads are silent while their window has no focus, as with a dummy driver.
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "0");
  SDL_SetHint(SDL_HINT_VIDEO_MINIMIZE_ON_FOCUS_LOSS, "0");
  if (use == Use::kHeadless) SDL_SetHint(SDL_HINT_VIDEODRIVER, "dummy");
  if (SDL_Init(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER) != 0) {
    const std::string reason = SDL_GetError();
    SDL_Quit();
    throw InputError(fmt::format("cannot use display and pads: {}", reason));
  }
  if (use == Use::kScreen && fell_back_to_memory()) {
    SDL_Quit();
    throw InputError("there is no screen to show a session on: start it on a desktop, or set DISPLAY");
  }
}

SdlLibrary::~SdlLibrary() {
  SDL_Quit();
}

bool SdlInput::is_ours(SDL_JoystickID id) const {
  return pad_ && SDL_JoystickInstanceID(SDL_GameControllerGetJoystick(pad_.get())) == id;
}

void SdlInput::plug(int device, RawInput input, std::vector<RawInput>& inputs) {
  if (pad_) return;
  pad_.reset(SDL_GameControllerOpen(device));
  if (!pad_) return;
  input.kind = RawInput::Kind::kConnected;
  input.name = pad_name();
  inputs.push_back(input);
}

void SdlInput::unplug(RawInput input, std::vector<RawInput>& inputs) {
  pad_.reset();
  input.kind = RawInput::Kind::kDisconnected;
  inputs.push_back(input);
  for (int device = 0; device < SDL_NumJoysticks() && !pad_; ++device)
    if (SDL_IsGameController(device)) plug(device, input, inputs);
}

std::string SdlInput::pad_name() const {
  if (!pad_) return "";
  const char* name = SDL_GameControllerName(pad_.get());
  return name ? name : "pad";
}

void SdlInput::take_pad(const SDL_Event& event, RawInput input, std::vector<RawInput>& inputs) {
  const auto named = [](const char* name) { return std::string(name ? name : ""); };
  if (event.type == SDL_CONTROLLERDEVICEADDED) return plug(event.cdevice.which, input, inputs);
  if (event.type == SDL_CONTROLLERDEVICEREMOVED && is_ours(event.cdevice.which)) {
    unplug(input, inputs);
  } else if (event.type == SDL_CONTROLLERAXISMOTION && is_ours(event.caxis.which)) {
    input.kind = RawInput::Kind::kTrigger;
    input.name =
        named(SDL_GameControllerGetStringForAxis(static_cast<SDL_GameControllerAxis>(event.caxis.axis)));
    input.value = event.caxis.value;
    // Sticks flood the queue and mean nothing here.
    if (input.name == "lefttrigger" || input.name == "righttrigger") inputs.push_back(input);
  } else if ((event.type == SDL_CONTROLLERBUTTONDOWN || event.type == SDL_CONTROLLERBUTTONUP) &&
             is_ours(event.cbutton.which)) {
    input.kind = RawInput::Kind::kPadButton;
    input.name = named(
        SDL_GameControllerGetStringForButton(static_cast<SDL_GameControllerButton>(event.cbutton.button)));
    input.down = event.cbutton.state == SDL_PRESSED;
    inputs.push_back(input);
  }
}

void SdlInput::take(const SDL_Event& event, RawInput input, std::vector<RawInput>& inputs) {
  const bool key = event.type == SDL_KEYDOWN || event.type == SDL_KEYUP;
  if (key && event.key.repeat == 0) {
    input.kind = RawInput::Kind::kKey;
    input.name = SDL_GetKeyName(event.key.keysym.sym);
    input.down = event.key.state == SDL_PRESSED;
    inputs.push_back(input);
  } else if (event.type == SDL_TEXTINPUT) {
    input.kind = RawInput::Kind::kText;
    input.name = event.text.text;
    inputs.push_back(input);
  } else if (event.type == SDL_QUIT) {
    input.kind = RawInput::Kind::kClose;
    inputs.push_back(input);
  } else if (!key) {
    take_pad(event, input, inputs);
  }
}

std::vector<RawInput> SdlInput::poll(std::int64_t t_low_us, std::int64_t t_us) {
  std::vector<RawInput> inputs;
  RawInput stamp;
  stamp.t_low_us = t_low_us;
  stamp.t_us = t_us;
  for (SDL_Event event; SDL_PollEvent(&event);) take(event, stamp, inputs);
  return inputs;
}

bool SdlInput::rumble(std::uint32_t ms) {
  return pad_ && SDL_GameControllerRumble(pad_.get(), 0xffff, 0xffff, ms) == 0;
}

}  // namespace plenolab
