#include "analysis/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/error.h"

namespace plenolab {

std::vector<bool> pareto_front(std::span<const double> first, Goal first_goal, std::span<const double> second,
                               Goal second_goal) {
  if (first.size() != second.size()) {
    throw InputError(fmt::format("a Pareto front needs as many values of both objectives, not {} and {}",
                                 first.size(), second.size()));
  }
  const auto cost = [](double value, Goal goal) { return goal == Goal::kMinimise ? value : -value; };
  const auto x = [&](std::size_t i) { return cost(first[i], first_goal); };
  const auto y = [&](std::size_t i) { return cost(second[i], second_goal); };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!std::isnan(first[i]) && !std::isnan(second[i])) order.push_back(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return x(a) != x(b) ? x(a) < x(b) : y(a) < y(b); });
  // In order of the first cost, a point is on the front if its second cost is below all before, or equals the
  // last point put on the front.
  std::vector<bool> front(first.size(), false);
  for (std::size_t k = 0, last = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    const bool better = k == 0 || y(i)<y(last), equal = k> 0 && x(i) == x(last) && y(i) == y(last);
    if (better || equal) front[i] = true;
    if (better) last = i;
  }
  return front;
}

}  // namespace plenolab
