#include "core/tonemap/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/error.h"

namespace plenolab {

namespace {

std::string allowed(const Setting& s) {
  std::string text = s.choices.empty() ? fmt::format("{}a number in [{}, {}]{}", s.integer ? "whole " : "",
                                                     s.minimum, s.maximum, s.unit.empty() ? "" : " " + s.unit)
                                       : fmt::format("one of {}", fmt::join(s.choices, ", "));
  if (!s.automatic.empty()) text += " or auto";
  return text;
}

std::optional<double> read_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<SettingValue> read_value(const Setting& s, std::string_view text) {
  if (text == "auto" && !s.automatic.empty()) return SettingValue{0, true};
  if (!s.choices.empty()) {
    const auto found = std::find(s.choices.begin(), s.choices.end(), text);
    if (found == s.choices.end()) return std::nullopt;
    return SettingValue{static_cast<double>(found - s.choices.begin()), false};
  }
  const std::optional<double> value = read_number(text);
  if (!value || *value < s.minimum || *value > s.maximum) return std::nullopt;
  if (s.integer && *value != std::floor(*value)) return std::nullopt;
  return SettingValue{*value, false};
}

const Setting& find_setting(std::string_view operator_id, std::span<const Setting> settings,
                            std::string_view name) {
  for (const Setting& s : settings)
    if (s.name == name) return s;
  std::vector<std::string> names;
  for (const Setting& s : settings) names.push_back(s.name);
  throw InputError(
      fmt::format("operator {} has no setting {}; it has {}", operator_id, name, fmt::join(names, ", ")));
}

}  // namespace

SettingValues default_values(std::span<const Setting> settings) {
  SettingValues values;
  for (const Setting& s : settings) values[s.name] = {s.default_value, !s.automatic.empty()};
  return values;
}

SettingValues parse_settings(std::string_view operator_id, std::span<const Setting> settings,
                             std::span<const std::string> assignments) {
  SettingValues values = default_values(settings);
  for (const std::string_view text : assignments) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
      throw InputError(
          fmt::format("setting \"{}\" of operator {} is not of the form name=value", text, operator_id));
    const Setting& setting = find_setting(operator_id, settings, text.substr(0, equals));
    const std::optional<SettingValue> value = read_value(setting, text.substr(equals + 1));
    if (!value)
      throw InputError(fmt::format("setting {} of operator {} must be {}, not \"{}\"", setting.name,
                                   operator_id, allowed(setting), text.substr(equals + 1)));
    values[setting.name] = *value;
  }
  return values;
}

std::string to_text(const Setting& setting, const SettingValue& value) {
  if (value.automatic) return "auto";
  if (setting.choices.empty()) return fmt::format("{}", value.number);
  return setting.choices.at(static_cast<std::size_t>(value.number));
}

}  // namespace plenolab
