#include "experiments/reproduce/claims/appearance_borders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "metrics/error_map.h"

namespace plenolab {
namespace {

// Neighbours of one surface: their true disparities differ by less.
constexpr float kSameSurface_px = 0.5f;
constexpr int kEdgeMargin_px = 2;

/// Whether two neighbours lie on one surface and are both seen.
bool same_surface(const Plane<std::uint8_t>& views, const DisparityMap& disparity, int x, int y, int nx,
                  int ny) {
  return views.at(x, y) != 0 && views.at(nx, ny) != 0 &&
         std::abs(disparity.at(x, y) - disparity.at(nx, ny)) < kSameSurface_px;
}

/// Whether the pixels from x − kEdgeMargin_px to x + 1 + kEdgeMargin_px of a row lie on one surface.
bool away_from_edges(const DisparityMap& disparity, int x, int y) {
  const int last = std::min(x + 1 + kEdgeMargin_px, disparity.width() - 1);
  for (int i = std::max(0, x - kEdgeMargin_px); i <= last; ++i)
    if (std::abs(disparity.at(i, y) - disparity.at(x, y)) >= kSameSurface_px) return false;
  return true;
}

double step_product(const TwinView& view, int x, int y, int nx, int ny) {
  double product[3] = {1, 1, 1};
  for (std::size_t k = 0; k < 2; ++k) {
    const DisplayImage &s = view.synthesised[k], &t = view.truth[k];
    const Rgb step = (s.at(nx, ny) - t.at(nx, ny)) - (s.at(x, y) - t.at(x, y));
    product[0] *= static_cast<double>(step.r);
    product[1] *= static_cast<double>(step.g);
    product[2] *= static_cast<double>(step.b);
  }
  return (product[0] + product[1] + product[2]) / 3;
}

std::vector<double> block_errors(const DisplayImage& synthesised, const DisplayImage& truth) {
  std::vector<double> squared;
  for (int y0 = 0; y0 + kErrorBlock_px <= truth.height(); y0 += kErrorBlock_px)
    for (int x0 = 0; x0 + kErrorBlock_px <= truth.width(); x0 += kErrorBlock_px) {
      Rgb sum;
      for (int y = y0; y < y0 + kErrorBlock_px; ++y)
        for (int x = x0; x < x0 + kErrorBlock_px; ++x) sum += synthesised.at(x, y) - truth.at(x, y);
      sum = sum * (1.0f / (kErrorBlock_px * kErrorBlock_px));
      squared.push_back(static_cast<double>(sum.r * sum.r + sum.g * sum.g + sum.b * sum.b) / 3);
    }
  return squared;
}

double border_excess(const Plane<float>& error, const Plane<std::uint8_t>& views,
                     const DisparityMap& disparity) {
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (int y = 0; y + 1 < error.height(); ++y)
    for (int x = 0; x + 1 < error.width(); ++x)
      for (const auto& [nx, ny] : {std::pair{x + 1, y}, std::pair{x, y + 1}}) {
        if (!same_surface(views, disparity, x, y, nx, ny)) continue;
        const bool border = views.at(x, y) != views.at(nx, ny);
        sum[border] += static_cast<double>(std::abs(error.at(nx, ny) - error.at(x, y)));
        ++count[border];
      }
  return count[0] == 0 || count[1] == 0 ? 0 : sum[1] / count[1] - sum[0] / count[0];
}

}  // namespace

std::vector<double> squared_border_steps(std::span<const TwinView> views) {
  std::vector<double> rows;
  for (const TwinView& view : views) {
    const int width = view.views.width(), height = view.views.height();
    for (int y = height / 4; y < 3 * height / 4; ++y) {
      double sum = 0;
      int count = 0;
      for (int x = width / 4; x < 3 * width / 4; ++x) {
        if (view.views.at(x, y) == 0 || view.views.at(x + 1, y) == 0) continue;
        if (!away_from_edges(view.disparity, x, y)) continue;
        if (view.views.at(x, y) == view.views.at(x + 1, y)) continue;
        sum += step_product(view, x, y, x + 1, y);
        ++count;
      }
      if (count > 0) rows.push_back(sum / count);
    }
  }
  return rows;
}

SceneError scene_error(Laboratory& laboratory, const std::string& scene_id, CameraPosition position,
                       float exposure) {
  const KeyView<SceneReferred> truth = laboratory.truth(scene_id, position);
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  options.record_provenance = true;
  NovelView<SceneReferred> novel = laboratory.synthesizer(scene_id).synthesize(position, options);
  SceneError result;
  result.exposure = exposure > 0 ? exposure : exposure_from(truth.colour);
  const DisplayImage synthesised = expose(novel.image, result.exposure),
                     t = expose(truth.colour, result.exposure);
  result.squared_blocks = block_errors(synthesised, t);
  Plane<float> error(t.width(), t.height());
  for (std::size_t i = 0; i < error.size(); ++i)
    error.pixels()[i] = luminance(synthesised.pixels()[i] - t.pixels()[i]);
  result.border_excess = border_excess(error, contributing_views(novel, false), truth.disparity);
  const ComparisonConditions conditions;
  result.comparison = {
      fmt::format("{} from {:.2f},{:.2f}", laboratory.scene(scene_id).title, position.s, position.t),
      "Ground truth, synthesised view and their difference",
      {{"Ground truth", t},
       {"Synthesised", synthesised},
       {"Difference", error_map(synthesised, t, conditions)}}};
  result.truth = truth.colour;
  result.synthesised = std::move(novel.image);
  return result;
}

}  // namespace plenolab
