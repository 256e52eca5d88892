#pragma once

#include <string>

namespace plenolab {

/// A stage that was left out because it provably could not change the result.
struct PrunedStage {
  std::string stage;   ///< e.g. "medium", "disocclusion test"
  std::string reason;  ///< one sentence with the values that prove it
  friend bool operator==(const PrunedStage&, const PrunedStage&) = default;
};

}  // namespace plenolab
