#include "core/lut/mixed_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace plenolab {

namespace {

constexpr int kRowGrain = 16;

template <class A, class B>
void require_equal_sizes(const A& a, const B& b) {
  if (a.width() != b.width() || a.height() != b.height())
    throw InputError(fmt::format("a picture of {} × {} pixels and a map of {} × {} do not belong together",
                                 a.width(), a.height(), b.width(), b.height()));
}

Rgb cut(Rgb c) {
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

}  // namespace

Plane<int> volume_of_objects(const Plane<int>& volume, const Plane<int>& object, int volumes) {
  require_equal_sizes(volume, object);
  const int objects = object.empty() ? 0 : 1 + *std::ranges::max_element(object.pixels());
  // Of each object the pixels in the background, then in each volume.
  const auto columns = static_cast<std::size_t>(volumes) + 1;
  std::vector<std::int64_t> counts(columns * static_cast<std::size_t>(std::max(0, objects)));
  for (std::size_t i = 0; i < object.size(); ++i)
    if (const int o = object.pixels()[i]; o >= 0)
      ++counts[columns * static_cast<std::size_t>(o) + static_cast<std::size_t>(volume.pixels()[i] + 1)];
  Plane<int> owner = volume;
  for (std::size_t i = 0; i < object.size(); ++i)
    if (const int o = object.pixels()[i]; o >= 0) {
      const auto first = counts.begin() + static_cast<std::ptrdiff_t>(columns) * o;
      owner.pixels()[i] =
          static_cast<int>(std::max_element(first, first + static_cast<std::ptrdiff_t>(columns)) - first) - 1;
    }
  return owner;
}

DisplayImage grade_mixed(const DisplayImage& image, const Plane<int>& volume, std::span<const Lut> tables,
                         const Lut& background, int threads) {
  require_equal_sizes(image, volume);
  DisplayImage graded(image.width(), image.height());
  parallel_for(image.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width(); ++x) {
        const int v = volume.at(x, y);
        const Lut& lut = v < 0 ? background : tables[static_cast<std::size_t>(v)];
        graded.at(x, y) = cut(sample_lut(lut, image.at(x, y), LutInterpolation::kTetrahedral));
      }
  });
  return graded;
}

}  // namespace plenolab
