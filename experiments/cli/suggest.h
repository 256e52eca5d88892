#pragma once

#include <string>
#include <vector>

namespace plenolab {

/// The word of `known` that is most like `word` (fewest letters inserted, left out, changed or swapped; the
/// first of equals), or an empty text if none is near enough to have been meant.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean 'render'?", or an empty text if no known word is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace plenolab
