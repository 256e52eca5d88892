#include "experiments/session/input.h"

#include <algorithm>
#include <array>
#include <utility>

namespace plenolab {

namespace {

constexpr int kTriggerEnd = 32767;
constexpr int kPressedFrom = kTriggerEnd * 3 / 4;
constexpr int kReadyBelow = kTriggerEnd / 4;

}  // namespace

const char* name_of(Press press) {
  static constexpr std::array kNames{"reference", "left", "right", "choose"};
  return kNames[static_cast<std::size_t>(press)];
}

std::optional<Press> PressDecoder::bumper(bool& one, bool down) {
  one = down;
  if (!left_bumper_ && !right_bumper_) bumpers_ready_ = true;
  if (!left_bumper_ || !right_bumper_ || !bumpers_ready_) return std::nullopt;
  bumpers_ready_ = false;
  return Press::kChoose;
}

std::optional<Press> PressDecoder::button(const RawInput& input) {
  if (input.name == "leftshoulder") return bumper(left_bumper_, input.down);
  if (input.name == "rightshoulder") return bumper(right_bumper_, input.down);
  const bool face = input.name == "a" || input.name == "b" || input.name == "x" || input.name == "y";
  return face && input.down ? std::optional(Press::kReference) : std::nullopt;
}

std::optional<Press> PressDecoder::trigger(const RawInput& input) {
  const bool left = input.name == "lefttrigger";
  bool& pressed = left ? left_trigger_ : right_trigger_;
  if (pressed && input.value < kReadyBelow) pressed = false;
  if (pressed || input.value < kPressedFrom) return std::nullopt;
  pressed = true;
  return left ? Press::kLeft : Press::kRight;
}

std::optional<Press> PressDecoder::decode(const RawInput& input) {
  static constexpr std::array<std::pair<const char*, Press>, 5> kKeys{{{"Space", Press::kReference},
                                                                       {"Left", Press::kLeft},
                                                                       {"Right", Press::kRight},
                                                                       {"Return", Press::kChoose},
                                                                       {"Keypad Enter", Press::kChoose}}};
  switch (input.kind) {
    case RawInput::Kind::kPadButton:
      return button(input);
    case RawInput::Kind::kTrigger:
      return trigger(input);
    case RawInput::Kind::kKey:
      for (const auto& key : kKeys)
        if (input.down && input.name == key.first) return key.second;
      return std::nullopt;
    case RawInput::Kind::kDisconnected:
      *this = PressDecoder();
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<FormPress> form_press(const RawInput& input) {
  static constexpr std::array<std::pair<const char*, FormPress>, 7> kKeys{
      {{"Up", FormPress::kUp},
       {"Down", FormPress::kDown},
       {"Left", FormPress::kLeft},
       {"Right", FormPress::kRight},
       {"Return", FormPress::kConfirm},
       {"Keypad Enter", FormPress::kConfirm},
       {"Backspace", FormPress::kErase}}};
  static constexpr std::array<std::pair<const char*, FormPress>, 6> kButtons{{{"dpup", FormPress::kUp},
                                                                              {"dpdown", FormPress::kDown},
                                                                              {"dpleft", FormPress::kLeft},
                                                                              {"dpright", FormPress::kRight},
                                                                              {"a", FormPress::kConfirm},
                                                                              {"b", FormPress::kErase}}};
  if (!input.down) return std::nullopt;
  const auto find = [&](const auto& table) -> std::optional<FormPress> {
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const auto& entry) { return input.name == entry.first; });
    return found == table.end() ? std::nullopt : std::optional(found->second);
  };
  if (input.kind == RawInput::Kind::kKey) return find(kKeys);
  return input.kind == RawInput::Kind::kPadButton ? find(kButtons) : std::nullopt;
}

}  // namespace plenolab
