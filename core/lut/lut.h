#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace plenolab {

/// A colour look-up table: output colours on a lattice of `size` nodes along each of red, green and blue.
/// Inputs are encoded values (what a .png holds); outputs may leave [0, 1].
struct Lut {
  int size = 32;            ///< nodes along each axis, kSmallestLut to kLargestLut
  Rgb domain_min{0, 0, 0};  ///< input of the first node, by channel
  Rgb domain_max{1, 1, 1};  ///< input of the last node, above domain_min by at least kNarrowestDomain
  std::vector<Rgb> nodes;   ///< size³ outputs, red runs fastest, then green; at most ±kLargestLutNumber
  std::string title;        ///< free text of a .cube file, may be empty

  /// Throws InputError saying what is wrong.
  void validate() const;
  const Rgb& node(int r, int g, int b) const { return nodes[index(r, g, b)]; }
  Rgb& node(int r, int g, int b) { return nodes[index(r, g, b)]; }
  /// Input colour of a node, exactly domain_min and domain_max at the ends.
  Rgb input_of(int r, int g, int b) const;

 private:
  std::size_t index(int r, int g, int b) const {
    const auto n = static_cast<std::size_t>(size);
    return (static_cast<std::size_t>(b) * n + static_cast<std::size_t>(g)) * n + static_cast<std::size_t>(r);
  }
};

/// Limits of the .cube format (Adobe, Cube LUT Specification 1.0).
inline constexpr int kSmallestLut = 2, kLargestLut = 256;
/// Largest magnitude of outputs and of the domain's ends, and least width of the domain: what differences,
/// products and sums of 32 bits bear.
inline constexpr float kLargestLutNumber = 1e30f, kNarrowestDomain = 1e-30f;
/// Nodes along an axis where nothing else is asked for.
inline constexpr int kDefaultLutSize = 32;

/// The table of a function of colours in the domain. Throws InputError for a size or domain out of range or a
/// function that gives a value that a table cannot hold.
Lut bake_lut(int size, const std::function<Rgb(Rgb)>& function, Rgb domain_min = {0, 0, 0},
             Rgb domain_max = {1, 1, 1});

/// Outputs are the inputs.
Lut identity_lut(int size, Rgb domain_min = {0, 0, 0}, Rgb domain_max = {1, 1, 1});

/// Channels cut to what a picture can hold.
constexpr Rgb cut_to_unit(Rgb c) {
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

/// Cuts colours to [0, 1] and returns how many channel values were outside.
std::int64_t cut_all_to_unit(std::span<Rgb> colours);

/// How colours between nodes are found.
enum class LutInterpolation {
  kTrilinear,    ///< from the eight nodes around
  kTetrahedral,  ///< from four of them: the cell cut in six along its diagonal of grey, so that greys between
                 ///< grey nodes stay grey
};

/// Output of one colour, the definition that the rows of grade() are tested against. Colours outside the
/// domain take the nearest of it; NaN counts as its lower end. A node's input gives that node.
Rgb sample_lut(const Lut& lut, Rgb colour, LutInterpolation interpolation);

/// The table at another number of nodes over the same domain.
Lut resample_lut(const Lut& lut, int size, LutInterpolation interpolation);
/// The same over another domain; beyond its own the table gives the outputs of its ends. Throws InputError
/// for a size or domain out of range.
Lut resample_lut(const Lut& lut, int size, Rgb domain_min, Rgb domain_max, LutInterpolation interpolation);

/// A share of a blend.
struct WeightedLut {
  const Lut* lut = nullptr;
  double weight = 0;  ///< ≥ 0
};

/// Σ weightᵢ · lutᵢ at each node, which is also the blend of the graded images. Weights must sum to 1 (within
/// 1e-6) and domains agree; tables with fewer nodes are resampled to the largest size. Throws InputError.
Lut blend_luts(std::span<const WeightedLut> shares,
               LutInterpolation interpolation = LutInterpolation::kTetrahedral);

}  // namespace plenolab
