// Figure 9: a global operator flickers when a little more of a bright sky comes into view.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/tonemap/reinhard_global.h"
#include "experiments/reproduce/optimisation/tuning_tools.h"
#include "stimuli/direct/lit_view.h"

namespace plenolab {

ReproductionResult reproduce_sky_flicker(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "after-vehicle-game";
constexpr int kFrames = 9, kShownEvery = 4;
constexpr float kFirstPitch_deg = -14, kLastPitch_deg = 10;

/// One frame with what the operator makes of it.
struct TiltedFrame {
  SceneImage radiance;
  double sky_share = 0;
  double ln_surfaces = 0;  ///< mean of ln L over what is not sky; 0 without any
  double brightest_cd_m2 = 0;
  ReinhardGlobalParameters parameters;
};

/// The scene's first camera, tilted.
LitCamera tilted_camera(const GameScene& scene, float pitch_deg) {
  constexpr float kDegree = 0.017453293f;
  const Vec3 along = scene.first.target_m - scene.first.position_m;
  const Vec3 ahead = Vec3(along.x(), along.y(), 0).normalized();
  const float s = std::sin(pitch_deg * kDegree), c = std::cos(pitch_deg * kDegree);
  return {.position_m = scene.first.position_m,
          .forward = c * ahead + Vec3(0, 0, s),
          .up = Vec3(0, 0, c) - s * ahead,
          .fov_h_deg = scene.fov_h_deg};
}

TiltedFrame measured_frame(LitView view) {
  TiltedFrame frame;
  const auto& materials = view.material.pixels();
  double sky = 0, surfaces = 0;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const auto l = static_cast<double>(luminance(view.radiance.pixels()[i]));
    frame.brightest_cd_m2 = std::max(frame.brightest_cd_m2, l);
    if (materials[i] < 0) sky += 1;
    if (materials[i] >= 0 && l > 0) frame.ln_surfaces += std::log(l), surfaces += 1;
  }
  frame.sky_share = sky / static_cast<double>(materials.size());
  if (surfaces > 0) frame.ln_surfaces /= surfaces;
  const ViewStatistics statistics = measure_view(view.radiance);
  frame.parameters =
      fit(ReinhardGlobalOptions{.automatic_key = false}, evaluate(statistics, log_floor(statistics)));
  frame.radiance = std::move(view.radiance);
  return frame;
}

std::vector<TiltedFrame> tilted_frames(Laboratory& laboratory) {
  const OptimisationBench& bench = laboratory.optimisation_bench();
  const auto sequence = std::find_if(game_sequences().begin(), game_sequences().end(),
                                     [](const GameSequence& s) { return std::string(s.id) == kScene; });
  const GameScene scene = sequence->build();
  const LitViews views(scene.lit);
  std::vector<TiltedFrame> frames;
  for (int f = 0; f < kFrames; ++f) {
    const float t = static_cast<float>(f) / (kFrames - 1);
    const LitCamera camera = tilted_camera(scene, std::lerp(kFirstPitch_deg, kLastPitch_deg, t));
    frames.push_back(
        measured_frame(views.render(camera, bench.width(), bench.height(), laboratory.options().threads)));
  }
  return frames;
}

double mean_luma(const DisplayImage& image) {
  double sum = 0;
  for (const Rgb c : image.pixels()) sum += static_cast<double>(luminance(c));
  return sum / static_cast<double>(image.size());
}

/// Luma at which an operator's parameters show a luminance.
double luma_of(double luminance_cd_m2, const ReinhardGlobalParameters& p) {
  return std::pow(reinhard_curve(p.key * luminance_cd_m2 * std::pow(10.0, -p.log_average)), 1 / 2.2);
}

/// The same for an operator that scales the brightest pixel of the frame to white.
double luma_by_brightest(double luminance_cd_m2, const TiltedFrame& frame) {
  return std::pow(std::min(1.0, luminance_cd_m2 / std::max(frame.brightest_cd_m2, 1e-12)), 1 / 2.2);
}

/// Largest difference between successive values, and the later one's number.
struct Step {
  double size = 0;
  std::size_t frame = 1;
};
Step largest_step(const std::vector<double>& values) {
  Step step;
  for (std::size_t f = 1; f < values.size(); ++f)
    if (const double size = std::abs(values[f] - values[f - 1]); size > step.size) step = {size, f};
  return step;
}

/// What happens to a surface over the frames.
struct Flicker {
  double surface_cd_m2 = 0;            ///< geometric mean of all that is not sky, over all frames
  std::vector<double> luma;            ///< at which the frames show it, by their log averages
  std::vector<double> luma_brightest;  ///< by their brightest pixels
};

Flicker flicker_of(const std::vector<TiltedFrame>& frames) {
  Flicker flicker;
  double ln = 0;
  for (const TiltedFrame& frame : frames) ln += frame.ln_surfaces / static_cast<double>(frames.size());
  flicker.surface_cd_m2 = std::exp(ln);
  for (const TiltedFrame& frame : frames) {
    flicker.luma.push_back(luma_of(flicker.surface_cd_m2, frame.parameters));
    flicker.luma_brightest.push_back(luma_by_brightest(flicker.surface_cd_m2, frame));
  }
  return flicker;
}

void add_frame_rows(ReproductionResult& result, const std::vector<TiltedFrame>& frames,
                    const Flicker& flicker) {
  ReportTable table{"Frames, each mapped with its own log average",
                    {"frame", "sky [%]", "log average [cd/m²]", "mean luma", "luma of the same surface",
                     "the same, scaled to the brightest pixel"},
                    {},
                    3};
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const TiltedFrame& frame = frames[f];
    const double average = std::pow(10.0, frame.parameters.log_average),
                 luma = mean_luma(apply(frame.parameters, frame.radiance).image);
    const auto number = static_cast<long long>(f);
    table.rows.push_back(
        {number, 100 * frame.sky_share, average, luma, flicker.luma[f], flicker.luma_brightest[f]});
    const Columns columns{{"frame", number}};
    result.rows.add({"sky_share", frame.sky_share, "1", columns});
    result.rows.add({"log_average_cd_m2", average, "cd/m²", columns});
    result.rows.add({"mean_luma", luma, "1", columns});
    result.rows.add({"surface_luma", flicker.luma[f], "1", columns});
    result.rows.add({"surface_luma_by_brightest", flicker.luma_brightest[f], "1", columns});
  }
  result.add_table(std::move(table));
}

/// First, middle and last frame with parameters of their own and with those of the first.
void add_pictures(ReproductionResult& result, const std::vector<TiltedFrame>& frames) {
  ImageComparison own{"Frames 0, 4 and 8, each mapped with its own log average",
                      "Three frames of a camera that tilts up, the ground as bright as each frame makes it.",
                      {}},
      fixed{"The same frames, all mapped with the log average of the first",
            "The same three frames with one and the same mapping.",
            {}};
  for (std::size_t f = 0; f < frames.size(); f += kShownEvery) {
    const std::string name = fmt::format("Frame {}", f);
    own.images.push_back({name, apply(frames[f].parameters, frames[f].radiance).image});
    fixed.images.push_back({name, apply(frames.front().parameters, frames[f].radiance).image});
  }
  result.add_comparison("own-average", std::move(own));
  result.add_comparison("first-average", std::move(fixed));
}

ReportPlot flicker_plot(const std::vector<TiltedFrame>& frames, const Flicker& flicker) {
  Plot plot;
  plot.x = {.title = "Sky in the frame", .unit = "%"};
  plot.y = {.title = "Luma", .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  PlotSeries own{"surface, own log average", PlotSeries::Style::kLinesPoints, {}},
      fixed{"surface, the first frame's", PlotSeries::Style::kLinesPoints, {}},
      brightest{"surface, own brightest pixel", PlotSeries::Style::kLinesPoints, {}},
      mean_of_frame{"mean of the frame, own", PlotSeries::Style::kLinesPoints, {}};
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const double sky = 100 * frames[f].sky_share;
    own.points.push_back({.x = sky, .y = flicker.luma[f]});
    fixed.points.push_back({.x = sky, .y = flicker.luma.front()});
    brightest.points.push_back({.x = sky, .y = flicker.luma_brightest[f]});
    mean_of_frame.points.push_back(
        {.x = sky, .y = mean_luma(apply(frames[f].parameters, frames[f].radiance).image)});
  }
  plot.series = {std::move(own), std::move(fixed), std::move(brightest), std::move(mean_of_frame)};
  return {plot, "Luma of one and the same surface over the share of sky in the frame",
          fmt::format("With the log average of each frame it goes from {:.2f} to {:.2f}; with that of the "
                      "first it is level.",
                      flicker.luma.front(), flicker.luma.back())};
}

}  // namespace

ReproductionResult reproduce_sky_flicker(Laboratory& laboratory) {
  ReproductionResult result;
  const std::vector<TiltedFrame> frames = tilted_frames(laboratory);
  const Flicker flicker = flicker_of(frames);
  add_pictures(result, frames);
  add_frame_rows(result, frames, flicker);
  result.add_plot("luma-over-sky", flicker_plot(frames, flicker));
  const Step step = largest_step(flicker.luma), other = largest_step(flicker.luma_brightest);
  result.rows.add({"largest_step_luma", step.size, "1", {}});
  result.rows.add({"largest_step_luma_by_brightest", other.size, "1", {}});
  const std::size_t f = step.frame;
  const double before = flicker.luma[f - 1], after = flicker.luma[f];
  result.paper_shows =
      "Figure 9: two successive frames of a video mapped by a global operator; a little more sky in the "
      "second "
      "changes the statistics, and the brightness of the whole frame with them.";
  result.ours_shows = fmt::format(
      "A camera tilts up in {} steps, and the sky grows from {:.0f} to {:.0f} % of the frame. The "
      "photographic "
      "operator with each frame's own log average shows a surface of {:.0f} cd/m² at luma {:.2f} first and "
      "{:.2f} "
      "last. The largest step between successive frames is from {:.3f} to {:.3f}, as the sky goes from "
      "{:.0f} to "
      "{:.0f} %. Scaled to each frame's brightest pixel instead, it jumps by up to {:.3f}.",
      frames.size() - 1, 100 * frames.front().sky_share, 100 * frames.back().sky_share, flicker.surface_cd_m2,
      flicker.luma.front(), flicker.luma.back(), before, after, 100 * frames[f - 1].sky_share,
      100 * frames[f].sky_share, other.size);
  result.differs = fmt::format(
      "{} The thesis shows frames of another paper; ours are game-like frames, of a scene drawn for "
      "tone "
      "mapping. With the first frame's log average for all, the surface keeps its luma.",
      flicker.luma.back() < flicker.luma.front()
          ? "They agree: more sky darkens everything else."
          : "They differ: more sky does not darken what else there is here.");
  return result;
}

}  // namespace plenolab
