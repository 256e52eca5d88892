#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/session/form.h"
#include "experiments/session/input.h"
#include "experiments/session/trial_machine.h"

namespace plenolab {

/// What is to be drawn.
struct Picture {
  enum class Kind { kBlack, kImage, kPage };
  Kind kind = Kind::kBlack;
  std::filesystem::path file;  ///< of an image
  int zoom = 1;
  // What an observer finds out by looking; for simulated participants.
  Stimulus stimulus = Stimulus::kBlack;  ///< which button brought the image
  bool shows_test = false;               ///< it is not the reference
  std::string block, image;              ///< ids
  bool catch_trial = false;
  std::string question;  ///< id of the question of a page; empty on a page that stops a trial
  FormQuestion::Kind question_kind = FormQuestion::Kind::kMessage;
  FormPage page;
  std::string banner;  ///< small, above a page: "Pilot: not data"
};

/// A display as it was found when it was opened.
struct DisplayReport {
  int screen = 0;  ///< SDL's index
  std::string name;
  int width_px = 0, height_px = 0;
  double refresh_hz = 0;   ///< as the system states it; 0: unknown
  bool vsync = false;      ///< whether flips wait for the display
  double interval_ms = 0;  ///< measured: median over flips
};

/// What there is beside the display.
struct StageEquipment {
  std::string pad;     ///< its name; empty: none
  bool audio = false;  ///< whether tones can be heard
};

/// Where a session takes place: a display with a clock, pads and a keyboard. The real one is SdlStage, the
/// one of simulated participants SimulatedStage.
class Stage {
 public:
  virtual ~Stage() = default;
  /// Shows everything on this display from now on. Throws InputError if there is none or the window came up
  /// elsewhere.
  virtual DisplayReport open_display(int screen) = 0;
  /// Loads images so that drawing them takes no time. Throws InputError for one that is damaged or larger
  /// than the display.
  virtual void load(const std::vector<Picture>& pictures) = 0;
  /// Draws into the next frame; every later one repeats it.
  virtual void draw(const Picture& picture) = 0;
  /// Shows the next frame; the time at which it was shown.
  virtual std::int64_t flip() = 0;
  /// The time, on the clock of flips and inputs.
  virtual std::int64_t now_us() const = 0;
  /// Inputs since the last call, in order.
  virtual std::vector<RawInput> poll() = 0;
  virtual StageEquipment equipment() = 0;
  /// Begin a tone and a vibration of the pad; false if there is nothing that could.
  virtual bool tone() = 0;
  virtual bool vibrate() = 0;
};

}  // namespace plenolab
