#include "experiments/ray_rendering.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace plenolab {

namespace {

/// Mean over a pixel of the screen: points on a regular grid around its middle.
class PixelRenderer {
 public:
  PixelRenderer(const LitRays& scene, const DisplaySpace& space, PinholeSize size, int samples_across)
      : scene_(scene), space_(space), size_(size), samples_(samples_across) {}

  Rgb pixel(ScreenPoint middle, ObserverPosition observer) const {
    const Vec3 from(static_cast<float>(observer.x_m), static_cast<float>(-space_.observer_distance_m),
                    static_cast<float>(observer.y_m));
    Rgb sum{};
    for (int j = 0; j < samples_; ++j)
      for (int i = 0; i < samples_; ++i) {
        const ScreenPoint point{middle.across + offset(i) / size_.width,
                                middle.down + offset(j) / size_.height};
        sum += scene_.radiance(from, (on_screen(point) - from).normalized());
      }
    return sum * (1.0f / static_cast<float>(samples_ * samples_));
  }

 private:
  double offset(int i) const { return (i + 0.5) / samples_ - 0.5; }
  Vec3 on_screen(ScreenPoint point) const {
    return {static_cast<float>((point.across - 0.5) * space_.width_m), 0,
            static_cast<float>((0.5 - point.down) * space_.height_m)};
  }

  const LitRays& scene_;
  const DisplaySpace& space_;
  PinholeSize size_;
  int samples_;
};

void require_samples(int samples_across) {
  if (samples_across < 1 || samples_across > 8)
    throw InputError(fmt::format("a pixel must have 1 to 8 samples each way, not {}", samples_across));
}

}  // namespace

SceneRays render_columns(const LitRays& scene, const RayDisplay& display,
                         const std::vector<std::pair<int, int>>& columns, const RayRendering& rendering) {
  require_samples(rendering.samples_across);
  const PixelRenderer renderer(scene, display.space(), display.resolution(), rendering.samples_across);
  SceneRays rays(display.size());
  parallel_for(static_cast<int>(columns.size()), 8, rendering.threads, [&](int begin, int end) {
    for (int c = begin; c < end; ++c)
      for (int v = 0; v < display.size().height; ++v) {
        const auto& column = columns[static_cast<std::size_t>(c)];
        const Ray ray{column.first, column.second, v};
        rays.at(ray) = renderer.pixel(display.screen_point(ray), display.position(ray));
      }
  });
  return rays;
}

SceneRays render_rays(const LitRays& scene, const RayDisplay& display, const RayRendering& rendering) {
  std::vector<std::pair<int, int>> all;
  for (int image = 0; image < display.size().images; ++image)
    for (int u = 0; u < display.size().width; ++u) all.emplace_back(image, u);
  return render_columns(scene, display, all, rendering);
}

SceneImage render_pinhole(const LitRays& scene, const DisplaySpace& space, ObserverPosition observer,
                          PinholeSize size, const RayRendering& rendering) {
  require_samples(rendering.samples_across);
  space.validate();
  size.validate();
  const PixelRenderer renderer(scene, space, size, rendering.samples_across);
  SceneImage image(size.width, size.height);
  parallel_for(size.height, 4, rendering.threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < size.width; ++x) image.at(x, y) = renderer.pixel(size.middle(x, y), observer);
  });
  return image;
}

}  // namespace plenolab
