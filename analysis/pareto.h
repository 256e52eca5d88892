#pragma once

#include <span>
#include <vector>

namespace plenolab {

/// Which values of an objective are wanted.
enum class Goal { kMinimise, kMaximise };

/// For each point (first[i], second[i]): is it on the Pareto front, i.e. is there no other point at least as
/// good in both objectives and better in one? Equal points are on the front together. Points with a NaN never
/// are; infinite values compare as usual. O(n log n). Throws InputError if the numbers of values differ.
std::vector<bool> pareto_front(std::span<const double> first, Goal first_goal, std::span<const double> second,
                               Goal second_goal);

/// The usual case: small error in little time.
inline std::vector<bool> pareto_front(std::span<const double> error, std::span<const double> seconds) {
  return pareto_front(error, Goal::kMinimise, seconds, Goal::kMinimise);
}

}  // namespace plenolab
