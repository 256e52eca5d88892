#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/luminance/projector_display.h"
#include "experiments/luminance_field.h"
#include "experiments/reproduce/laboratory.h"

namespace plenolab {

/// What the items on the luminance of a projector display share during one run: the two scenes on the
/// display, the estimates and the scores along the observers' line, each computed when first asked for and
/// kept. References stay valid.
///
/// A quick run has the display's 96 projectors, which decide how depth blurs, with images of 160 × 90 pixels
/// and 200 samples, so that a sample has as many columns of rays (58) as the paper's 1000 have on a display
/// with 800 columns; a tiny one 12 projectors of 40 × 22; a paper run 1280 × 720 and 1000 samples.
class LuminanceBench {
 public:
  explicit LuminanceBench(LaboratoryOptions options) : options_(std::move(options)) {}

  /// PSNR of what an observer sees, tone mapped with an estimate, at every position of the line.
  struct Scores {
    std::vector<double> x_m;
    /// By method, in the order of methods().
    std::vector<std::vector<double>> ground_truth_db, on_result_db;
    /// Estimated ln L̄ − that of the ground truth's picture, by method; nothing where that picture has no
    /// pixel above ε or nothing is estimated.
    std::vector<std::vector<std::optional<double>>> ln_error;
  };

  /// "sphere" and "pillars".
  const std::vector<std::string>& scene_ids() const;
  std::string title(const std::string& id) { return field(id).scene->scene().scene.title; }
  /// All, BruteForce, Accumulative, and what the paper suggests: Accumulative with spread rays.
  std::vector<LuminanceMethod> methods() const;
  /// Brute force at the display's own resolution for every method that uses one.
  LuminanceOptions method_options(LuminanceMethod method);

  /// The scene on the display of this run; with `projectors` > 0 on one with so many of the same images.
  const ShownField& field(const std::string& id, int projectors = 0);
  ObserverSamples samples();
  const GlobalLuminance& estimate(const std::string& id, const LuminanceOptions& options, int projectors = 0);
  const Scores& scores(const std::string& id);

  /// Views from the left, the centre and the right on the display with larger pictures, tone mapped with the
  /// estimates of the display of this run. Only rays that reach these observers are rendered.
  struct ShownView {
    double x_m = 0;
    const char* name = "";
    ReferencePictures references;
    std::vector<DisplayLightImage> mapped;  ///< in the order of methods()
  };
  const std::vector<ShownView>& shown_views(const std::string& id);

  const LaboratoryOptions& options() const { return options_; }
  ProjectorDisplayOptions display_options() const;

 private:
  RayRendering rendering() const { return {.threads = options_.threads}; }
  Scores score(const std::string& id);
  std::vector<ShownView> show(const std::string& id);

  LaboratoryOptions options_;
  std::map<std::pair<std::string, int>, ShownField> fields_;
  std::map<std::tuple<std::string, int, std::string>, GlobalLuminance> estimates_;
  std::map<std::string, Scores> scores_;
  std::map<std::string, std::vector<ShownView>> shown_;
};

}  // namespace plenolab
