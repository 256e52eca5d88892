#pragma once

#include <cstdint>

namespace plenolab {

/// Mixes one 64-bit word so that every input bit affects every output bit (finaliser of SplitMix64,
/// Steele, Lea & Flood 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Random word as a pure function of (seed, purpose, index): no shared state, the same on every platform and
/// for every order of evaluation. `purpose` keeps the uses of one seed apart (any constant unique to the call
/// site).
constexpr std::uint64_t random_u64(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index) {
  return mix64(mix64(mix64(seed) ^ purpose) ^ index);
}

/// Uniform in [0, 1), 24 bits, exactly representable in float.
constexpr float unit_float(std::uint64_t word) {
  return static_cast<float>(word >> 40) * 0x1.0p-24f;
}

/// Uniform in [0, 1), 53 bits.
constexpr double unit_double(std::uint64_t word) {
  return static_cast<double>(word >> 11) * 0x1.0p-53;
}

/// A stream of random words for one (seed, purpose, index): a counter hashed at each call.
class RandomStream {
 public:
  constexpr RandomStream(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index)
      : key_(random_u64(seed, purpose, index)) {}
  constexpr std::uint64_t next_u64() { return mix64(key_ + 0x9e3779b97f4a7c15ull * counter_++); }
  constexpr float next_float() { return unit_float(next_u64()); }
  constexpr double next_double() { return unit_double(next_u64()); }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace plenolab
