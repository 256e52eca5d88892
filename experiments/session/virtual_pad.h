#pragma once

#include <SDL.h>

#include <string>

namespace plenolab {

/// A pad that exists in SDL alone: what is pressed on it comes back through the same events as from a real
/// one. Needs an SdlLibrary.
class VirtualPad {
 public:
  ~VirtualPad() { unplug(); }
  VirtualPad() = default;
  VirtualPad(const VirtualPad&) = delete;
  VirtualPad& operator=(const VirtualPad&) = delete;

  /// Throws InputError if this SDL has no virtual pads.
  void plug();
  void unplug();
  bool plugged() const { return joystick_ != nullptr; }
  /// `name` as in RawInput; nothing happens on an unplugged pad.
  void button(const std::string& name, bool down);
  void trigger(const std::string& name, bool pressed);
  /// Times it was told to vibrate.
  int rumbles() const { return rumbles_; }

 private:
  static int SDLCALL on_rumble(void* self, Uint16 low, Uint16 high);

  SDL_Joystick* joystick_ = nullptr;
  int device_ = -1, rumbles_ = 0;
};

}  // namespace plenolab
