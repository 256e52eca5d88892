#include "naive_synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace plenolab::testing_support {
namespace {

struct Point {
  double x, y;
};

/// Image coordinates: pixel centres at integer + 0.5.
struct Neighbours {
  std::array<int, 4> x, y;
  std::array<double, 4> weight;
};

Neighbours around(Point p, int w, int h) {
  const double u = std::clamp(p.x - 0.5, 0.0, w - 1.0), v = std::clamp(p.y - 0.5, 0.0, h - 1.0);
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  const double fx = u - i, fy = v - j;
  const int i1 = std::min(i + 1, w - 1), j1 = std::min(j + 1, h - 1);
  return {{i, i1, i, i1}, {j, j, j1, j1}, {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

double disparity_at(const KeyView<SceneReferred>& view, Point p) {
  const Neighbours n = around(p, view.disparity.width(), view.disparity.height());
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k)
    sum += n.weight[k] * static_cast<double>(view.disparity.at(n.x[k], n.y[k]));
  return sum;
}

struct Found {
  bool in_frustum = false;
  Point a{};
};

struct Search {
  const KeyView<SceneReferred>& view;
  Point b;         // B
  Point velocity;  // (b_x, b_y · b_v / b_h)
  double d_max, step_px;
  double& margin;

  int w() const { return view.disparity.width(); }
  int h() const { return view.disparity.height(); }
  Point at(double d) const { return {b.x + velocity.x * d, b.y + velocity.y * d}; }
  bool inside(Point p) const {
    const double e = 1e-6;
    return p.x >= 0.5 - e && p.x <= w() - 0.5 + e && p.y >= 0.5 - e && p.y <= h() - 0.5 + e;
  }
  double f(double d) const { return disparity_at(view, at(d)) - d; }
  bool positive(double d) {
    const double value = f(d);
    if (d > 0) margin = std::min(margin, std::abs(value));
    return value > 0;
  }

  /// The d in [low, high] at which the path crosses from outside to inside, by bisection.
  double border(double out, double in) const {
    for (int n = 0; n < 200; ++n) {
      const double middle = 0.5 * (out + in);
      (inside(at(middle)) ? in : out) = middle;
    }
    return in;
  }

  Found refine(double from, double to) {
    double previous = from;
    for (int sub = 1; sub <= 8; ++sub) {
      const double d = sub == 8 ? to : from + (to - from) * sub / 8;
      if (positive(d)) {
        const double f0 = f(previous), f1 = f(d);
        const double t = f0 / (f0 - f1);
        return {true, at(previous + t * (d - previous))};
      }
      previous = d;
    }
    return {true, at(to)};
  }

  /// B is inside the image (shifted frustum).
  Found run() {
    const double speed = std::hypot(velocity.x, velocity.y);
    if (speed == 0) return {inside(b), b};
    const double step = step_px / speed;
    double previous = d_max + step;
    bool entering = !inside(at(previous));
    for (int k = 0;; ++k) {
      double d = d_max + (1 - k) * step;
      if (d < 0) d = 0;
      if (!inside(at(d))) continue;
      if (entering) {
        const double entry = border(d + step, d);
        if (positive(entry)) return {};
        previous = entry;
        entering = false;
      }
      if (d == 0 || positive(d)) return refine(previous, d);
      previous = d;
    }
  }
};

double border_weight(double a, double size, double b, const SynthesisOptions& o) {
  const double g = std::clamp(std::min(a, size - a) / (o.border_fraction * size), 0.0, 1.0);
  if (o.border_weight == BorderWeight::kNone) return 1;
  if (o.border_weight == BorderWeight::kLinearGradient) return g;
  return std::pow(g, 4) + (1 - std::pow(g, 3)) * g * (std::abs(b) + o.border_delta);
}

struct Candidate {
  const KeyView<SceneReferred>* view;
  double b_x, b_y;
  Found found;
  double disparity = 0;
  bool passed = false, visible = false;
};

void test_disocclusion(Candidate& c, const SynthesisOptions& o, double& margin) {
  const Neighbours n = around(c.found.a, c.view->disparity.width(), c.view->disparity.height());
  double low = 1e300, high = -1e300;
  for (std::size_t k = 0; k < 4; ++k) {
    if (n.weight[k] > 0) margin = std::min(margin, n.weight[k]);
    if (n.weight[k] == 0) continue;
    low = std::min(low, static_cast<double>(c.view->disparity.at(n.x[k], n.y[k])));
    high = std::max(high, static_cast<double>(c.view->disparity.at(n.x[k], n.y[k])));
  }
  margin = std::min(margin, std::abs(high - low - o.disocclusion_px));
  c.disparity = disparity_at(*c.view, c.found.a);
  c.passed = high - low <= o.disocclusion_px;
}

void move_to_background(Candidate& c) {
  const Neighbours n = around(c.found.a, c.view->disparity.width(), c.view->disparity.height());
  std::size_t best = 4;
  for (std::size_t k = 0; k < 4; ++k) {
    if (n.weight[k] == 0) continue;
    const auto disparity = [&](std::size_t m) { return c.view->disparity.at(n.x[m], n.y[m]); };
    if (best == 4 || disparity(k) < disparity(best) ||
        (disparity(k) == disparity(best) && n.weight[k] > n.weight[best]))
      best = k;
  }
  c.found.a = {n.x[best] + 0.5, n.y[best] + 0.5};
}

double encode(double v) {
  return std::pow(std::max(v, 0.0), 1 / 2.2);
}

std::array<double, 3> encoded_colour(const Candidate& c) {
  const Neighbours n = around(c.found.a, c.view->disparity.width(), c.view->disparity.height());
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Rgb colour = c.view->colour.at(n.x[k], n.y[k]);
    sum[0] += n.weight[k] * encode(static_cast<double>(colour.r));
    sum[1] += n.weight[k] * encode(static_cast<double>(colour.g));
    sum[2] += n.weight[k] * encode(static_cast<double>(colour.b));
  }
  return sum;
}

NaivePixel blend(const std::vector<Candidate>& candidates, const SynthesisOptions& o, NaivePixel pixel) {
  for (const double extra : {0.0, 1e-6}) {
    double weights = 0;
    std::array<double, 3> sum{};
    for (const Candidate& c : candidates) {
      if (!c.visible) continue;
      const double w = ((1 - std::abs(c.b_x)) * (1 - std::abs(c.b_y)) + extra) *
                       border_weight(c.found.a.x, c.view->disparity.width(), c.b_x, o) *
                       border_weight(c.found.a.y, c.view->disparity.height(), c.b_y, o);
      const std::array<double, 3> colour = encoded_colour(c);
      weights += w;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += w * colour[k];
    }
    if (weights == 0) continue;
    pixel.r = std::pow(sum[0] / weights, 2.2);
    pixel.g = std::pow(sum[1] / weights, 2.2);
    pixel.b = std::pow(sum[2] / weights, 2.2);
    return pixel;
  }
  pixel.unseen = true;
  return pixel;
}

std::vector<Candidate> key_views(const LightField& field, CameraPosition at,
                                 std::vector<std::shared_ptr<const KeyView<SceneReferred>>>& held) {
  const ViewGrid& grid = field.grid();
  const int c0 = std::max(0, std::min(static_cast<int>(std::floor(at.s)), grid.columns - 2));
  const int r0 = std::max(0, std::min(static_cast<int>(std::floor(at.t)), grid.rows - 2));
  std::vector<Candidate> candidates;
  for (int r = r0; r < std::min(r0 + 2, grid.rows); ++r)
    for (int c = c0; c < std::min(c0 + 2, grid.columns); ++c) {
      held.push_back(field.view(c, r));
      candidates.push_back({held.back().get(), at.s - c, at.t - r, {}, 0, false, false});
    }
  for (const Candidate& c : candidates)
    if (c.b_x == 0 && c.b_y == 0) return {c};
  return candidates;
}

}  // namespace

Plane<NaivePixel> naive_synthesis(const LightField& field, CameraPosition position,
                                  const SynthesisOptions& o) {
  const ViewGrid& grid = field.grid();
  std::vector<std::shared_ptr<const KeyView<SceneReferred>>> held;
  const std::vector<Candidate> templates = key_views(field, position, held);
  double d_max = 0;
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c)
      for (float d : field.view(c, r)->disparity.pixels()) d_max = std::max(d_max, static_cast<double>(d));
  Plane<NaivePixel> out(grid.width, grid.height);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      std::vector<Candidate> candidates = templates;
      NaivePixel pixel;
      for (Candidate& c : candidates) {
        const Point velocity{c.b_x, c.b_y * grid.spacing_y_m / grid.spacing_x_m};
        c.found = Search{*c.view, {x + 0.5, y + 0.5}, velocity, d_max, o.step_px, pixel.margin}.run();
        if (c.found.in_frustum) test_disocclusion(c, o, pixel.margin);
      }
      bool any_in_frustum = false, any_passed = false;
      for (Candidate& c : candidates) {
        any_in_frustum |= c.found.in_frustum;
        any_passed |= c.passed;
        c.visible = c.passed;
        for (const Candidate& other : candidates) {
          if (!c.passed || !other.passed) continue;
          const double excess = other.disparity - (c.disparity + o.occlusion_margin_px);
          pixel.margin = std::min(pixel.margin, std::abs(excess));
          if (excess > 0) c.visible = false;
        }
        pixel.visible += c.visible ? 1 : 0;
      }
      if (o.restore && any_in_frustum && !any_passed) {
        pixel.restored = true;
        for (Candidate& c : candidates)
          if (c.found.in_frustum) {
            move_to_background(c);
            c.visible = true;
          }
      }
      out.at(x, y) = blend(candidates, o, pixel);
    }
  return out;
}

}  // namespace plenolab::testing_support
