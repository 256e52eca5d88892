#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "core/luminance/display_folder.h"
#include "experiments/luminance_field.h"
#include "experiments/sweep_luminance.h"
#include "stimuli/scenes/table.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {

/// Values by quantity and method; of rows with an observer, those of the first.
std::map<std::string, double> rows_of(const std::string& json) {
  std::map<std::string, double> values;
  const nlohmann::json results = nlohmann::json::parse(read_text_file(json));
  for (const auto& row : results["rows"])
    if (row["value"].is_number())
      values.emplace(row["quantity"].get<std::string>() + " " + row.value("method", ""),
                     row["value"].get<double>());
  return values;
}

ShownField small_field(const std::string& scene) {
  return show_scene(build_display_scene(scene),
                    std::make_shared<const ProjectorDisplay>(
                        ProjectorDisplayOptions{.projectors = 12, .width = 40, .height = 22}),
                    {.samples_across = 1, .threads = 2});
}

TEST(LuminanceField, TheRayOfAProjectorShowsWhatAPinholeCameraWouldSeeThere) {
  const ShownField field = small_field("pillars");
  const auto& display = *field.display;
  for (const Ray ray : {Ray{0, 3, 4}, {6, 20, 11}, {11, 39, 21}}) {
    const SceneImage picture = render_pinhole(*field.scene, display.space(), display.position(ray),
                                              display.resolution(), {.samples_across = 1, .threads = 1});
    EXPECT_EQ(picture.at(ray.u, ray.v), field.rays.at(ray));
  }
}

TEST(LuminanceField, OnlyColumnsThatReachTheObserverNeedRendering) {
  const ShownField whole = small_field("sphere");
  const ObserverPosition observer{1.3, 0};
  const ShownField part =
      show_scene_to(build_display_scene("sphere"), whole.display, {observer}, {.samples_across = 1});
  const PinholeSize size = whole.display->resolution();
  EXPECT_EQ(perceive(*whole.display, whole.rays, observer, size).image,
            perceive(*part.display, part.rays, observer, size).image);
}

TEST(LuminanceField, OnResultIsWhatTheDisplayShowsWhereNeighboursAgree) {
  // All projectors show the same picture and all rays have its luminance: mixing and tone mapping can change
  // places.
  const ShownField scene = small_field("sphere");
  SceneRays rays(scene.display->size());
  for (int k = 0; k < rays.size().images; ++k) set_image(rays, k, image_of(scene.rays, 6));
  const ShownField field = show_rays("same", scene.display, std::move(rays));
  const PinholeSize size = field.display->resolution();
  const ReferencePictures references = reference_pictures(field, {2, 0}, size, {}, {}, {});
  EXPECT_TRUE(references.ground_truth.empty()) << "there is no scene to be seen";
  ASSERT_TRUE(references.ln_result);
  const GlobalLuminance constant{samples_of(*field.display, 1), {*references.ln_result}, {1}};
  const DisplayRays mapped = map_rays(*field.display, field.rays, constant).light;
  const auto seen = perceive(*field.display, mapped, {2, 0}, size);
  EXPECT_GT(light_psnr_db(seen.image, references.on_result), 100);
  EXPECT_EQ(light_psnr_db(seen.image, seen.image), std::numeric_limits<double>::infinity());
}

TEST(LuminanceField, MeasuresRangeAndVariationOfACurve) {
  const CurveMeasures measures = measure_curve({{4, 1, 0, 4, 0, 0}, {1, 3, 0, 1}, {1, 1, 1, 1}});
  EXPECT_EQ(measures.range, 3);
  EXPECT_EQ(measures.total_variation, 6);
  EXPECT_EQ(measure_curve({}).range, 0);
}

TEST(LuminanceSweep, ErrorsFallWithSamplesAndTheFinestBruteForceIsTheReference) {
  const ResultTable rows = sweep_luminance(small_field("sphere"), {.runs = 1, .threads = 2, .progress = {}});
  std::map<std::string, double> error;
  for (const ResultRow& row : rows.rows())
    if (row.quantity == "rms_error")
      error[std::get<std::string>(row.columns[1].second) + " " +
            std::get<std::string>(row.columns[2].second) + " " +
            std::to_string(std::get<long long>(row.columns[3].second))] = row.value;
  EXPECT_LT(error.at("brute-force 40x22 10000"), 1e-9);
  EXPECT_LT(error.at("brute-force 40x22 1000"), error.at("brute-force 40x22 10"));
  EXPECT_LT(error.at("spread  1000"), error.at("accumulative  1000"));
}

TEST(LuminanceCommand, WritesViewsPlotAndSamples) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), json = (folder.path() / "rows.json").string();
  const auto run = run_program(
      {"luminance", "sphere", "--preset", "quick", "-o", out, "--display-images", "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* file :
       {"luminance.svg", "samples.csv", "perceived-left.exr", "perceived-right.png",
        "ground-truth-centre.png", "on-result-left.png", "spread-right.png", "all-left.png", "run.json"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + file)) << file;
  const auto rows = rows_of(json);
  EXPECT_GT(rows.at("luminance_max_cd_m2 brute-force"), 30 * rows.at("luminance_min_cd_m2 brute-force"));
  EXPECT_NEAR(rows.at("luminance_max_cd_m2 all"), rows.at("luminance_min_cd_m2 all"), 1e-9);
  EXPECT_GT(rows.at("psnr_ground_truth_db accumulative"), rows.at("psnr_ground_truth_db all"));
  EXPECT_EQ(rows.at("undefined_samples accumulative"), 0);

  // The same from the projectors' images on disk, which have no ground truth.
  const std::string again = (folder.path() / "again.json").string();
  const auto from_disk = run_program({"luminance", out + "/display", "--samples", "200", "--json", again});
  ASSERT_EQ(from_disk.status, 0) << from_disk.err;
  const auto read = rows_of(again);
  for (const char* quantity :
       {"luminance_max_cd_m2 brute-force", "luminance_min_cd_m2 spread", "psnr_on_result_db all"})
    EXPECT_NEAR(read.at(quantity), rows.at(quantity), 1e-4 * rows.at(quantity)) << quantity;
  EXPECT_EQ(read.count("psnr_ground_truth_db all"), 0u);
}

TEST(LuminanceCommand, TakesTheMiddleRowOfALightFieldAsViews) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string();
  const auto run =
      run_program({"luminance", written_plane(folder.path() / "plane").string(), "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(rows_of(json).at("samples brute-force"), 3);
}

TEST(LuminanceCommand, SimulatesTheOtherDisplaysToo) {
  const TemporaryFolder folder;
  for (const char* kind : {"multi-view", "lenticular", "barrier"}) {
    const std::string json = (folder.path() / "rows.json").string();
    const auto run =
        run_program({"luminance", "sphere", "--display", kind, "--preset", "quick", "--json", json});
    ASSERT_EQ(run.status, 0) << kind << ": " << run.err;
    const auto rows = rows_of(json);
    EXPECT_EQ(rows.at("undefined_samples accumulative"), 0) << kind;
    EXPECT_GT(rows.at("psnr_on_result_db brute-force"), 20) << kind;
  }
}

TEST(LuminanceCommand, SaysThatNothingIsBrightEnoughInsteadOfComparingBlackPictures) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string();
  const auto run =
      run_program({"luminance", "sphere", "--preset", "quick", "--epsilon", "1e20", "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("undefined"), std::string::npos) << run.out;
  const auto rows = rows_of(json);
  EXPECT_EQ(rows.at("undefined_samples spread"), 200);
  EXPECT_EQ(rows.count("psnr_on_result_db spread"), 0u);
  EXPECT_EQ(rows.count("luminance_max_cd_m2 spread"), 0u);
}

TEST(LuminanceCommand, TellsWrongUseInASentence) {
  expect_one_clear_sentence(run_program({"luminance", "spere"}), "sphere", 2);
  expect_one_clear_sentence(run_program({"luminance", "no/where"}), "does not exist");
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--method", "fast"}), "fast", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--pinhole", "12"}), "--pinhole", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--method", "all", "--smoothed"}),
                            "--smoothed", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--observers", "left"}), "--observers", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--display-images"}), "-o", 2);
}

}  // namespace
}  // namespace plenolab
