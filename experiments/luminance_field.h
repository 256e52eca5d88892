#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lightfield/light_field.h"
#include "core/luminance/perceived.h"
#include "core/luminance/ray_reinhard.h"
#include "experiments/ray_rendering.h"

namespace plenolab {

/// Displays, what they show, and how well tone mapping with an estimated luminance suits observers: what the
/// command, the sweep and the report items share.

/// A display with what it shows.
struct ShownField {
  std::string name;  ///< scene id or folder
  std::shared_ptr<const RayDisplay> display;
  SceneRays rays;  ///< finite, ≥ 0
  RayValues<float> luminance;
  PixelRepairs repairs;
  RadianceUnit unit = RadianceUnit::kCdM2;  ///< of rays and luminance
  std::optional<LitRays> scene;             ///< from which it was rendered, if it was
  double render_seconds = 0;
};

/// A scene of display_scenes(), rendered for a display.
ShownField show_scene(const LitScene& scene, std::shared_ptr<const RayDisplay> display,
                      const RayRendering& rendering = {});
/// The same, but only the columns of rays that reach one of the observers are rendered, the others stay
/// black: for looking at large displays. For displays in columns.
ShownField show_scene_to(const LitScene& scene, std::shared_ptr<const RayDisplay> display,
                         const std::vector<ObserverPosition>& observers, const RayRendering& rendering = {});
/// Rays from elsewhere; repairs them.
ShownField show_rays(std::string name, std::shared_ptr<const RayDisplay> display, SceneRays rays,
                     int threads = 0);

/// A method as a setting, with the name it has in tables: "accumulative, smoothed", "spread, not normalised"
/// …
struct NamedMethod {
  std::string name;
  LuminanceOptions options;
};
std::string setting_name(const LuminanceOptions& options);

/// The estimate of a method and how long it took from luminance to samples.
struct TimedEstimate {
  GlobalLuminance luminance;
  double seconds = 0;
};
TimedEstimate timed_estimate(const ShownField& field, const ObserverSamples& samples,
                             const LuminanceOptions& options);

/// How the luminance of a field is written: at the end of names of quantities, and as a unit.
struct LuminanceUnit {
  std::string suffix, name;  ///< "cd_m2" and "cd/m²", or both "relative"
};
LuminanceUnit luminance_unit(const ShownField& field);

/// The two references of section 7.2 for an observer: HDR pictures, and the operator applied to each as a
/// whole.
struct ReferencePictures {
  /// The pinhole picture of the scene itself; empty where there is no scene.
  SceneImage truth;
  /// The perceived picture of the display.
  SceneImage result;
  DisplayLightImage ground_truth, on_result;
  double unlit_share = 0;  ///< of the screen, black in `result`: no ray of the display reaches the observer
  std::optional<double> ln_truth, ln_result;  ///< ln L̄ of these pictures, as far as it is defined
};
ReferencePictures reference_pictures(const ShownField& field, ObserverPosition observer, PinholeSize size,
                                     const RayReinhardOptions& reinhard, const LogAverageOptions& average,
                                     const RayRendering& rendering);

/// PSNR of linear display light, peak 1, over all channels (section 7.3).
double light_psnr_db(const DisplayLightImage& test, const DisplayLightImage& reference);

/// Extent and restlessness of an estimate over the samples of its middle row: max − min, and Σ |difference
/// between neighbours|, of ln L̄.
struct CurveMeasures {
  double range = 0, total_variation = 0;
};
CurveMeasures measure_curve(const GlobalLuminance& luminance);

/// Samples of the middle row: x and ln L̄. Empty if nothing is known.
struct CurvePoint {
  double x_m, ln_luminance;
};
std::vector<CurvePoint> curve_of(const GlobalLuminance& luminance);

}  // namespace plenolab
