#include "analysis/pareto.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The definition, comparing every pair.
std::vector<bool> brute_force(const std::vector<double>& a, double sign_a, const std::vector<double>& b,
                              double sign_b) {
  std::vector<bool> front(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    front[i] = !std::isnan(a[i]) && !std::isnan(b[i]);
    for (std::size_t j = 0; j < a.size(); ++j) {
      const bool no_worse = sign_a * a[j] <= sign_a * a[i] && sign_b * b[j] <= sign_b * b[i];
      const bool better = sign_a * a[j] < sign_a * a[i] || sign_b * b[j] < sign_b * b[i];
      if (no_worse && better) front[i] = false;
    }
  }
  return front;
}

TEST(Pareto, AgreesWithComparingEveryPair) {
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    RandomStream random(1, 2, trial);
    std::vector<double> a, b;
    const int count = static_cast<int>(random.next_u64() % 30);
    const auto draw = [&] {
      const std::uint64_t v = random.next_u64() % 12;  // few values: many ties
      return v == 0 ? kNan : v == 1 ? kInfinity : v == 2 ? -kInfinity : static_cast<double>(v);
    };
    for (int i = 0; i < count; ++i) a.push_back(draw()), b.push_back(draw());
    EXPECT_EQ(pareto_front(a, b), brute_force(a, 1, b, 1)) << trial;
    EXPECT_EQ(pareto_front(a, Goal::kMaximise, b, Goal::kMinimise), brute_force(a, -1, b, 1)) << trial;
    EXPECT_EQ(pareto_front(a, Goal::kMaximise, b, Goal::kMaximise), brute_force(a, -1, b, -1)) << trial;
  }
}

TEST(Pareto, KeepsEqualPointsTogether) {
  const std::vector<double> error{1, 1, 2, 3}, seconds{5, 5, 4, 4};
  EXPECT_EQ(pareto_front(error, seconds), (std::vector<bool>{true, true, true, false}));
}

TEST(Pareto, NeedsAsManyValuesOfBothObjectives) {
  const std::vector<double> two{1, 2}, three{1, 2, 3};
  EXPECT_THROW(pareto_front(two, three), InputError);
}

}  // namespace
}  // namespace plenolab
