#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "stimuli/tracer/sampler.h"

namespace plenolab::tracer {
namespace {

TEST(Sampler, EveryPowerOfTwoOfSamplesFillsAllElementaryBoxesOnce) {
  for (const std::uint64_t seed : {1ull, 77ull, 123456789ull})
    for (const std::uint32_t dimension : {0u, 1u, 40u})
      for (std::uint32_t m = 0; m <= 8; ++m)
        for (std::uint32_t a = 0; a <= m; ++a) {
          std::set<std::pair<int, int>> boxes;
          for (std::uint32_t i = 0; i < (1u << m); ++i) {
            const auto [u, v] = PathSampler(seed, i).get_2d(dimension);
            boxes.insert({static_cast<int>(std::ldexp(u, static_cast<int>(a))),
                          static_cast<int>(std::ldexp(v, static_cast<int>(m - a)))});
          }
          EXPECT_EQ(boxes.size(), 1u << m);
        }
}

TEST(Sampler, EverySixteenConsecutiveSamplesReachAllSubpixelsOnce) {
  for (std::uint32_t first = 0; first < 160; first += 16) {
    std::set<int> subpixels;
    for (std::uint32_t i = first; i < first + 16; ++i) {
      const auto [u, v] = PathSampler(5, i).get_2d(0);
      subpixels.insert(static_cast<int>(v * 4) * 4 + static_cast<int>(u * 4));
    }
    EXPECT_EQ(subpixels.size(), 16u);
  }
}

TEST(Sampler, ThePartsOfBranchingPathsAreOneStratifiedSet) {
  std::set<std::pair<int, int>> boxes;
  for (std::uint32_t i = 0; i < 16; ++i)
    for (std::uint32_t part = 0; part < 4; ++part) {
      const auto [u, v] = PathSampler(7, i).split(part, 4).get_2d(11);
      boxes.insert({static_cast<int>(u * 8), static_cast<int>(v * 8)});
    }
  EXPECT_EQ(boxes.size(), 64u);
}

TEST(Sampler, OneDimensionIsStratifiedToo) {
  std::set<int> strata;
  for (std::uint32_t i = 0; i < 64; ++i) strata.insert(static_cast<int>(PathSampler(9, i).get_1d(3) * 64));
  EXPECT_EQ(strata.size(), 64u);
}

TEST(Sampler, DimensionsAndPixelsAreUncorrelated) {
  const auto correlation = [](auto first, auto second) {
    double sum = 0;
    for (std::uint32_t i = 0; i < 4096; ++i)
      sum += (static_cast<double>(first(i)) - 0.5) * (static_cast<double>(second(i)) - 0.5);
    return sum / 4096 * 12;
  };
  const auto value = [](std::uint64_t seed, std::uint32_t dimension) {
    return [=](std::uint32_t i) { return PathSampler(mix64(seed), i).get_2d(dimension)[0]; };
  };
  // Five standard deviations of 4096 independent pairs.
  EXPECT_LT(std::abs(correlation(value(1, 1), value(1, 2))), 5.0 / 64);
  EXPECT_LT(std::abs(correlation(value(1, 1), value(2, 1))), 5.0 / 64);
}

}  // namespace
}  // namespace plenolab::tracer
