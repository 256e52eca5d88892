#include "analysis/calibration/measurement_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "analysis/calibration/setups.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {

constexpr const char* kSmall = R"({
  "format": "plenolab-calibration", "version": 1,
  "instrument": {"subimage_px": 83.25, "camera_spacing_mm": 1, "render_fov_deg": 19.86},
  "parameters": {"d_l_mm": {"nominal": 3.29}, "p_mm": {"nominal": 0.012, "sd": 1e-5},
                 "f_mm": {"nominal": 3.3, "fixed": true}},
  "records": [
    {"kind": "edge", "axis": "x", "side": "negative", "camera_height_mm": 300, "displacement_mm": 45, "sd_mm": 0.2},
    {"kind": "grid", "column": -7, "row": 3, "x_px": -580, "y_px": 250, "sd_px": 0.3}
  ]
})";

std::string with(const std::string& what, const std::string& instead) {
  std::string text = kSmall;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

std::string error_of(const std::string& json) {
  try {
    parse_measurements(json, "m.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CalibrationFileTest, WhatIsWrittenIsReadBackTheSame) {
  for (const CalibrationMeasurements& m :
       {simulate_measurements(full_rig(), 3), thesis_measurements(), simulate_measurements(grid_rig(), 3)}) {
    const std::string text = format_measurements(m);
    EXPECT_EQ(format_measurements(parse_measurements(text, "m.json")), text);
  }
}

TEST(CalibrationFileTest, SoAreRigs) {
  CalibrationRig rig = full_rig();
  rig.outlier_share = 0.1;
  rig.outlier_deviations = 20;
  const std::string text = format_rig(rig);
  const CalibrationRig again = parse_rig(text, "rig.json");
  EXPECT_EQ(format_rig(again), text);
  EXPECT_EQ(again.truth, rig.truth);
  EXPECT_EQ(text.find("displacement_mm"), std::string::npos) << "a rig has no readings";
}

TEST(CalibrationFileTest, RolesOfParametersAreRead) {
  const CalibrationMeasurements m = parse_measurements(kSmall, "m.json");
  using Role = ParameterSetting::Role;
  EXPECT_EQ(m.parameters[index_of(CalibrationParameter::kLensDistance)].role, Role::kFree);
  EXPECT_EQ(m.parameters[index_of(CalibrationParameter::kPixelPitch)].role, Role::kAnchored);
  EXPECT_EQ(m.parameters[index_of(CalibrationParameter::kFocalLength)].role, Role::kFixed);
  EXPECT_EQ(m.parameters[index_of(CalibrationParameter::kRotation)].role, Role::kFixed);
  EXPECT_EQ(std::get<EdgeRecord>(m.records[0]).side, -1);
}

TEST(CalibrationFileTest, EveryFaultIsToldInOneSentenceWithItsPlace) {
  const std::vector<std::tuple<std::string, std::string, std::string>> faults{
      {"plenolab-calibration", "other", "\"format\" must be"},
      {"\"version\": 1", "\"version\": 2", "\"version\" must be 1"},
      {"\"sd_mm\": 0.2", "\"sd_mm\": 0", "records[0].sd_mm must lie"},
      {"\"sd_mm\": 0.2", "\"sd_mm\": \"0.2\"", "\"records[0].sd_mm\" must be a number, not string"},
      {"\"kind\": \"edge\"", "\"kind\": \"hedge\"", "must be \"edge\", \"field-of-view\""},
      {"\"negative\"", "\"left\"", "\"records[0].side\" must be \"positive\" or \"negative\", not \"left\""},
      {"\"column\": -7", "\"column\": 0.5", "\"records[1].column\" must be a whole number"},
      {"d_l_mm", "dl_mm", "is not a parameter: there are p_mm"},
      {"\"fixed\": true", "\"fixed\": true, \"sd\": 1", "cannot have a standard deviation"},
      {"\"nominal\": 3.29", "\"nominal\": -1", "parameters.d_l_mm.nominal must lie"},
      {"\"x_px\"", "\"xpx\"", "\"records[1].x_px\" is missing"},
      {"\"y_px\": 250", "\"y_px\": 250, \"z_px\": 1", "\"records[1].z_px\" is not a key"},
      {"\"camera_spacing_mm\": 1,", "", "\"instrument.camera_spacing_mm\" is missing"},
      {"\"render_fov_deg\": 19.86", "\"render_fov_deg\": 190", "instrument.render_fov_deg must lie"},
  };
  for (const auto& fault : faults) {
    const std::string message = error_of(with(std::get<0>(fault), std::get<1>(fault)));
    EXPECT_EQ(message.rfind("m.json: ", 0), 0u) << message;
    EXPECT_NE(message.find(std::get<2>(fault)), std::string::npos) << message;
  }
  EXPECT_NE(error_of("{").find("is not valid JSON"), std::string::npos);
  EXPECT_NE(error_of("[]").find("must be an object"), std::string::npos);
  EXPECT_NE(error_of(std::string(100, '[')).find("nested too deeply"), std::string::npos);
}

TEST(CalibrationFileTest, NothingToFitOrToFitToIsAnError) {
  EXPECT_NE(error_of(with("{\"nominal\": 3.29}, \"p_mm\": {\"nominal\": 0.012, \"sd\": 1e-5}",
                          "{\"nominal\": 3.29, \"fixed\": true}"))
                .find("every parameter is fixed"),
            std::string::npos);
  std::string text = kSmall;
  text = text.substr(0, text.find("\"records\"")) + "\"records\": []}";
  EXPECT_NE(error_of(text).find("there are no records"), std::string::npos);
}

TEST(CalibrationFileTest, TheExamplesThatAreShippedAreWhatTheSetUpsSay) {
  const std::filesystem::path folder =
      std::filesystem::path(PLENOLAB_SOURCE_DIR) / "analysis/calibration/examples";
  EXPECT_EQ(read_text_file(folder / "thesis.json"), format_measurements(thesis_measurements()));
  EXPECT_EQ(read_text_file(folder / "display.rig.json"), format_rig(full_rig()));
  EXPECT_EQ(read_text_file(folder / "display.json"),
            format_measurements(simulate_measurements(full_rig(), 1)));
  EXPECT_EQ(read_text_file(folder / "singular.json"),
            format_measurements(simulate_measurements(unanchored_rig(), 1)));
  EXPECT_EQ(read_text_file(folder / "anchored.json"),
            format_measurements(simulate_measurements(anchored_rig(), 1)));
}

}  // namespace
}  // namespace plenolab
