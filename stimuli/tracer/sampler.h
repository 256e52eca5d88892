#pragma once

#include <array>
#include <cstdint>

#include "core/base/random.h"

namespace plenolab::tracer {

/// Reverses the order of the bits of a word.
constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Nested uniform (Owen) scrambling by the hash of Laine and Karras 2011 with the constants of Vegdahl 2021;
/// see Burley 2020, "Practical hash-based Owen scrambling".
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x);
}

/// The first two dimensions of the Sobol sequence: van der Corput and the Pascal matrix, as 32-bit fractions.
/// Every aligned run of 2^m points has one point in each of the 2^m boxes of every shape 2^-a × 2^-b, a + b =
/// m.
constexpr std::array<std::uint32_t, 2> sobol_2d(std::uint32_t index) {
  std::uint32_t pascal = index;
  pascal ^= (pascal & 0xaaaaaaaau) >> 1;
  pascal ^= (pascal & 0xccccccccu) >> 2;
  pascal ^= (pascal & 0xf0f0f0f0u) >> 4;
  pascal ^= (pascal & 0xff00ff00u) >> 8;
  pascal ^= (pascal & 0xffff0000u) >> 16;
  return {reverse_bits(index), reverse_bits(pascal)};
}

/// Sample `index` of one pixel's set: for every dimension an independently shuffled and Owen-scrambled Sobol
/// pair
/// ("padding", Burley 2020). A pure function of (pixel seed, index, dimension), so leaving out a dimension
/// does not move the others. Over the samples of a pixel each pair is stratified in two dimensions.
class PathSampler {
 public:
  constexpr PathSampler(std::uint64_t pixel_seed, std::uint32_t index) : seed_(pixel_seed), index_(index) {}

  /// The sampler of part `part` of `parts` (a power of two) where a path branches: the parts of all paths of
  /// a pixel are again one stratified set.
  constexpr PathSampler split(std::uint32_t part, std::uint32_t parts) const {
    PathSampler result = *this;
    result.index_ = index_ * parts + part;
    return result;
  }

  constexpr std::array<float, 2> get_2d(std::uint32_t dimension) const {
    const std::uint64_t words = mix64(seed_ + 0x9e3779b97f4a7c15ull * (2ull * dimension + 1));
    const auto low = static_cast<std::uint32_t>(words);
    const auto high = static_cast<std::uint32_t>(words >> 32);
    const auto point = sobol_2d(owen_scramble(index_, low));
    return {unit(owen_scramble(point[0], high)), unit(owen_scramble(point[1], high * 0x9e3779b9u + low))};
  }

  constexpr float get_1d(std::uint32_t dimension) const {
    const std::uint64_t words = mix64(seed_ + 0x9e3779b97f4a7c15ull * (2ull * dimension + 1));
    const auto shuffled = owen_scramble(index_, static_cast<std::uint32_t>(words));
    return unit(owen_scramble(reverse_bits(shuffled), static_cast<std::uint32_t>(words >> 32)));
  }

 private:
  static constexpr float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1.0p-24f; }
  std::uint64_t seed_;
  std::uint32_t index_;
};

}  // namespace plenolab::tracer
