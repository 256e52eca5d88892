#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/measures.h"

namespace plenolab {

/// The figures that show two neighbouring key views (28 to 30 of the thesis): the same pairs in all of them,
/// those that the naive Reinhard 2005 changes most.

/// Two neighbouring key views of a scene and what the naive variant adds between them.
struct KeyViewPair {
  std::string scene, title;
  PairChange naive;
};

/// The pair of the scene whose surfaces under the same light change most in mean luma, of those that share a
/// twentieth of their pixels; nothing if none do.
std::optional<KeyViewPair> most_changed_pair(MappingBench& bench, const std::string& scene);

/// Such pairs of the Cellar, the Desk and the Dunes.
std::vector<KeyViewPair> most_changed_pairs(MappingBench& bench);

struct PairPictures {
  std::vector<Shown> mappings;
  bool factor = false;  ///< also what the last mapping makes of the luma of the first
};

/// What each mapping changes between the two views of one pair.
struct ShownPair {
  KeyViewPair pair;
  std::vector<LineChange> changes;  ///< in the order of the mappings
};

/// Adds for each pair a comparison of both views and of the change from the first to the second along
/// epipolar lines, with every mapping, and a table of all changes. Rows: pair_change_mean, pair_change_rms
/// (columns scene, mapping).
std::vector<ShownPair> show_pairs(ReproductionResult& result, MappingBench& bench,
                                  const std::vector<KeyViewPair>& pairs, const PairPictures& pictures);

/// "Cellar +0.0312 (RMS 0.0330), Desk …" of one of the mappings.
std::string change_words(const std::vector<ShownPair>& pairs, std::size_t mapping);

}  // namespace plenolab
