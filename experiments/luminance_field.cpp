#include "experiments/luminance_field.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/luminance/point_rays.h"
#include "metrics/psnr.h"

namespace plenolab {

namespace {

ShownField shown(const LitRays& lit, std::shared_ptr<const RayDisplay> display, SceneRays rays,
                 double seconds, int threads) {
  ShownField field = show_rays(lit.scene().scene.id, std::move(display), std::move(rays), threads);
  field.scene = lit;
  field.render_seconds = seconds;
  return field;
}

}  // namespace

ShownField show_scene(const LitScene& scene, std::shared_ptr<const RayDisplay> display,
                      const RayRendering& rendering) {
  const LitRays lit(scene);
  const Stopwatch watch;
  SceneRays rays = render_rays(lit, *display, rendering);
  return shown(lit, std::move(display), std::move(rays), watch.seconds(), rendering.threads);
}

ShownField show_scene_to(const LitScene& scene, std::shared_ptr<const RayDisplay> display,
                         const std::vector<ObserverPosition>& observers, const RayRendering& rendering) {
  PLENOLAB_CHECK(display->in_columns(), "a display in columns");
  const PointColumns points(*display, display->resolution().width);
  std::set<std::pair<int, int>> reaching;
  std::vector<PointColumns::Column> columns;
  std::vector<float> weights;
  for (const ObserverPosition& observer : observers)
    for (int a = 0; a < points.width(); ++a) {
      points.reaching(a, observer, columns, weights);
      for (const PointColumns::Column& column : columns) reaching.insert({column.image, column.u});
    }
  const LitRays lit(scene);
  const Stopwatch watch;
  SceneRays rays = render_columns(lit, *display, {reaching.begin(), reaching.end()}, rendering);
  return shown(lit, std::move(display), std::move(rays), watch.seconds(), rendering.threads);
}

ShownField show_rays(std::string name, std::shared_ptr<const RayDisplay> display, SceneRays rays,
                     int threads) {
  const PixelRepairs repairs = repair(rays);
  RayValues<float> luminance = luminance_of(rays, threads);
  return {std::move(name),
          std::move(display),
          std::move(rays),
          std::move(luminance),
          repairs,
          RadianceUnit::kCdM2,
          {},
          0};
}

LuminanceUnit luminance_unit(const ShownField& field) {
  if (field.unit == RadianceUnit::kCdM2) return {"cd_m2", "cd/m²"};
  return {"relative", "relative"};
}

std::string setting_name(const LuminanceOptions& options) {
  std::string name = name_of(options.method);
  if (options.smoothed) name += ", smoothed";
  if (options.method == LuminanceMethod::kSpread && !options.normalised_spread) name += ", not normalised";
  return name;
}

TimedEstimate timed_estimate(const ShownField& field, const ObserverSamples& samples,
                             const LuminanceOptions& options) {
  const Stopwatch watch;
  TimedEstimate estimate{estimate_luminance(*field.display, field.luminance, samples, options), 0};
  estimate.seconds = watch.seconds();
  return estimate;
}

ReferencePictures reference_pictures(const ShownField& field, ObserverPosition observer, PinholeSize size,
                                     const RayReinhardOptions& reinhard, const LogAverageOptions& average,
                                     const RayRendering& rendering) {
  ReferencePictures pictures;
  Perceived<SceneReferred> seen = perceive(*field.display, field.rays, observer, size, rendering.threads);
  pictures.unlit_share = static_cast<double>(seen.unlit) / static_cast<double>(seen.image.size());
  pictures.result = std::move(seen.image);
  pictures.ln_result = log_average(pictures.result, average);
  pictures.on_result = map_picture(pictures.result, pictures.ln_result, reinhard, rendering.threads).light;
  if (!field.scene) return pictures;
  pictures.truth = render_pinhole(*field.scene, field.display->space(), observer, size, rendering);
  pictures.ln_truth = log_average(pictures.truth, average);
  pictures.ground_truth = map_picture(pictures.truth, pictures.ln_truth, reinhard, rendering.threads).light;
  return pictures;
}

double light_psnr_db(const DisplayLightImage& test, const DisplayLightImage& reference) {
  PLENOLAB_CHECK(test.width() == reference.width() && test.height() == reference.height(),
                 "pictures of one size");
  double squares = 0;
  for (std::size_t i = 0; i < test.size(); ++i) {
    const Rgb d = test.pixels()[i] - reference.pixels()[i];
    for (const float v : {d.r, d.g, d.b}) squares += static_cast<double>(v) * static_cast<double>(v);
  }
  return psnr_db(1, squares / (3.0 * static_cast<double>(test.size())));
}

std::vector<CurvePoint> curve_of(const GlobalLuminance& luminance) {
  std::vector<CurvePoint> curve;
  if (!luminance.known()) return curve;
  const ObserverSamples& samples = luminance.samples;
  for (int i = 0; i < samples.columns; ++i) {
    const int sample = samples.rows / 2 * samples.columns + i;
    curve.push_back({samples.position(sample).x_m, luminance.ln_luminance[static_cast<std::size_t>(sample)]});
  }
  return curve;
}

CurveMeasures measure_curve(const GlobalLuminance& luminance) {
  CurveMeasures measures;
  const std::vector<CurvePoint> curve = curve_of(luminance);
  if (curve.empty()) return measures;
  const auto [low, high] = std::minmax_element(
      curve.begin(), curve.end(),
      [](const CurvePoint& a, const CurvePoint& b) { return a.ln_luminance < b.ln_luminance; });
  measures.range = high->ln_luminance - low->ln_luminance;
  for (std::size_t i = 1; i < curve.size(); ++i)
    measures.total_variation += std::abs(curve[i].ln_luminance - curve[i - 1].ln_luminance);
  return measures;
}

}  // namespace plenolab
