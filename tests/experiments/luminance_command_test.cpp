#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "core/io/white_luminance.h"
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

/// Values of a quantity of a sweep by "method pinhole samples".
std::map<std::string, double> by_setting(const ResultTable& rows, const std::string& quantity) {
  std::map<std::string, double> values;
  for (const ResultRow& row : rows.rows())
    if (row.quantity == quantity)
      values[std::get<std::string>(row.columns[1].second) + " " +
             std::get<std::string>(row.columns[2].second) + " " +
             std::to_string(std::get<long long>(row.columns[3].second))] = row.value;
  return values;
}

TEST(LuminanceSweep, ErrorsFallWithSamplesAndTheReferenceIsNotComparedWithItself) {
  const ResultTable rows = sweep_luminance(small_field("sphere"), {.runs = 1, .threads = 2, .progress = {}});
  const auto error = by_setting(rows, "rms_error"), front = by_setting(rows, "on_pareto_front"),
             to_scene = by_setting(rows, "rms_error_to_scene"),
             front_to_scene = by_setting(rows, "on_pareto_front_to_scene");
  const std::string reference = "brute-force 40x22 10000";
  EXPECT_EQ(error.count(reference) + front.count(reference), 0u);
  EXPECT_EQ(to_scene.count(reference) + front_to_scene.count(reference), 2u);
  EXPECT_EQ(front.size(), 27u);
  EXPECT_LT(error.at("brute-force 40x22 1000"), error.at("brute-force 40x22 10"));
  EXPECT_LT(error.at("spread  1000"), error.at("accumulative  1000"));
  // The least error is on its front.
  for (const auto& [errors, fronts] : {std::pair{&error, &front}, std::pair{&to_scene, &front_to_scene}}) {
    const auto least = std::min_element(errors->begin(), errors->end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
    EXPECT_EQ(fronts->at(least->first), 1) << least->first;
  }
}

TEST(LuminanceSweep, PlotsBothTruthsWithLabelsApart) {
  const ResultTable rows = sweep_luminance(small_field("sphere"), {.runs = 1, .threads = 2, .progress = {}});
  for (const LuminanceTruth truth : {LuminanceTruth::kBruteForce, LuminanceTruth::kScene}) {
    const Plot plot = plot_luminance_sweep(rows, truth);
    ASSERT_EQ(plot.series.size(), 7u);
    EXPECT_EQ(plot.series[3].title, "accumulative");
    std::size_t points = 0, labels = 0;
    for (const PlotSeries& series : plot.series) {
      points += series.points.size();
      for (const PlotPoint& p : series.points) {
        labels += p.label.empty() ? 0 : 1;
        EXPECT_GT(p.y, 1e-12);
      }
    }
    EXPECT_GE(points, 26u);
    EXPECT_GT(labels, 3u);
    EXPECT_LT(labels, points);
  }
  const SceneRays rays = small_field("sphere").rays;
  const ShownField bare = show_rays("bare", small_field("sphere").display, rays);
  const ResultTable without = sweep_luminance(bare, {.runs = 1, .threads = 2, .progress = {}});
  EXPECT_TRUE(plot_luminance_sweep(without, LuminanceTruth::kScene).series.empty());
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

/// Notes of a result file, one after the other.
std::string notes_of(const std::string& json) {
  std::string notes;
  const nlohmann::json results = nlohmann::json::parse(read_text_file(json));
  for (const auto& row : results["rows"])
    if (row["quantity"] == "note") notes += row["note"].get<std::string>() + "\n";
  return notes;
}

/// Rounded, as JSON of sums of cells is not exact.
double micrometres(double metres) {
  return std::round(metres * 1e6) / 1e6;
}

/// Positions of the observers in a result file.
std::set<std::pair<double, double>> observers_in(const std::string& json) {
  std::set<std::pair<double, double>> positions;
  const nlohmann::json results = nlohmann::json::parse(read_text_file(json));
  for (const auto& row : results["rows"])
    if (row.contains("observer_x_m"))
      positions.insert({micrometres(row["observer_x_m"]), micrometres(row.value("observer_y_m", 0.0))});
  return positions;
}

TEST(LuminanceCommand, LooksFromWhereAMultiViewDisplayHasViews) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string();
  const auto run =
      run_program({"luminance", "sphere", "--display", "multi-view", "--preset", "quick", "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto positions = observers_in(json);
  ASSERT_EQ(positions.size(), 3u);
  for (const auto& [x, y] : positions) {
    const double view = (x + 0.5) * 9 - 0.5;  // nine views from -0.5 to 0.5 m
    EXPECT_NEAR(view, std::round(view), 1e-4) << x;
  }
  // At these the scene itself is what the views show.
  EXPECT_NEAR(rows_of(json).at("psnr_ground_truth_db brute-force"),
              rows_of(json).at("psnr_on_result_db brute-force"), 1);
}

TEST(LuminanceCommand, LooksFromAnywhereOnThePlaneOfFullParallaxAndSaysWhichRowIsShown) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string();
  const auto run =
      run_program({"luminance", "sphere", "--display", "full-parallax", "--preset", "quick", "--method",
                   "all,accumulative", "--observers=-0.2:0.1,0.2:-0.1,0", "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(observers_in(json), (std::set<std::pair<double, double>>{{-0.2, 0.1}, {0.2, -0.1}, {0, 0.0375}}));
  EXPECT_NE(notes_of(json).find("row 5 of 8"), std::string::npos) << notes_of(json);
  EXPECT_NE(run.out.find("observer_y_m"), std::string::npos);
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

/// A folder of three projectors that show one grey each, its images with or without whiteLuminance.
std::filesystem::path grey_display(const std::filesystem::path& folder, float value,
                                   std::optional<double> white_cd_m2 = std::nullopt) {
  const ProjectorDisplay display({.projectors = 3, .width = 8, .height = 4});
  SceneRays rays(display.size());
  for (int k = 0; k < 3; ++k)
    for (int u = 0; u < 8; ++u)
      for (int v = 0; v < 4; ++v) rays.at({k, u, v}) = {value, value, value};
  write_display_folder(folder, display, rays);
  if (white_cd_m2)
    for (int k = 0; k < 3; ++k)
      write_scene_image(folder / ("projector-00" + std::to_string(k) + ".exr"), image_of(rays, k),
                        *white_cd_m2);
  return folder;
}

TEST(LuminanceCommand, KeepsRelativeRadianceApartFromCandela) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string(), out = (folder.path() / "out").string();
  const std::filesystem::path plane = written_plane(folder.path() / "plane");
  std::string description = read_text_file(plane / "lightfield.json");
  const auto radiance = description.find("\"cd/m2\"");
  if (radiance != std::string::npos)
    write_text_file(plane / "lightfield.json", description.replace(radiance, 7, "\"relative\""));
  const auto run = run_program({"luminance", plane.string(), "-o", out, "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out.find("cd/m²"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("[relative]"), std::string::npos) << run.out;
  EXPECT_NE(notes_of(json).find("relative"), std::string::npos);
  const auto relative = rows_of(json);
  EXPECT_EQ(relative.count("luminance_min_cd_m2 all"), 0u);
  EXPECT_FALSE(white_luminance(out + "/perceived-centre.exr"));
  EXPECT_EQ(read_text_file(out + "/samples.csv").find("cd/m"), std::string::npos);

  const auto scaled = run_program({"luminance", plane.string(), "--cd-m2-per-unit", "50", "-o", out,
                                   "--force", "--epsilon", "0.005", "--json", json});
  ASSERT_EQ(scaled.status, 0) << scaled.err;
  EXPECT_NEAR(rows_of(json).at("luminance_min_cd_m2 all"), 50 * relative.at("luminance_min_relative all"),
              1e-3 * 50 * relative.at("luminance_min_relative all"));
  EXPECT_EQ(white_luminance(out + "/perceived-centre.exr"), 1);
}

TEST(LuminanceCommand, TakesTheScaleOfProjectorImagesFromThemOrTheUser) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string();
  const std::string plain = grey_display(folder.path() / "plain", 2).string(),
                    white = grey_display(folder.path() / "white", 2, 25.0).string();
  const auto least = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", json});
    const auto run = run_program(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    return rows_of(json).at("luminance_min_cd_m2 all");
  };
  EXPECT_NEAR(least({"luminance", plain}), 2, 1e-5);
  EXPECT_NEAR(least({"luminance", white}), 50, 1e-3);
  EXPECT_NEAR(least({"luminance", white, "--cd-m2-per-unit", "3"}), 6, 1e-4);
}

TEST(LuminanceCommand, SaysWhomTheDisplayDoesNotReach) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string(), out = (folder.path() / "out").string();
  const std::string grey = grey_display(folder.path() / "grey", 2).string();
  const auto far = run_program({"luminance", grey, "--observers", "200", "-o", out, "--json", json});
  ASSERT_EQ(far.status, 0) << far.err;
  const auto rows = rows_of(json);
  EXPECT_EQ(rows.at("unlit_share all"), 1);
  EXPECT_EQ(rows.count("luminance_cd_m2 all"), 0u);
  EXPECT_EQ(rows.count("psnr_on_result_db all"), 0u);
  EXPECT_NE(notes_of(json).find("200 m"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out + "/perceived-200m.exr"));

  const auto near =
      run_program({"luminance", "sphere", "--preset", "quick", "--observers", "0,8", "--json", json});
  ASSERT_EQ(near.status, 0) << near.err;
  EXPECT_EQ(rows_of(json).at("unlit_share all"), 0);
  EXPECT_NE(notes_of(json).find("at 8 m"), std::string::npos) << notes_of(json);
  EXPECT_EQ(notes_of(json).find("at 0 m"), std::string::npos);
  EXPECT_NE(near.out.find("unlit share"), std::string::npos);
}

TEST(LuminanceCommand, TellsWhatItRepairedAndCut) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "rows.json").string();
  const std::filesystem::path display = grey_display(folder.path() / "display", 2);
  SceneImage image(8, 4);
  for (Rgb& c : image.pixels()) c = {0, 0, 1000};
  image.at(3, 1).r = std::numeric_limits<float>::quiet_NaN();
  write_scene_image(display / "projector-001.exr", image);
  const auto run = run_program({"luminance", display.string(), "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(rows_of(json).at("repaired_values "), 1);
  EXPECT_GT(rows_of(json).at("clipped_high all"), 0);
  EXPECT_NE(run.out.find("1 not a number"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("to white"), std::string::npos) << run.out;

  const auto clean =
      run_program({"luminance", grey_display(folder.path() / "clean", 2).string(), "--json", json});
  EXPECT_EQ(rows_of(json).at("repaired_values "), 0);
  EXPECT_EQ(notes_of(json), "") << clean.out;
}

TEST(LuminanceCommand, KnowsWhichFoldersItReads) {
  const TemporaryFolder folder;
  expect_one_clear_sentence(run_program({"luminance", folder.path().string()}), "display.json");
  const std::string grey = grey_display(folder.path() / "grey", 2).string();
  expect_one_clear_sentence(run_program({"luminance", grey, "--preset", "full"}), "--preset", 2);
  const std::string out = (folder.path() / "out").string();
  ASSERT_EQ(run_program({"luminance", grey, "-o", out}).status, 0);
  const auto run_json = nlohmann::json::parse(read_text_file(out + "/run.json"));
  EXPECT_FALSE(run_json["parameters"].contains("preset"));

  const std::string sweep = (folder.path() / "sweep").string();
  ASSERT_EQ(run_program({"sweep", "luminance", grey, "--runs", "1", "-o", sweep}).status, 0);
  EXPECT_EQ(nlohmann::json::parse(read_text_file(sweep + "/run.json"))["inputs"].size(), 1u);
}

TEST(LuminanceCommand, TellsWrongUseInASentence) {
  expect_one_clear_sentence(run_program({"luminance", "spere"}), "sphere", 2);
  expect_one_clear_sentence(run_program({"luminance", "no/where"}), "does not exist");
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--method", "fast"}), "fast", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--pinhole", "12"}), "--pinhole", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--method", "all", "--smoothed"}),
                            "--smoothed", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--observers", "left"}), "--observers", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--preset", "quick", "--observers", "0:1"}),
                            "X:Y", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--display-images"}), "-o", 2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--method", "all,all"}), "--method", 2);
  for (const char* twice : {"0,0", "-0,0", "1,2,1"})
    expect_one_clear_sentence(run_program({"luminance", "sphere", "--observers=" + std::string(twice)}),
                              "--observers", 2);
  expect_one_clear_sentence(
      run_program({"luminance", "sphere", "--display", "full-parallax", "--samples", "4000"}), "--samples",
      2);
  expect_one_clear_sentence(run_program({"luminance", "sphere", "--cd-m2-per-unit", "3"}), "--cd-m2-per-unit",
                            2);
}

}  // namespace
}  // namespace plenolab
