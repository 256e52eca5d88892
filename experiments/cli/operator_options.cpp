#include "experiments/cli/operator_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/base/error.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/suggest.h"

namespace plenolab {

namespace {

const std::string kAdjusted = "adjusted";

std::vector<std::string> operator_ids() {
  std::vector<std::string> ids;
  for (const OperatorInfo& info : tone_mapping_operators()) ids.push_back(info.id);
  return ids;
}

std::vector<std::string> variant_ids(const OperatorInfo& info) {
  std::vector<std::string> ids;
  for (const OperatorVariant& variant : info.variants) ids.push_back(variant.id);
  return ids;
}

const OperatorVariant& variant_named(const OperatorInfo& info, const std::string& id) {
  const std::vector<std::string> ids = variant_ids(info);
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found != ids.end()) return info.variants[static_cast<std::size_t>(found - ids.begin())];
  std::vector<std::string> known = ids;
  known.push_back(kAdjusted);
  throw UsageError(
      fmt::format("--variant: operator {} has no variant '{}'{} (it has {}, and for light fields "
                  "'adjusted' or 'VARIANT+adjusted')",
                  info.id, id, did_you_mean(id, known), fmt::join(ids, ", ")));
}

SettingValues values_of(const OperatorInfo& info, const std::vector<std::string>& assignments) {
  try {
    return parse_settings(info.id, info.settings, assignments);
  } catch (const InputError& error) {
    throw UsageError(fmt::format("--set: {}", error.what()));
  }
}

}  // namespace

std::string OperatorChoice::variant_name() const {
  return adjusted ? variant.id + "+" + kAdjusted : variant.id;
}

void add_operator_options(CLI::App& app, OperatorOptions& options) {
  app.add_option("--operator", options.name, "Tone mapping operator, see 'plenolab tonemap --list'")
      ->check(one_of(operator_ids()));
  app.add_option("--variant", options.variant, "Variant of the operator (default: its first)")
      ->check(not_empty());
  app.add_option("--set", options.settings, "Setting of the operator, NAME=VALUE; may be given several times")
      ->allow_extra_args(false);
}

OperatorChoice choose_operator(const OperatorOptions& options) {
  if (options.name.empty())
    throw UsageError(fmt::format("--operator is required: {}", fmt::join(operator_ids(), ", ")));
  const OperatorInfo& info = find_operator(options.name);
  OperatorChoice choice;
  choice.info = &info;
  std::string id = options.variant.empty() ? info.variants.front().id : options.variant;
  if (id == kAdjusted) id = info.variants.front().id + "+" + kAdjusted;
  if (id.ends_with("+" + kAdjusted)) {
    choice.adjusted = true;
    id.resize(id.size() - kAdjusted.size() - 1);
  }
  choice.variant = variant_named(info, id);
  if (choice.adjusted && choice.maps_frames())
    throw UsageError(fmt::format(
        "--variant: {} maps frames, and key-view adjustment needs mapped key views: choose another", id));
  choice.values = values_of(info, options.settings);
  return choice;
}

void require_view_variant(const OperatorChoice& choice) {
  if (choice.maps_frames())
    throw UsageError(
        fmt::format("--variant: {} maps frames of a video, so it is for 'plenolab video': "
                    "choose {} here",
                    choice.variant.id, choice.info->variants.front().id));
}

void require_not_adjusted(const OperatorChoice& choice) {
  if (choice.adjusted)
    throw UsageError("--variant: key-view adjustment is for light fields, see 'plenolab tonemap-lf --help'");
}

std::string scope_name(OperatorScope scope) {
  switch (scope) {
    case OperatorScope::kView:
      return "view";
    case OperatorScope::kLightField:
      return "light-field";
    case OperatorScope::kFrame:
      return "frame";
  }
  PLENOLAB_CHECK(false, fmt::format("{}", static_cast<int>(scope)));
  return "";
}

std::string settings_text(const OperatorChoice& choice) {
  std::vector<std::string> parts;
  for (const Setting& setting : choice.info->settings)
    parts.push_back(setting.name + "=" + to_text(setting, choice.values.at(setting.name)));
  return fmt::format("{}", fmt::join(parts, " "));
}

}  // namespace plenolab
