#include "analysis/evolution_strategy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kPurpose = 0x65766f6c7665ull;  // keeps these random words apart from others

/// Standard normal deviate number `index` of an iteration (Box & Muller 1958).
double normal_deviate(std::uint64_t seed, int iteration, std::uint64_t index) {
  RandomStream random(seed, kPurpose + static_cast<std::uint64_t>(iteration), index);
  const double u = random.next_double(), v = random.next_double();
  return std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
}

void check_parameters(std::span<const SearchParameter> parameters) {
  if (parameters.empty()) throw InputError("there is no parameter to optimise");
  for (const SearchParameter& p : parameters)
    if (!(p.minimum < p.maximum && p.start >= p.minimum && p.start <= p.maximum))
      throw InputError(fmt::format("parameter {} starts at {} but must start within {} … {}", p.name, p.start,
                                   p.minimum, p.maximum));
}

std::vector<std::vector<double>> draw_children(std::span<const SearchParameter> parameters,
                                               const std::vector<double>& best,
                                               const EvolutionOptions& options, double deviation,
                                               int iteration) {
  std::vector<std::vector<double>> children(static_cast<std::size_t>(options.children), best);
  std::uint64_t index = 0;
  for (std::vector<double>& child : children)
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const SearchParameter& p = parameters[k];
      const double unit = options.relative_deviation ? p.maximum - p.minimum : 1;
      child[k] = std::clamp(best[k] + deviation * unit * normal_deviate(options.seed, iteration, index++),
                            p.minimum, p.maximum);
    }
  return children;
}

}  // namespace

void EvolutionOptions::validate() const {
  const auto require = [](bool good, const char* what, auto value) {
    if (!good) throw InputError(fmt::format("{}, not {}", what, value));
  };
  require(children >= 1, "the number of children must be ≥ 1", children);
  require(deviation > 0 && std::isfinite(deviation), "the deviation must be > 0", deviation);
  require(shrink > 0 && shrink <= 1, "the shrinking of the deviation must lie in (0, 1]", shrink);
  require(least_change >= 0, "the least change must be ≥ 0", least_change);
  require(patience >= 1, "the patience must be ≥ 1 iteration", patience);
  require(most_iterations >= 0, "the number of iterations must be ≥ 0", most_iterations);
}

Evolution minimise_by_evolution(std::span<const SearchParameter> parameters, const ScoreAll& score,
                                const EvolutionOptions& options,
                                const std::function<void(const EvolutionStep&)>& progress) {
  options.validate();
  check_parameters(parameters);
  Evolution evolution;
  for (const SearchParameter& p : parameters) evolution.best.push_back(p.start);
  int evaluations = 1;
  const auto scored = [&](std::span<const std::vector<double>> candidates) {
    std::vector<double> scores = score(candidates);
    PLENOLAB_CHECK(scores.size() == candidates.size(), "one score for each candidate");
    return scores;
  };
  const auto record = [&](int iteration, double deviation) {
    evolution.trace.push_back({iteration, deviation, evolution.score, evolution.best, evaluations});
    if (progress) progress(evolution.trace.back());
  };
  evolution.score = scored(std::vector<std::vector<double>>{evolution.best}).front();
  if (!std::isfinite(evolution.score)) throw InputError("the start of the optimisation has no finite score");
  record(0, 0);
  double deviation = options.deviation;
  int without_progress = 0;
  for (int i = 1; i <= options.most_iterations && without_progress < options.patience; ++i) {
    const auto children = draw_children(parameters, evolution.best, options, deviation, i);
    const std::vector<double> scores = scored(children);
    evaluations += options.children;
    const double before = evolution.score;
    for (std::size_t c = 0; c < children.size(); ++c)
      if (scores[c] < evolution.score) {  // false for NaN
        evolution.score = scores[c];
        evolution.best = children[c];
      }
    without_progress = before - evolution.score < options.least_change ? without_progress + 1 : 0;
    record(i, deviation);
    deviation *= options.shrink;
  }
  evolution.converged = without_progress >= options.patience;
  return evolution;
}

}  // namespace plenolab
