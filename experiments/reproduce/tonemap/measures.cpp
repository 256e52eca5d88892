#include "experiments/reproduce/tonemap/measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "experiments/reproduce/claims/claim_statistics.h"

namespace plenolab {

namespace {

constexpr float kSameSurface_px = 0.25f;
constexpr double kRegionShare = 0.1;

/// Squares of differences of neighbouring pixels.
struct PairSquares {
  double sum = 0, largest = 0;
  std::int64_t pairs = 0;
  void add(float difference) {
    largest = std::max(largest, static_cast<double>(std::abs(difference)));
    sum += static_cast<double>(difference) * static_cast<double>(difference);
    ++pairs;
  }
  double mean() const { return pairs > 0 ? sum / static_cast<double>(pairs) : 0; }
};

/// Pixels whose eight neighbours show the same surface: edges of other surfaces colour those beside them.
Mask inside_surfaces(const DisparityMap& disparity) {
  Mask inner(disparity.width(), disparity.height());
  for (int y = 1; y + 1 < disparity.height(); ++y)
    for (int x = 1; x + 1 < disparity.width(); ++x) {
      bool same = true;
      for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
          same = same && std::abs(disparity.at(u, v) - disparity.at(x, y)) <= kSameSurface_px;
      inner.at(x, y) = same ? 1 : 0;
    }
  return inner;
}

/// Neighbouring pixels.
struct PixelPair {
  int x = 0, y = 0, u = 0, v = 0;
};

/// All pairs of neighbouring pixels inside one surface that some key view sees, and whether the key views
/// that see them differ: `receive(pair, across_border)`.
template <class Receive>
void for_each_surface_pair(const ReferenceFrame& frame, const Receive& receive) {
  const Mask inner = inside_surfaces(frame.disparity_px);
  const auto visit = [&](const PixelPair& pair) {
    const std::uint8_t here = frame.contributors.at(pair.x, pair.y),
                       there = frame.contributors.at(pair.u, pair.v);
    if (here == 0 || there == 0 || !inner.at(pair.x, pair.y) || !inner.at(pair.u, pair.v)) return;
    receive(pair, here != there);
  };
  for (int y = 0; y < inner.height(); ++y)
    for (int x = 0; x < inner.width(); ++x) {
      if (x + 1 < inner.width()) visit({x, y, x + 1, y});
      if (y + 1 < inner.height()) visit({x, y, x, y + 1});
    }
}

double border_region_of(const Plane<float>& difference) {
  const int w = difference.width(), h = difference.height();
  const int dx = static_cast<int>(kRegionShare * w), dy = static_cast<int>(kRegionShare * h);
  double sums[2] = {0, 0};
  std::int64_t counts[2] = {0, 0};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int inner = x >= dx && x < w - dx && y >= dy && y < h - dy ? 1 : 0;
      sums[inner] += static_cast<double>(difference.at(x, y));
      ++counts[inner];
    }
  if (counts[0] == 0 || counts[1] == 0) return 0;
  return sums[0] / static_cast<double>(counts[0]) - sums[1] / static_cast<double>(counts[1]);
}

constexpr int kLumaBins = 64;

/// Difference of luma from the reference, less its mean over pixels of the same reference luma.
Plane<float> unexplained_difference(const DisplayImage& test, const DisplayImage& reference) {
  Plane<float> difference = luma_difference(test, reference);
  std::vector<int> bins(test.size());
  std::array<double, kLumaBins> sums{};
  std::array<std::int64_t, kLumaBins> counts{};
  for (std::size_t n = 0; n < test.size(); ++n) {
    bins[n] = std::clamp(static_cast<int>(luminance(reference.pixels()[n]) * kLumaBins), 0, kLumaBins - 1);
    sums[static_cast<std::size_t>(bins[n])] += static_cast<double>(difference.pixels()[n]);
    ++counts[static_cast<std::size_t>(bins[n])];
  }
  for (std::size_t n = 0; n < test.size(); ++n) {
    const auto bin = static_cast<std::size_t>(bins[n]);
    difference.pixels()[n] -= static_cast<float>(sums[bin] / static_cast<double>(counts[bin]));
  }
  return difference;
}

}  // namespace

std::vector<PairChange> pair_changes(const LightField& hdr, const DisplayLightField& mapped,
                                     Neighbours neighbours, int threads, int distance) {
  const ViewGrid& grid = hdr.grid();
  std::vector<PairChange> pairs;
  const auto compare = [&](int column, int row, bool down) {
    const int to_column = column + (down ? 0 : distance), to_row = row + (down ? distance : 0);
    const auto a = hdr.view(column, row), b = hdr.view(to_column, to_row);
    const auto mapped_a = mapped.view(column, row), mapped_b = mapped.view(to_column, to_row);
    const ViewMotion motion{static_cast<double>(to_column - column), (to_row - row) * grid.vertical_ratio()};
    const LineChange change =
        change_along_lines({mapped_a->colour, a->colour, a->disparity},
                           {mapped_b->colour, b->colour, b->disparity}, motion, {.threads = threads});
    if (change.share >= kEnoughOfAFrame)
      pairs.push_back({column, row, down, change, log_peak(b->colour) - log_peak(a->colour)});
  };
  if (neighbours != Neighbours::kDown)
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column + distance < grid.columns; ++column) compare(column, row, false);
  if (neighbours != Neighbours::kAcross)
    for (int row = 0; row + distance < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) compare(column, row, true);
  return pairs;
}

std::vector<double> brightness_changes(std::span<const PairChange> pairs) {
  std::vector<double> values;
  for (const PairChange& pair : pairs) values.push_back(std::abs(pair.change.mean));
  return values;
}

std::vector<double> rms_changes(std::span<const PairChange> pairs) {
  std::vector<double> values;
  for (const PairChange& pair : pairs) values.push_back(pair.change.rms);
  return values;
}

Plane<float> luma_difference(const DisplayImage& image, const DisplayImage& other) {
  Plane<float> difference(image.width(), image.height());
  for (std::size_t n = 0; n < image.size(); ++n)
    difference.pixels()[n] = luminance(image.pixels()[n]) - luminance(other.pixels()[n]);
  return difference;
}

BorderStep border_step(const Plane<float>& values, const ReferenceFrame& frame) {
  PairSquares border, inside;
  for_each_surface_pair(frame, [&](const PixelPair& pair, bool across_border) {
    (across_border ? border : inside).add(values.at(pair.u, pair.v) - values.at(pair.x, pair.y));
  });
  return {std::sqrt(std::max(0.0, border.mean() - inside.mean())), border.largest};
}

Plane<float> border_step_weights(const Plane<float>& values, const ReferenceFrame& frame) {
  Plane<float> weights(values.width(), values.height());
  for_each_surface_pair(frame, [&](const PixelPair& pair, bool across_border) {
    if (!across_border) return;
    const float step = values.at(pair.u, pair.v) - values.at(pair.x, pair.y);
    weights.at(pair.x, pair.y) += step * step;
  });
  return weights;
}

std::vector<DisplayImage> frames_mapped_alike(MappingBench& bench, const std::string& scene,
                                              const Mapping& mapping,
                                              std::span<const ReferenceFrame> frames) {
  FrameMapper mapper(bench.laboratory().light_field(scene), bench.statistics(scene), mapping.choice,
                     {.threads = bench.threads()});
  std::vector<DisplayImage> images;
  for (const ReferenceFrame& frame : frames)
    images.push_back(mapper.map(frame.hdr, &frame.disparity_px, frame.position).image);
  return images;
}

Mapping with_one_fit(const Mapping& mapping) {
  Mapping single = mapping;
  single.choice.adjusted = false;
  if (mapping.choice.variant.scope == OperatorScope::kLightField) return single;
  for (const OperatorVariant& variant : mapping.choice.info->variants)
    if (variant.scope == OperatorScope::kLightField) single.choice.variant = variant;
  PLENOLAB_CHECK(single.choice.variant.scope == OperatorScope::kLightField, mapping.label);
  return single;
}

std::vector<FrameInconsistency> frame_inconsistencies(MappingBench& bench, const std::string& scene,
                                                      const Mapping& mapping, const Mapping& reference,
                                                      std::span<const ReferenceFrame> frames) {
  const std::vector<DisplayImage> expected = mapping.place() == MappingPlace::kKeyViews
                                                 ? bench.frames(scene, reference, frames)
                                                 : frames_mapped_alike(bench, scene, reference, frames);
  std::vector<FrameInconsistency> result;
  bench.for_each_frame(scene, mapping, frames, [&](std::size_t i, FrameMapping&& frame) {
    const Plane<float> rest = unexplained_difference(frame.image, expected[i]);
    result.push_back({border_step(rest, frames[i]).rms, border_region_of(rest)});
  });
  return result;
}

std::vector<double> border_steps(std::span<const FrameInconsistency> frames) {
  std::vector<double> values;
  for (const FrameInconsistency& frame : frames) values.push_back(frame.border_step);
  return values;
}

std::vector<double> border_regions(std::span<const FrameInconsistency> frames) {
  std::vector<double> values;
  for (const FrameInconsistency& frame : frames) values.push_back(std::abs(frame.border_region));
  return values;
}

std::optional<Interval> mean_ratio(std::span<const double> numerator, std::span<const double> denominator,
                                   std::uint64_t seed, int block_length) {
  PLENOLAB_CHECK(numerator.size() == denominator.size(), "pairs");
  if (numerator.size() < 2) return std::nullopt;
  const auto ratio = [&](std::span<const double> drawn) {
    double above = 0, below = 0;
    for (const double unit : drawn) {
      above += numerator[static_cast<std::size_t>(unit)];
      below += denominator[static_cast<std::size_t>(unit)];
    }
    return below > 0 ? above / below : 0;
  };
  if (!(mean(denominator) > 0)) return std::nullopt;
  return bootstrap_units(numerator.size(), ratio, seed, block_length);
}

}  // namespace plenolab
