#include "experiments/session/virtual_pad.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace plenolab {

int SDLCALL VirtualPad::on_rumble(void* self, Uint16 low, Uint16 high) {
  if (low != 0 || high != 0) ++static_cast<VirtualPad*>(self)->rumbles_;
  return 0;
}

void VirtualPad::plug() {
  if (plugged()) return;
  SDL_VirtualJoystickDesc description;
  SDL_zero(description);
  description.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
  description.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
  description.naxes = SDL_CONTROLLER_AXIS_MAX;
  description.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
  description.vendor_id = 0x045e;  // the Xbox 360 pad of the study
  description.product_id = 0x028e;
  description.name = "plenolab virtual pad";
  description.userdata = this;
  description.Rumble = &VirtualPad::on_rumble;
  device_ = SDL_JoystickAttachVirtualEx(&description);
  joystick_ = device_ < 0 ? nullptr : SDL_JoystickOpen(device_);
  if (!joystick_) throw InputError(fmt::format("cannot make a virtual pad: {}", SDL_GetError()));
  trigger("lefttrigger", false);
  trigger("righttrigger", false);
}

void VirtualPad::unplug() {
  if (!plugged()) return;
  const SDL_JoystickID id = SDL_JoystickInstanceID(joystick_);
  for (int device = 0; device < SDL_NumJoysticks(); ++device)
    if (SDL_JoystickGetDeviceInstanceID(device) == id) {
      SDL_JoystickDetachVirtual(device);
      break;
    }
  SDL_JoystickClose(joystick_);
  joystick_ = nullptr;
}

void VirtualPad::button(const std::string& name, bool down) {
  if (plugged())
    SDL_JoystickSetVirtualButton(joystick_, SDL_GameControllerGetButtonFromString(name.c_str()),
                                 down ? 1 : 0);
}

void VirtualPad::trigger(const std::string& name, bool pressed) {
  if (plugged())
    SDL_JoystickSetVirtualAxis(joystick_, SDL_GameControllerGetAxisFromString(name.c_str()),
                               pressed ? SDL_JOYSTICK_AXIS_MAX : SDL_JOYSTICK_AXIS_MIN);
}

}  // namespace plenolab
