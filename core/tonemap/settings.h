#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plenolab {

/// One setting of an operator as a user sees it (`--set name=value`).
struct Setting {
  std::string name;
  double default_value = 0;
  double minimum = 0, maximum = 1;  ///< inclusive
  std::string unit;                 ///< "" for plain numbers
  std::string help;                 ///< one line
  bool integer = false;
  std::vector<std::string> choices =
      {};                      ///< if not empty, values are indices into it and are written by name
  std::string automatic = {};  ///< if not empty: the default is "auto", and this says what it means
};

/// Value of one setting: a number, or automatic.
struct SettingValue {
  double number = 0;
  bool automatic = false;
  friend bool operator==(const SettingValue&, const SettingValue&) = default;
};

/// Values by name; those that are missing have their defaults.
using SettingValues = std::map<std::string, SettingValue>;

/// The default of every setting.
SettingValues default_values(std::span<const Setting> settings);

/// Reads "name=value" texts over the defaults. Throws InputError with one sentence that names the operator,
/// the setting, the value and what is allowed.
SettingValues parse_settings(std::string_view operator_id, std::span<const Setting> settings,
                             std::span<const std::string> assignments);

/// A value as parse_settings would read it, e.g. "auto", "perceptual", "0.4".
std::string to_text(const Setting& setting, const SettingValue& value);

}  // namespace plenolab
