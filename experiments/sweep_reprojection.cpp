#include "experiments/sweep_reprojection.h"

namespace plenolab {

namespace {

/// Sampling of the truth, the finest there is.
constexpr int kFinest = 4;

SweepOutcome outcome_of(const std::string& method, long long cameras, int supersampling) {
  return {.setting = {{"method", method},
                      {"cameras", cameras},
                      {"supersampling", static_cast<long long>(supersampling)}}};
}

SweepOutcome run_reprojection(const NearEyeScene& scene, ReprojectionMethod method, int cameras,
                              const DisplayImage& truth, const SweepRun& run) {
  SweepOutcome outcome = outcome_of(name_of(method), cameras, scene.supersampling);
  const CameraArray array = camera_array(scene.grid);
  const ReprojectionOptions options{.method = method, .threads = run.threads};
  DisplayImage image;
  double holes = 0;
  time_setting(
      outcome,
      [&] {
        const ReprojectionResult r = reproject(array, render_cameras(scene, cameras, run.threads), options);
        image = to_subimages(r.light_field, array.layout, scene.supersampling, run.threads);
        holes = static_cast<double>(r.holes) / static_cast<double>(r.pixels);
      },
      run.runs);
  outcome.error = mean_difference(difference_statistics(image, truth));
  outcome.values = {{"mean_error", outcome.error, "1"}, {"hole_share", holes, "1"}};
  return outcome;
}

SweepOutcome run_direct(const NearEyeScene& scene, const DisplayImage& truth, const SweepRun& run) {
  const SubimageLayout layout = camera_array(scene.grid).layout;
  SweepOutcome outcome =
      outcome_of("direct", static_cast<long long>(layout.columns) * layout.rows, scene.supersampling);
  DisplayImage image;
  time_setting(
      outcome,
      [&] {
        image = to_subimages(render_directly(scene, run.threads).light_field, layout, scene.supersampling,
                             run.threads);
      },
      run.runs);
  outcome.error = mean_difference(difference_statistics(image, truth));
  outcome.values = {{"mean_error", outcome.error, "1"}, {"hole_share", 0, "1"}};
  return outcome;
}

}  // namespace

ResultTable sweep_reprojection(const Scene& scene, const SweepRun& run) {
  const DirectScene built(scene);
  const NearEyeScene finest = prepare_near_eye(built, kFinest);
  const DisplayImage truth = to_subimages(render_directly(finest, run.threads).light_field,
                                          camera_array(finest.grid).layout, kFinest, run.threads);
  std::vector<SweepOutcome> outcomes;
  constexpr double kSettings = 14;
  const auto add = [&](SweepOutcome outcome) {
    outcomes.push_back(std::move(outcome));
    if (run.progress) run.progress(static_cast<double>(outcomes.size()) / kSettings);
  };
  for (const int supersampling : {1, 2, kFinest}) {
    // One exposure for all: images must differ by sampling only.
    NearEyeScene prepared = prepare_near_eye(built, supersampling);
    prepared.exposure = finest.exposure;
    for (const auto method : {ReprojectionMethod::kTwoStep, ReprojectionMethod::kOneStep})
      for (const int cameras : {4, 5}) add(run_reprojection(prepared, method, cameras, truth, run));
    // The finest with every camera rendered is the truth itself.
    if (supersampling < kFinest) add(run_direct(prepared, truth, run));
  }
  ResultTable table;
  add_outcome_rows(table, {{"scene", scene.id}}, outcomes);
  return table;
}

SweepPlotDesign reprojection_sweep_plot() {
  return {"mean_error", "Mean difference", "1", {"method", "cameras"}, "supersampling"};
}

}  // namespace plenolab
