// D-6: what a display blurs away from its screen: a textured board at several depths.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/image/colour.h"
#include "core/luminance/projector_display.h"
#include "experiments/reproduce/luminance/luminance_tools.h"
#include "stimuli/scenes/modelling/masonry.h"
#include "stimuli/scenes/modelling/noise.h"

namespace plenolab {

ReproductionResult reproduce_claim_d6(Laboratory& laboratory);

namespace {

constexpr std::array kDepths_m{-0.8, -0.4, -0.2, -0.1, 0.0, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2};
constexpr double kFar_m = 0.4;  // from here on counts as away from the screen
constexpr std::array kObservers_m{-2.1, -1.3, -0.6, 0.0, 0.7, 1.4, 2.2};

/// A board that fills the view of every observer, parallel to the screen, `depth_m` behind it; its blotches
/// have the same size on the screen at any depth, about 8 of 320 pixels. It shines by ambient light alone.
LitScene board_at(double depth_m) {
  const auto scale = static_cast<float>((2 + depth_m) / 2);
  SceneAssembler scene;
  Mesh board = upright_rectangle(-30, 30, -10, 10, static_cast<float>(depth_m));
  scene.add(scene.material(diffuse([scale](const SurfacePoint& point) {
    const float v = 0.5f + 0.45f * fractal_noise(point.position_m / (0.016f * scale), 2, 77);
    return Rgb{v, v, v};
  })),
            board);
  LitScene lit;
  scene.finish(lit.scene);
  lit.scene.id = "board";
  lit.scene.title = "Board";
  lit.scene.sky = {
      .kind = Sky::Kind::kUniform, .zenith_cd_m2 = {100, 100, 100}, .ground_cd_m2 = {100, 100, 100}};
  return lit;
}

/// Root mean square of luminance differences between neighbours along the rows.
double sharpness(const SceneImage& image) {
  double squares = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 1; x < image.width(); ++x) {
      const auto d = static_cast<double>(luminance(image.at(x, y)) - luminance(image.at(x - 1, y)));
      squares += d * d;
    }
  return std::sqrt(squares / (static_cast<double>(image.height()) * (image.width() - 1)));
}

/// Share of the scene's contrast that the display reproduces where it belongs: slope of the regression of
/// what is seen on the truth, cov/var.
double detail_kept(const SceneImage& seen, const SceneImage& truth) {
  double s = 0, t = 0, st = 0, tt = 0;
  const auto n = static_cast<double>(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto u = static_cast<double>(luminance(seen.pixels()[i])),
               v = static_cast<double>(luminance(truth.pixels()[i]));
    s += u, t += v, st += u * v, tt += v * v;
  }
  return (st - s * t / n) / std::max(1e-30, tt - t * t / n);
}

/// By depth, a value for each observer.
struct Kept {
  double depth_m = 0;
  std::vector<double> sharpness, detail;
};

Kept measure(LuminanceBench& bench, double depth_m) {
  ProjectorDisplayOptions options = bench.display_options();
  if (bench.options().effort != Effort::kTiny) options.width = 320, options.height = 60;
  const RayRendering rendering{.samples_across = 1, .threads = bench.options().threads};
  std::vector<ObserverPosition> observers;
  for (const double x : kObservers_m) observers.push_back({x, 0});
  const ShownField field = show_scene_to(board_at(depth_m), std::make_shared<const ProjectorDisplay>(options),
                                         observers, rendering);
  Kept kept{depth_m, {}, {}};
  for (const ObserverPosition& observer : observers) {
    const PinholeSize size = field.display->resolution();
    const SceneImage truth = render_pinhole(*field.scene, field.display->space(), observer, size, rendering);
    const SceneImage seen = perceive(*field.display, field.rays, observer, size, rendering.threads).image;
    kept.sharpness.push_back(sharpness(seen) / std::max(1e-12, sharpness(truth)));
    kept.detail.push_back(detail_kept(seen, truth));
  }
  return kept;
}

ReportPlot depth_plot(const std::vector<Kept>& all) {
  Plot plot;
  plot.x = {.title = "Depth behind the screen", .unit = "m"};
  plot.y = {.title = "Display over scene", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  PlotSeries sharp{"differences of neighbours", PlotSeries::Style::kLinesPoints, {}},
      detail{"detail in its place", PlotSeries::Style::kLinesPoints, {}};
  for (const Kept& kept : all) {
    const auto range = [&](const std::vector<double>& values) {
      return PlotPoint{kept.depth_m, mean(values), *std::min_element(values.begin(), values.end()),
                       *std::max_element(values.begin(), values.end())};
    };
    sharp.points.push_back(range(kept.sharpness));
    detail.points.push_back(range(kept.detail));
  }
  plot.series = {detail, sharp};
  return {plot, "Detail that the display keeps of a board over its depth; bars span seven observers",
          "Detail in its place peaks at the screen and falls on both sides."};
}

}  // namespace

namespace {

/// Means over the depths that count as away from the screen, by observer.
struct Away {
  std::vector<double> detail, sharpness;
};

Away away_from_screen(const std::vector<Kept>& all) {
  Away away{std::vector<double>(kObservers_m.size()), std::vector<double>(kObservers_m.size())};
  const auto far = [](const Kept& kept) { return std::abs(kept.depth_m) >= kFar_m; };
  const auto depths = static_cast<double>(std::count_if(all.begin(), all.end(), far));
  for (const Kept& kept : all)
    for (std::size_t i = 0; far(kept) && i < kObservers_m.size(); ++i) {
      away.detail[i] += kept.detail[i] / depths;
      away.sharpness[i] += kept.sharpness[i] / depths;
    }
  return away;
}

void add_depth_rows(ReproductionResult& result, const Kept& kept) {
  for (std::size_t i = 0; i < kObservers_m.size(); ++i) {
    const Columns columns{{"depth_m", kept.depth_m}, {"observer_x_m", kObservers_m[i]}};
    result.rows.add({"detail_kept", kept.detail[i], "1", columns});
    result.rows.add({"neighbour_differences_kept", kept.sharpness[i], "1", columns});
  }
}

}  // namespace

ReproductionResult reproduce_claim_d6(Laboratory& laboratory) {
  ReproductionResult result;
  LuminanceBench& bench = laboratory.luminance_bench();
  std::vector<Kept> all;
  std::vector<double> at_screen;
  for (const double depth : kDepths_m) {
    all.push_back(measure(bench, depth));
    add_depth_rows(result, all.back());
    if (depth == 0) at_screen = all.back().detail;
  }
  const Away away = away_from_screen(all);
  std::vector<double> ratio;
  for (std::size_t i = 0; i < away.detail.size(); ++i)
    ratio.push_back(away.detail[i] / std::max(1e-12, at_screen[i]));
  const Interval kept = mean_interval(ratio, laboratory.options().seed).value_or(Interval{});
  Verdict verdict = decide_claim(kept, Comparison::kBelow, 1, "detail_away_over_at_screen", "1",
                                 uncertainty_over(ratio.size(), "observers"));
  result.paper_shows =
      "Section 7.4: the simulated display loses detail, noticeably for what is far from the screen; that "
      "reflects real displays.";
  result.ours_shows = fmt::format(
      "Of the contrast of a textured board the display keeps {:.2f} in its place at the screen; {:g} m or "
      "more from the screen it keeps {} of that.",
      mean(at_screen), kFar_m, interval_text(kept));
  const double sharp = mean(away.sharpness);
  result.differs = fmt::format(
      "{} What is lost is not sharpness as such: differences between neighbouring pixels {} to {:.2f} times "
      "the scene's there. The diffuser is as narrow as the projectors are far apart and mixes two or three "
      "of them, so that detail is doubled and cut at the seams between projectors rather than smeared.",
      outcome_text(verdict.outcome), sharp > 1 ? "even grow" : "fall", sharp);
  result.add_plot("detail-over-depth", depth_plot(all));
  conclude_on(
      result, {"board"},
      {"D-6", display_paper("section 7.4"), "Simulated display images lose detail away from the screen."},
      std::move(verdict), result.ours_shows);
  return result;
}

}  // namespace plenolab
