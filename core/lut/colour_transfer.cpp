#include "core/lut/colour_transfer.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/base/random.h"
#include "core/image/cielab.h"

namespace plenolab {

namespace {

using Vector = Eigen::Vector3d;
using Colours = std::vector<Vector>;

constexpr std::uint64_t kRotationPurpose = 0x706974696572ull;  // keeps these random words apart from others
constexpr std::uint64_t kDirectionPurpose = 0x736c69636564ull;
constexpr int kDistanceDirections = 32, kDistanceQuantiles = 101;
/// Pixels of each picture that distances are measured on.
constexpr int kMeasured = 20000;

/// Uniform over all rotations (Shoemake 1992).
Eigen::Matrix3d random_rotation(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index) {
  RandomStream random(seed, purpose, index);
  const double u = random.next_double(), v = 2 * std::numbers::pi * random.next_double(),
               w = 2 * std::numbers::pi * random.next_double();
  const double a = std::sqrt(1 - u), b = std::sqrt(u);
  return Eigen::Quaterniond(a * std::sin(v), a * std::cos(v), b * std::sin(w), b * std::cos(w))
      .toRotationMatrix();
}

Vector vector_of(CieLab c) {
  return {c.l, c.a, c.b};
}

/// Evenly spaced pixels, all if there are no more.
std::vector<Rgb> sampled(const DisplayImage& image, int samples, double offset = 0) {
  const std::size_t count = std::min(image.size(), static_cast<std::size_t>(samples));
  const double step = static_cast<double>(image.size()) / static_cast<double>(count);
  std::vector<Rgb> pixels;
  pixels.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    pixels.push_back(image.pixels()[static_cast<std::size_t>((static_cast<double>(i) + offset) * step)]);
  return pixels;
}

Colours lab_of(const std::vector<Rgb>& pixels) {
  Colours colours;
  colours.reserve(pixels.size());
  for (const Rgb& pixel : pixels) colours.push_back(vector_of(lab_of_display(pixel)));
  return colours;
}

std::vector<double> sorted_along(const Colours& colours, const Vector& axis) {
  std::vector<double> values;
  values.reserve(colours.size());
  for (const Vector& colour : colours) values.push_back(axis.dot(colour));
  std::ranges::sort(values);
  return values;
}

std::vector<double> quantiles_of(const std::vector<double>& sorted, int count) {
  std::vector<double> quantiles;
  for (int i = 0; i < count; ++i)
    quantiles.push_back(
        quantile_of_sorted(std::span<const double>(sorted), static_cast<double>(i) / (count - 1)));
  return quantiles;
}

/// A monotone piecewise linear map; outside its knots the shift of the nearest one.
struct AxisMap {
  std::vector<double> from, to;  ///< from strictly increasing

  double operator()(double value) const {
    if (value <= from.front()) return value + to.front() - from.front();
    if (value >= from.back()) return value + to.back() - from.back();
    const auto above = static_cast<std::size_t>(std::ranges::upper_bound(from, value) - from.begin());
    const double t = (value - from[above - 1]) / (from[above] - from[above - 1]);
    return to[above - 1] + t * (to[above] - to[above - 1]);
  }
};

/// Equal quantiles of the source become one knot with the mean of the target's.
AxisMap map_between(const std::vector<double>& source, const std::vector<double>& target) {
  AxisMap map;
  for (std::size_t i = 0; i < source.size();) {
    std::size_t end = i;
    double sum = 0;
    for (; end < source.size() && source[end] == source[i]; ++end) sum += target[end];
    map.from.push_back(source[i]);
    map.to.push_back(sum / static_cast<double>(end - i));
    i = end;
  }
  return map;
}

struct Step {
  Eigen::Matrix3d rotation;
  std::array<AxisMap, 3> maps;

  Vector operator()(const Vector& colour) const {
    Vector turned = rotation * colour;
    for (int k = 0; k < 3; ++k) turned[k] = maps[static_cast<std::size_t>(k)](turned[k]);
    return rotation.transpose() * turned;
  }
};

Step fit_step(const Colours& source, const Colours& target, const ColourTransferOptions& options,
              int iteration) {
  Step step;
  // The first iteration matches lightness and the two axes of colour themselves.
  step.rotation =
      iteration == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                     : random_rotation(options.seed, kRotationPurpose, static_cast<std::uint64_t>(iteration));
  for (int k = 0; k < 3; ++k) {
    const Vector axis = step.rotation.row(k).transpose();
    step.maps[static_cast<std::size_t>(k)] =
        map_between(quantiles_of(sorted_along(source, axis), options.quantiles),
                    quantiles_of(sorted_along(target, axis), options.quantiles));
  }
  return step;
}

double distance_between(const Colours& a, const Colours& b) {
  double sum = 0;
  for (int i = 0; i < kDistanceDirections; ++i) {
    const Vector axis =
        random_rotation(0, kDirectionPurpose, static_cast<std::uint64_t>(i)).row(0).transpose();
    const auto of_a = quantiles_of(sorted_along(a, axis), kDistanceQuantiles);
    const auto of_b = quantiles_of(sorted_along(b, axis), kDistanceQuantiles);
    for (std::size_t q = 0; q < of_a.size(); ++q) sum += std::abs(of_a[q] - of_b[q]);
  }
  return sum / (kDistanceDirections * kDistanceQuantiles);
}

Rgb replay(const std::vector<Step>& steps, double amount, Rgb input) {
  const Vector before = vector_of(lab_of_display(input));
  Vector after = before;
  for (const Step& step : steps) after = step(after);
  const Vector mixed = before + amount * (after - before);
  return cut_to_unit(display_of_lab({mixed[0], mixed[1], mixed[2]}));
}

/// On pixels of their own, half-way between those that an evenly spaced fit takes.
void measure(ColourTransfer& transfer, const DisplayImage& source, const DisplayImage& target) {
  const std::vector<Rgb> pixels = sampled(source, kMeasured, 0.5);
  const Colours wanted = lab_of(sampled(target, kMeasured, 0.5));
  const auto distance_of = [&](const auto& graded) {
    std::vector<Rgb> changed;
    for (const Rgb& pixel : pixels) changed.push_back(graded(pixel));
    return distance_between(lab_of(changed), wanted);
  };
  transfer.distance_before = distance_between(lab_of(pixels), wanted);
  transfer.distance_unbaked = distance_of(transfer.exact);
  transfer.distance_after =
      distance_of([&](Rgb c) { return sample_lut(transfer.lut, c, LutInterpolation::kTetrahedral); });
}

}  // namespace

void ColourTransferOptions::validate() const {
  if (iterations < 1) throw InputError(fmt::format("iterations are {} but must be ≥ 1", iterations));
  if (quantiles < 2) throw InputError(fmt::format("quantiles are {} but must be ≥ 2", quantiles));
  if (samples < 2) throw InputError(fmt::format("samples are {} but must be ≥ 2", samples));
  if (!(amount >= 0 && amount <= 1))
    throw InputError(fmt::format("the amount of a transfer is {} but must lie in [0, 1]", amount));
}

ColourTransfer transfer_colours(const DisplayImage& source, const DisplayImage& target,
                                const ColourTransferOptions& options) {
  options.validate();
  if (source.empty() || target.empty()) throw InputError("an empty picture has no colours to transfer");
  const Colours wanted = lab_of(sampled(target, options.samples));
  Colours moved = lab_of(sampled(source, options.samples));
  const auto steps = std::make_shared<std::vector<Step>>();
  for (int i = 0; i < options.iterations; ++i) {
    steps->push_back(fit_step(moved, wanted, options, i));
    for (Vector& colour : moved) colour = steps->back()(colour);
  }
  ColourTransfer transfer;
  transfer.exact = [steps, amount = options.amount](Rgb c) { return replay(*steps, amount, c); };
  transfer.lut = bake_lut(options.size, transfer.exact);
  measure(transfer, source, target);
  return transfer;
}

}  // namespace plenolab
