#include "core/lut/mixed_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/error.h"

namespace plenolab {

namespace {

template <class A, class B>
void require_equal_sizes(const A& a, const B& b) {
  if (a.width() != b.width() || a.height() != b.height())
    throw InputError(fmt::format("a picture of {} × {} pixels and a map of {} × {} do not belong together",
                                 a.width(), a.height(), b.width(), b.height()));
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
  std::vector<int> owner_of(static_cast<std::size_t>(std::max(0, objects)));
  for (std::size_t o = 0; o < owner_of.size(); ++o) {
    const auto first = counts.begin() + static_cast<std::ptrdiff_t>(columns * o);
    owner_of[o] =
        static_cast<int>(std::max_element(first, first + static_cast<std::ptrdiff_t>(columns)) - first) - 1;
  }
  Plane<int> owner = volume;
  for (std::size_t i = 0; i < object.size(); ++i)
    if (const int o = object.pixels()[i]; o >= 0) owner.pixels()[i] = owner_of[static_cast<std::size_t>(o)];
  return owner;
}

DisplayImage grade_mixed(const DisplayImage& image, const Plane<int>& volume,
                         std::span<const PreparedLut> tables, const PreparedLut& background, int threads) {
  require_equal_sizes(image, volume);
  std::vector<const PreparedLut*> all{&background};
  for (const PreparedLut& table : tables) all.push_back(&table);
  Plane<int> of_pixel(volume.width(), volume.height());
  std::ranges::transform(volume.pixels(), of_pixel.pixels().begin(), [](int v) { return v < 0 ? 0 : v + 1; });
  return grade_by_map(image, of_pixel, all, {.threads = threads}).image;
}

}  // namespace plenolab
