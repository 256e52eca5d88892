#include "experiments/near_eye.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "tests/experiments/run_program.h"

namespace plenolab {
namespace {

TEST(NearEye, CountsDifferencesInCodesOfEightBits) {
  DisplayImage a(4, 1), b(4, 1);
  a.at(0, 0) = {10 / 255.0f, 0, 1};
  b.at(0, 0) = {13 / 255.0f, 0, 0};
  a.at(1, 0) = {0.2f / 255, 0, 0};  // the same code as 0
  b.at(2, 0) = {1 / 255.0f, 0, 0};
  const auto statistics = difference_statistics(a, b);
  EXPECT_DOUBLE_EQ(statistics[0].max, 3 / 255.0);
  EXPECT_DOUBLE_EQ(statistics[0].min, 0);
  EXPECT_DOUBLE_EQ(statistics[0].mean, 4 / 255.0 / 4);
  EXPECT_DOUBLE_EQ(statistics[0].median, 0.5 / 255) << "between the second and third of 0 0 1 3";
  EXPECT_DOUBLE_EQ(statistics[1].max, 0);
  EXPECT_DOUBLE_EQ(statistics[2].max, 1);
  EXPECT_THROW(difference_statistics(a, DisplayImage(3, 1)), InputError);
}

TEST(NearEye, TakesOnlySquareViewsThatAreEquallyFarApart) {
  EXPECT_NO_THROW(camera_array({15, 8, 0.001, 0.001, 81, 81, 20}));
  EXPECT_THROW(camera_array({15, 8, 0.001, 0.001, 81, 80, 20}), InputError);
  EXPECT_THROW(camera_array({15, 8, 0.001, 0.002, 81, 81, 20}), InputError);
}

TEST(NearEye, NamesEveryFill) {
  for (const std::string& name : hole_fill_names()) EXPECT_EQ(name_of(hole_fill_named(name)), name);
  EXPECT_THROW(hole_fill_named("grey"), InputError);
}

TEST(ReprojectCommand, WritesTheLightFieldForThePanelAndSaysHowItDiffers) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), json = (folder.path() / "rows.json").string();
  const auto run = run_program({"reproject", "near-eye-2", "-o", out, "--compare", "--supersampling", "1",
                                "--eye", "0,0,0", "--focus", "0.5", "--optics", "thin-lens", "--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  const DisplayImage light_field = read_display_image(out + "/light-field.png");
  EXPECT_EQ(light_field.width(), 1215);
  EXPECT_EQ(light_field.height(), 648);
  EXPECT_EQ(read_display_image(out + "/panel.png").width(), 1280);
  EXPECT_EQ(read_display_image(out + "/centre.png").width(), 81);
  for (const char* file : {"difference.png", "vc-light-field.png", "retina.png", "run.json"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + file)) << file;
  std::set<std::string> quantities;
  const nlohmann::json results = nlohmann::json::parse(read_text_file(json));
  for (const auto& row : results["rows"]) {
    quantities.insert(row["quantity"].get<std::string>());
    if (row["quantity"] == "difference_mean") {
      EXPECT_GT(row["value"].get<double>(), 0);
      EXPECT_LT(row["value"].get<double>(), 0.05);
    }
  }
  for (const char* quantity : {"difference_max", "difference_median", "hole_share", "seconds_direct"})
    EXPECT_TRUE(quantities.count(quantity)) << quantity;
}

TEST(ReprojectCommand, RefusesWhatWouldBeIgnored) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--method", "direct", "--compare"}, "--method direct"},
      {{"--focus", "0.5"}, "--eye"},
      {{"--pupil", "3"}, "--eye"}};
  for (const auto& [options, word] : cases) {
    std::vector<std::string> arguments{"reproject", "near-eye-2", "-o", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.status, 2) << options.front();
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(ReprojectCommand, RefusesWhatDoesNotFitTogether) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  EXPECT_EQ(run_program({"reproject", "near-eye-2", "-o", out, "--cameras", "6"}).status, 2);
  EXPECT_EQ(run_program({"reproject", "near-eye-9", "-o", out}).status, 2);
  EXPECT_EQ(run_program({"reproject", "-o", out}).status, 2);
  EXPECT_EQ(run_program({"reproject", "near-eye-2", "--image-set", "-o", out}).status, 2);
  EXPECT_EQ(run_program({"reproject", "near-eye-2", "-o", out, "--eye", "0,0"}).status, 2);
  EXPECT_EQ(run_program({"reproject", "nowhere/at-all", "-o", out}).status, 1);
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace plenolab
