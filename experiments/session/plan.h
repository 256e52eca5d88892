#pragma once

#include <string>
#include <vector>

#include "experiments/session/study.h"

namespace plenolab {

/// One trial: the reference, and two comparisons of which one is equal to it.
struct PlannedTrial {
  std::string image;  ///< id
  bool catch_trial = false;
  bool test_first = false;  ///< whether the left trigger shows the test image
  friend bool operator==(const PlannedTrial&, const PlannedTrial&) = default;
};

struct PlannedBlock {
  std::string block;  ///< id
  std::vector<PlannedTrial> trials;
  friend bool operator==(const PlannedBlock&, const PlannedBlock&) = default;
};

/// What one participant goes through.
struct SessionPlan {
  std::string order;  ///< name of the block order
  std::vector<PlannedBlock> blocks;
};

/// The plan of participant `number` ≥ 1: a pure function of study and number, so that a session goes on after
/// any interruption exactly as it was planned. Blocks: orders in turn. Images of a block: a permutation, all
/// equally likely. Side of the test image: left or right with equal chance, independent from trial to trial.
SessionPlan plan_session(const StudyDefinition& study, int number);

}  // namespace plenolab
