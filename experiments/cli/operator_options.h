#pragma once

#include <string>
#include <vector>

#include "core/tonemap/operator.h"

namespace CLI {
class App;
}

namespace plenolab {

/// A tone mapping operator as typed on a command line.
struct OperatorOptions {
  std::string name, variant;
  std::vector<std::string> settings;  ///< "name=value" each
};

/// What was chosen: an operator, one of its variants and all settings.
struct OperatorChoice {
  const OperatorInfo* info = nullptr;  ///< of the table of operators, which lives as long as the program
  OperatorVariant variant;
  bool adjusted = false;  ///< whether key-view adjustment follows
  SettingValues values;

  /// As it is typed: "joint", "naive+adjusted" …
  std::string variant_name() const;
  bool maps_frames() const { return variant.scope == OperatorScope::kFrame; }
};

/// Declares --operator, --variant and --set.
void add_operator_options(CLI::App& app, OperatorOptions& options);

/// Resolves the options. The variant is the operator's first by default; for light fields "adjusted" stands
/// for key-view adjustment after the first one, and "VARIANT+adjusted" after another. Throws UsageError that
/// names the option, the word and what there is.
OperatorChoice choose_operator(const OperatorOptions& options);

/// Throws UsageError if the choice cannot map a single image or the views of a light field by themselves.
void require_view_variant(const OperatorChoice& choice);
/// Throws UsageError if key-view adjustment was chosen for a single image.
void require_not_adjusted(const OperatorChoice& choice);

/// One word for a scope: "view", "light-field" or "frame".
std::string scope_name(OperatorScope scope);

/// "name=value name=value …" of all settings, for provenance.
std::string settings_text(const OperatorChoice& choice);

}  // namespace plenolab
