#include "core/lut/lut.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/lut/lattice.h"

namespace plenolab {

namespace {

/// Finite, and small enough to be interpolated.
bool bearable(Rgb c) {
  const auto within = [](float v) { return v >= -kLargestLutNumber && v <= kLargestLutNumber; };
  return within(c.r) && within(c.g) && within(c.b);
}

void check_domain(Rgb low, Rgb high) {
  const auto is_range = [](float from, float to) { return to - from >= kNarrowestDomain; };
  if (!(bearable(low) && bearable(high) && is_range(low.r, high.r) && is_range(low.g, high.g) &&
        is_range(low.b, high.b)))
    throw InputError(
        fmt::format("the domain of a look-up table goes from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}), but "
                    "must lie within ±{:g} and its minimum below its maximum",
                    low.r, low.g, low.b, high.r, high.g, high.b, kLargestLutNumber));
}

void check_size(int size) {
  if (size < kSmallestLut || size > kLargestLut)
    throw InputError(fmt::format("a look-up table has {} nodes along each axis but must have {} to {}", size,
                                 kSmallestLut, kLargestLut));
}

std::size_t cube_of(int size) {
  const auto n = static_cast<std::size_t>(size);
  return n * n * n;
}

std::string domain_text(const Lut& lut) {
  const Rgb low = lut.domain_min, high = lut.domain_max;
  if (low.r == low.g && low.g == low.b && high.r == high.g && high.g == high.b)
    return fmt::format("{:g} to {:g}", low.r, high.r);
  return fmt::format("({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", low.r, low.g, low.b, high.r, high.g, high.b);
}

template <class Function>
void for_each_node(int size, const Function& function) {
  for (int b = 0; b < size; ++b)
    for (int g = 0; g < size; ++g)
      for (int r = 0; r < size; ++r) function(r, g, b);
}

float node_input(float low, float high, int i, int size) {
  if (i == size - 1) return high;
  return static_cast<float>(low + (static_cast<double>(high) - low) * i / (size - 1));
}

Rgb mix(Rgb a, Rgb b, float t) {
  return a + (b - a) * t;
}

Rgb trilinear(const Lut& lut, const Cell& cell) {
  const auto at = [&](int r, int g, int b) {
    return lut.node(std::min(cell.r.node + r, lut.size - 1), std::min(cell.g.node + g, lut.size - 1),
                    std::min(cell.b.node + b, lut.size - 1));
  };
  const auto along_red = [&](int g, int b) { return mix(at(0, g, b), at(1, g, b), cell.r.fraction); };
  const auto along_green = [&](int b) { return mix(along_red(0, b), along_red(1, b), cell.g.fraction); };
  return mix(along_green(0), along_green(1), cell.b.fraction);
}

/// Walks from the cell's first corner to its last along the axes in descending order of their fractions.
Rgb tetrahedral(const Lut& lut, const Cell& cell) {
  const std::array<float, 3> fractions{cell.r.fraction, cell.g.fraction, cell.b.fraction};
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return fractions[static_cast<std::size_t>(a)] > fractions[static_cast<std::size_t>(b)];
  });
  std::array<int, 3> corner{cell.r.node, cell.g.node, cell.b.node};
  Rgb colour = lut.node(corner[0], corner[1], corner[2]);
  for (const int axis : order) {
    const auto k = static_cast<std::size_t>(axis);
    const Rgb before = lut.node(corner[0], corner[1], corner[2]);
    corner[k] = std::min(corner[k] + 1, lut.size - 1);
    colour += (lut.node(corner[0], corner[1], corner[2]) - before) * fractions[k];
  }
  return colour;
}

}  // namespace

void Lut::validate() const {
  check_size(size);
  if (nodes.size() != cube_of(size))
    throw InputError(
        fmt::format("a look-up table of {0} × {0} × {0} nodes holds {1} of them", size, nodes.size()));
  check_domain(domain_min, domain_max);
  const auto bad = std::ranges::find_if_not(nodes, bearable);
  if (bad != nodes.end())
    throw InputError(
        fmt::format("node {} of a look-up table is ({:g}, {:g}, {:g}), but must be finite and lie "
                    "within ±{:g}",
                    bad - nodes.begin(), bad->r, bad->g, bad->b, kLargestLutNumber));
}

Rgb Lut::input_of(int r, int g, int b) const {
  return {node_input(domain_min.r, domain_max.r, r, size), node_input(domain_min.g, domain_max.g, g, size),
          node_input(domain_min.b, domain_max.b, b, size)};
}

Lut bake_lut(int size, const std::function<Rgb(Rgb)>& function, Rgb domain_min, Rgb domain_max) {
  check_size(size);
  check_domain(domain_min, domain_max);
  Lut lut{size, domain_min, domain_max, {}, ""};
  lut.nodes.resize(cube_of(size));
  for_each_node(size, [&](int r, int g, int b) { lut.node(r, g, b) = function(lut.input_of(r, g, b)); });
  lut.validate();
  return lut;
}

Lut identity_lut(int size, Rgb domain_min, Rgb domain_max) {
  return bake_lut(
      size, [](Rgb c) { return c; }, domain_min, domain_max);
}

std::int64_t cut_all_to_unit(std::span<Rgb> colours) {
  std::int64_t changed = 0;
  for (Rgb& colour : colours) {
    const Rgb kept = cut_to_unit(colour);
    changed += (kept.r != colour.r ? 1 : 0) + (kept.g != colour.g ? 1 : 0) + (kept.b != colour.b ? 1 : 0);
    colour = kept;
  }
  return changed;
}

Rgb sample_lut(const Lut& lut, Rgb colour, LutInterpolation interpolation) {
  const Cell cell = cell_of(lattice_of(lut), colour);
  return interpolation == LutInterpolation::kTrilinear ? trilinear(lut, cell) : tetrahedral(lut, cell);
}

Lut resample_lut(const Lut& lut, int size, LutInterpolation interpolation) {
  return resample_lut(lut, size, lut.domain_min, lut.domain_max, interpolation);
}

Lut resample_lut(const Lut& lut, int size, Rgb domain_min, Rgb domain_max, LutInterpolation interpolation) {
  check_size(size);
  check_domain(domain_min, domain_max);
  Lut resampled{size, domain_min, domain_max, {}, lut.title};
  resampled.nodes.resize(cube_of(size));
  for_each_node(size, [&](int r, int g, int b) {
    resampled.node(r, g, b) = sample_lut(lut, resampled.input_of(r, g, b), interpolation);
  });
  return resampled;
}

Lut blend_luts(std::span<const WeightedLut> shares, LutInterpolation interpolation) {
  double sum = 0;
  int size = 0;
  for (const WeightedLut& share : shares) {
    if (!(share.weight >= 0)) throw InputError(fmt::format("a weight of {} is below 0", share.weight));
    const Lut& first = *shares.front().lut;
    if (share.lut->domain_min != first.domain_min || share.lut->domain_max != first.domain_max)
      throw InputError(fmt::format("look-up tables of the domains {} and {} cannot be blended",
                                   domain_text(first), domain_text(*share.lut)));
    sum += share.weight;
    size = std::max(size, share.lut->size);
  }
  if (!(std::abs(sum - 1) <= 1e-6))
    throw InputError(fmt::format("the weights of a blend sum to {} and must sum to 1", sum));
  Lut blend{size, shares.front().lut->domain_min, shares.front().lut->domain_max, {}, ""};
  blend.nodes.resize(cube_of(size));
  for (const WeightedLut& share : shares) {
    if (share.weight == 0) continue;
    const Lut resampled = share.lut->size == size ? Lut{} : resample_lut(*share.lut, size, interpolation);
    const std::vector<Rgb>& nodes = share.lut->size == size ? share.lut->nodes : resampled.nodes;
    const auto weight = static_cast<float>(share.weight);
    for (std::size_t i = 0; i < nodes.size(); ++i) blend.nodes[i] += nodes[i] * weight;
  }
  return blend;
}

}  // namespace plenolab
