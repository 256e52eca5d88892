#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/image/image.h"

namespace plenolab {

inline SceneImage image_of(int width, int height, const std::function<Rgb(int x, int y)>& colour) {
  SceneImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = colour(x, y);
  return image;
}

inline SceneImage grey_image(int width, int height, const std::function<float(int x, int y)>& value) {
  return image_of(width, height, [&](int x, int y) {
    const float v = value(x, y);
    return Rgb{v, v, v};
  });
}

/// Colours whose logs are spread evenly over `decades` below `top`.
inline SceneImage random_scene(int width, int height, double decades = 4, double top = 1e3) {
  const auto value = [&](int x, int y, std::uint64_t channel) {
    const std::uint64_t index = static_cast<std::uint64_t>(y * width + x);
    return static_cast<float>(top * std::pow(10.0, -decades * unit_double(random_u64(7, channel, index))));
  };
  return image_of(width, height, [&](int x, int y) {
    return Rgb{value(x, y, 0), value(x, y, 1), value(x, y, 2)};
  });
}

struct NamedImage {
  std::string name;
  SceneImage image;
};

/// A scene with one bad pixel in the middle.
inline NamedImage scene_with(const std::string& name, Rgb pixel) {
  SceneImage image = random_scene(17, 11);
  image.at(8, 5) = pixel;
  return {name, std::move(image)};
}

/// What every operator must survive.
inline std::vector<NamedImage> extreme_images() {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const float largest = std::numeric_limits<float>::max();
  std::vector<NamedImage> images;
  images.push_back({"ordinary", random_scene(17, 11)});
  images.push_back({"black", SceneImage(9, 7)});
  images.push_back({"constant", SceneImage(9, 7, Rgb{3, 3, 3})});
  images.push_back({"constant colour", SceneImage(9, 7, Rgb{3, 0, 0.5f})});
  images.push_back({"all NaN", SceneImage(5, 4, Rgb{nan, nan, nan})});
  images.push_back({"all infinite", SceneImage(5, 4, Rgb{inf, inf, inf})});
  images.push_back({"all negative", SceneImage(5, 4, Rgb{-1, -2, -3})});
  images.push_back(scene_with("one NaN", {nan, 1, nan}));
  images.push_back(scene_with("one infinite", {inf, inf, 1}));
  images.push_back(scene_with("one minus infinite", {-inf, 1, 1}));
  images.push_back(scene_with("one negative", {-5, 1, 1}));
  images.push_back(scene_with("one zero", {0, 0, 0}));
  images.push_back(scene_with("one bright", {1e9f, 1e9f, 1e9f}));
  images.push_back(scene_with("one at the end of float", {largest, largest, largest}));
  images.push_back(scene_with("one denormal", {1e-45f, 1e-45f, 1e-45f}));
  images.push_back({"18 decades", grey_image(37, 3, [](int x, int) {
                      return static_cast<float>(std::pow(10.0, -9 + 0.5 * x));
                    })});
  images.push_back({"1 x 1", SceneImage(1, 1, Rgb{0.2f, 0.4f, 0.1f})});
  images.push_back({"1 x 1 black", SceneImage(1, 1)});
  images.push_back({"1 x 40", random_scene(1, 40)});
  images.push_back({"40 x 1", random_scene(40, 1)});
  return images;
}

}  // namespace plenolab
