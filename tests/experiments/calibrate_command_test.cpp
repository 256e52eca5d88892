#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "tests/experiments/run_program.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

fs::path example(const std::string& name) {
  return fs::path(PLENOLAB_SOURCE_DIR) / "analysis/calibration/examples" / name;
}

nlohmann::json rows_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.err.empty()) << result.err;
  return result.status == 0 ? nlohmann::json::parse(result.out).at("rows") : nlohmann::json::array();
}

/// Values of a quantity of one parameter.
std::vector<double> values_of(const nlohmann::json& rows, const std::string& quantity,
                              const std::string& parameter) {
  std::vector<double> values;
  for (const auto& row : rows)
    if (row.at("quantity") == quantity && row.value("parameter", "") == parameter)
      values.push_back(row.at("value").get<double>());
  return values;
}

TEST(CalibrateCommand, GivesEstimatesWithDeviations) {
  const auto rows = rows_of({"calibrate", example("display.json").string()});
  const auto estimate = values_of(rows, "estimate", "d_l_mm"), sd = values_of(rows, "sd", "d_l_mm");
  ASSERT_EQ(estimate.size(), 1u);
  ASSERT_EQ(sd.size(), 1u);
  EXPECT_NEAR(estimate[0], 3.05, 4 * sd[0]);
}

TEST(CalibrateCommand, GivesNoEstimateOfWhatIsNotDetermined) {
  const auto rows = rows_of({"calibrate", example("singular.json").string()});
  EXPECT_TRUE(values_of(rows, "estimate", "d_l_mm").empty());
  EXPECT_TRUE(values_of(rows, "sd", "d_l_mm").empty());
  EXPECT_EQ(values_of(rows, "determined", "d_l_mm"), std::vector<double>{0});
  EXPECT_EQ(values_of(rows, "determined", "fov_deg"), std::vector<double>{1});
}

TEST(CalibrateCommand, SaysThatTheFiguresOfTheThesisCannotBeReconciledAndTested) {
  const ProgramResult result = run_program({"calibrate", example("thesis.json").string()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("contradict each other"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("nothing is left to test"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("With the Huber loss χ²"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("Plain least squares, without one source after the other:"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("records[0] (field-of-view) lies far off"), std::string::npos) << result.out;
}

TEST(CalibrateCommand, SuspectsAFixedValue) {
  const ProgramResult result =
      run_program({"calibrate", example("display.json").string(), "--fix", "d_l_mm"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("Without the source “fixed value of d_l” the rest agrees"), std::string::npos)
      << result.out;
}

TEST(CalibrateCommand, WritesAReportThatItsOwnRunMayReplace) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "calibration";
  for (int run = 0; run < 2; ++run) {
    const ProgramResult result =
        run_program({"calibrate", example("singular.json").string(), "-o", out.string()});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  for (const char* file : {"report.html", "rows.csv", "run.json", "residuals.svg", "open-directions.svg"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  EXPECT_NE(read_text_file(out / "report.html").find("cannot be told apart"), std::string::npos);
}

TEST(CalibrateCommand, SimulatesMeasurementsThatItCanFit) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "measurements.json").string();
  const ProgramResult result = run_program(
      {"calibrate", "--simulate", example("display.rig.json").string(), "-o", file, "--seed", "5"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto sd = values_of(rows_of({"calibrate", file}), "sd", "rotation_deg");
  ASSERT_EQ(sd.size(), 1u);
  EXPECT_GT(sd[0], 0);
}

TEST(CalibrateCommand, MeasuresCoverage) {
  const auto rows =
      rows_of({"calibrate", "--coverage", example("display.rig.json").string(), "--rigs", "20"});
  EXPECT_EQ(values_of(rows, "fits", "d_l_mm"), std::vector<double>{20});
}

TEST(CalibrateCommand, FreesAndFixesParametersByName) {
  const std::string file = example("anchored.json").string();
  const auto freed = rows_of({"calibrate", file, "--free", "p_mm"});
  EXPECT_EQ(values_of(freed, "determined", "d_l_mm"), std::vector<double>{0});
  const auto fixed = rows_of({"calibrate", file, "--fix", "f_mm"});
  EXPECT_TRUE(values_of(fixed, "sd", "f_mm").empty());
}

TEST(CalibrateCommand, WrongUseAndBadInputAreToldInOneSentence) {
  const std::string file = example("anchored.json").string();
  const TemporaryFolder folder;
  const std::string broken = (folder.path() / "broken.json").string();
  write_text_file(broken, "{\"format\": \"other\"}");
  const std::vector<std::tuple<std::vector<std::string>, int, std::string>> cases{
      {{"calibrate"}, 2, "give a file of measurements"},
      {{"calibrate", file, "--coverage", file}, 2, "only one"},
      {{"calibrate", "--simulate", file}, 2, "needs -o"},
      {{"calibrate", file, "--free", "d_mm"}, 2, "there is no parameter 'd_mm'"},
      {{"calibrate", file, "--loss", "hubert"}, 2, "huber"},
      {{"calibrate", "missing.json"}, 1, "missing.json"},
      {{"calibrate", broken}, 1, "\"format\" must be"},
      {{"calibrate", "--coverage", file}, 1, "plenolab-calibration-rig"},
  };
  for (const auto& c : cases) {
    const ProgramResult result = run_program(std::get<0>(c));
    EXPECT_EQ(result.status, std::get<1>(c)) << result.err;
    EXPECT_NE(result.err.find(std::get<2>(c)), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace plenolab
