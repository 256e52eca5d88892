#include "core/luminance/point_rays.h"

#include <algorithm>
#include <numeric>

namespace plenolab {

namespace {

template <class T>
bool normalise_all(std::span<T> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) return false;
  for (T& weight : weights) weight = static_cast<T>(static_cast<double>(weight) / sum);
  return true;
}

}  // namespace

PointColumns::PointColumns(const RayDisplay& display, int pinhole_width)
    : display_(display), reach_m_(display.reach_m()), columns_(static_cast<std::size_t>(pinhole_width)) {
  std::vector<Ray> rays;
  for (int a = 0; a < pinhole_width; ++a) {
    rays.clear();
    display.rays_at(PinholeSize{pinhole_width, 1}.middle(a, 0), rays);
    std::vector<Column>& column = columns_[static_cast<std::size_t>(a)];
    for (const Ray& ray : rays) column.push_back({ray.image, ray.u, display.position(ray).x_m});
    std::sort(column.begin(), column.end(), [](const Column& p, const Column& q) { return p.x_m < q.x_m; });
  }
}

void PointColumns::reaching(int a, ObserverPosition observer, std::vector<Column>& columns,
                            std::vector<float>& weights) const {
  columns.clear();
  weights.clear();
  const std::vector<Column>& all = columns_[static_cast<std::size_t>(a)];
  const auto first = std::lower_bound(all.begin(), all.end(), observer.x_m - reach_m_,
                                      [](const Column& c, double x) { return c.x_m < x; });
  for (auto c = first; c != all.end() && c->x_m <= observer.x_m + reach_m_; ++c) {
    const double weight = display_.weight({c->image, c->u, 0}, observer);
    if (weight > 0) columns.push_back(*c), weights.push_back(static_cast<float>(weight));
  }
}

bool normalise(std::span<float> weights) {
  return normalise_all(weights);
}

bool normalise(std::span<double> weights) {
  return normalise_all(weights);
}

std::vector<int> rows_shown(int rows, int height) {
  std::vector<int> shown;
  for (int b = 0; b < rows; ++b)
    shown.push_back(std::min(height - 1, static_cast<int>((b + 0.5) / rows * height)));
  return shown;
}

}  // namespace plenolab
