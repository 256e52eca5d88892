#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace plenolab {

/// What happened on a pad or keyboard, as polled. The event happened after `t_low_us` (the poll before) and
/// not after `t_us`, both in µs of the clock of the session's run.
struct RawInput {
  enum class Kind {
    kPadButton,     ///< `name`: "a", "b", "x", "y", "leftshoulder", "rightshoulder", "dpup" …; `down`
    kTrigger,       ///< `name`: "lefttrigger" or "righttrigger"; `value` 0 … 32767
    kKey,           ///< `name`: SDL's name of the key; `down`; key repeats do not count
    kText,          ///< `name`: UTF-8 text typed
    kConnected,     ///< a pad was plugged in
    kDisconnected,  ///< the pad was unplugged
    kClose,         ///< the window was closed, or the process told to stop
  };
  Kind kind = Kind::kKey;
  std::string name;
  bool down = false;
  int value = 0;
  std::int64_t t_low_us = 0, t_us = 0;
};

/// What a participant can press in a trial.
enum class Press {
  kReference,  ///< A, B, X or Y; space bar
  kLeft,       ///< left trigger; left arrow
  kRight,      ///< right trigger; right arrow
  kChoose,     ///< both bumpers; return
};

/// "reference", "left", "right", "choose".
const char* name_of(Press press);

/// Turns what comes from pads and keyboards into presses. Only presses count, never releases: those that
/// unplugging brings about choose nothing.
///   - Triggers have hysteresis: pressed from three quarters of their way, ready again below one quarter. SDL
///     reports a trigger that has not moved yet as half pressed; that is neither.
///   - Bumpers fire once, when both are down, and are ready again when both are up.
/// After a pad is unplugged everything counts as released. What is held down when it comes back is reported
/// as pressed at once, while the display is still black: TrialMachine ignores that.
class PressDecoder {
 public:
  std::optional<Press> decode(const RawInput& input);

 private:
  std::optional<Press> button(const RawInput& input);
  std::optional<Press> trigger(const RawInput& input);
  std::optional<Press> bumper(bool& one, bool down);

  bool left_trigger_ = false, right_trigger_ = false;  // pressed
  bool left_bumper_ = false, right_bumper_ = false;    // down
  bool bumpers_ready_ = true;
};

/// What moves through a form (consent, questions).
enum class FormPress { kUp, kDown, kLeft, kRight, kConfirm, kErase };

/// The press in a form: arrow keys, return and backspace; on the pad its cross, A and B.
std::optional<FormPress> form_press(const RawInput& input);

}  // namespace plenolab
