// `plenolab lut` as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/lut/cube_file.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

class LutCommand : public testing::Test {
 protected:
  LutCommand() {
    DisplayImage picture(16, 8);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 16; ++x)
        picture.at(x, y) = {static_cast<float>(x) / 15, static_cast<float>(y) / 7, 0.5f};
    write_display_image(path("picture.png"), picture);
    write_lut(path("dim.cube"), bake_lut(2, [](Rgb c) { return c * 0.5f; }));
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  double value_of(const std::vector<std::string>& arguments, const std::string& quantity,
                  const std::string& column = "", const std::string& cell = "") const {
    std::vector<std::string> with_json = arguments;
    with_json.insert(with_json.end(), {"--json", "-"});
    const ProgramResult result = run_program(with_json);
    EXPECT_EQ(result.status, 0) << result.err;
    const nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
    if (json.is_discarded()) return std::nan("");
    for (const auto& row : json.at("rows"))
      if (row.at("quantity") == quantity && (column.empty() || row.at(column) == cell))
        return row.at("value");
    return std::nan("");
  }
  TemporaryFolder folder_;
};

TEST_F(LutCommand, EverySubcommandExplainsItselfWithAnExample) {
  for (const std::string name : {"info", "convert", "apply", "blend", "transfer", "frame", "walk"}) {
    const ProgramResult result = run_program({"lut", name, "--help"});
    EXPECT_EQ(result.status, 0) << name;
    EXPECT_NE(result.out.find("Example: plenolab lut " + name), std::string::npos) << name;
  }
}

TEST_F(LutCommand, ANeutralStripGradesNothing) {
  ASSERT_EQ(run_program({"lut", "convert", "identity", "--size", "16", "-o", path("neutral.png")}).status, 0);
  EXPECT_EQ(value_of({"lut", "apply", path("neutral.png"), path("picture.png"), "-o", path("same.png")},
                     "values_cut"),
            0);
  EXPECT_EQ(read_display_image(path("same.png")), read_display_image(path("picture.png")));
}

TEST_F(LutCommand, AppliesWhatTheTableSays) {
  ASSERT_EQ(run_program({"lut", "apply", path("dim.cube"), path("picture.png"), "--bits", "16", "-o",
                         path("dim.png")})
                .status,
            0);
  EXPECT_NEAR(read_display_image(path("dim.png")).at(15, 7).r, 0.5, 1e-4);
  EXPECT_TRUE(fs::exists(path("dim.png.run.json")));
}

TEST_F(LutCommand, WhatIsMissingToOneIsTheIdentitys) {
  EXPECT_NEAR(value_of({"lut", "blend", path("dim.cube") + "=0.5", "-o", path("blend.cube")}, "lut_maximum"),
              0.75, 1e-6);
  EXPECT_EQ(run_program({"lut", "blend", path("dim.cube") + "=1.5", "-o", path("b.cube")}).status, 2);
  EXPECT_EQ(run_program({"lut", "blend", path("dim.cube"), "-o", path("b.cube")}).status, 2);
  EXPECT_FALSE(fs::exists(path("b.cube")));
}

TEST_F(LutCommand, TransferBringsColoursNearer) {
  ASSERT_EQ(
      run_program({"lut", "apply", path("dim.cube"), path("picture.png"), "-o", path("dim.png")}).status, 0);
  const std::vector<std::string> transfer{
      "lut", "transfer", path("picture.png"), path("dim.png"), "-o", path("t.cube"), "--size", "17"};
  EXPECT_LT(value_of(transfer, "colour_distance_after"), 0.2 * value_of(transfer, "colour_distance_before"));
}

TEST_F(LutCommand, AFrameIsBlendedByWhatTheCameraSeesOrWhereItStands) {
  write_text_file(path("volumes.json"), R"({"format": "plenolab-volumes", "version": 1, "volumes": [
      {"name": "far", "min": [-9, 4, -9], "max": [9, 6, 9], "blend_radius_m": 8, "lut": "dim.cube"}]})");
  Plane<float> depth(16, 8, 5);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) depth.at(x, y) = 1;
  write_exr(path("depth.exr"), SceneImage(16, 8), {{"depth", &depth}});
  const std::vector<std::string> frame{"lut", "frame", path("volumes.json"), "--depth", path("depth.exr")};
  EXPECT_DOUBLE_EQ(value_of(frame, "blend_weight", "volume", "far"), 0.75);
  EXPECT_DOUBLE_EQ(value_of(frame, "blend_weight", "volume", "(background)"), 0.25);
  EXPECT_DOUBLE_EQ(
      value_of({"lut", "frame", path("volumes.json"), "--method", "linear"}, "blend_weight", "volume", "far"),
      0.5);
  ASSERT_EQ(run_program({"lut", "frame", path("volumes.json"), "--depth", path("depth.exr"), "--image",
                         path("picture.png"), "--graded", path("graded.png"), "-o", path("frame.cube")})
                .status,
            0);
  EXPECT_NEAR(read_display_image(path("graded.png")).at(15, 0).r, 0.625, 0.003);
  EXPECT_NEAR(read_lut(path("frame.cube")).node(31, 31, 31).g, 0.625, 1e-6);
}

TEST_F(LutCommand, WrongUseAndBadFilesAreToldApartAndLeaveNothing) {
  write_text_file(path("bad.cube"), "LUT_3D_SIZE 2\n0 0 0\n");
  const auto run = [&](std::vector<std::string> arguments) { return run_program(arguments); };
  const ProgramResult bad = run({"lut", "apply", path("bad.cube"), path("picture.png"), "-o", path("x.png")});
  EXPECT_EQ(bad.status, 1);
  EXPECT_NE(bad.err.find("cut off"), std::string::npos) << bad.err;
  EXPECT_EQ(run({"lut", "frame", path("none.json"), "--image", path("picture.png")}).status, 2);
  EXPECT_EQ(run({"lut", "apply", path("dim.cube"), path("picture.png"), "-o", path("picture.png")}).status,
            2);
  EXPECT_EQ(run({"lut", "convert", "identity", "--size", "300", "-o", path("x.cube")}).status, 2);
  EXPECT_FALSE(fs::exists(path("x.png")));
  EXPECT_FALSE(fs::exists(path("x.cube")));
}

TEST_F(LutCommand, TheSweepGivesErrorAgainstTimeOfTablesForAPicture) {
  const std::vector<std::string> sweep{"sweep", "lut", path("picture.png"), "--runs",
                                       "1",     "-o",  path("sweep")};
  EXPECT_GT(value_of(sweep, "mean_delta_e", "interpolation", "tetrahedral"), 0);
  EXPECT_TRUE(fs::exists(path("sweep/sweep-picture.svg")));
  EXPECT_EQ(run_program({"sweep", "lut", path("absent.png")}).status, 1);
}

TEST_F(LutCommand, FramesOfTheWalkAreWhatTheCommandForOneFrameMakesOfThem) {
  const std::vector<std::string> walk{"lut", "walk",      "--width", "64", "--height",
                                      "36",  "--density", "0.1",     "-o", path("walk")};
  const double weight = value_of(walk, "blend_weight", "method", "pixel");
  EXPECT_NEAR(value_of({"lut", "frame", path("walk/volumes.json"), "--depth", path("walk/frame-00.exr"),
                        "--camera", "0,2,1.65", "--fov", "75", "--image", path("walk/frame-00.png"),
                        "--graded", path("graded.png")},
                       "blend_weight", "volume", "corridor"),
              weight, 1e-9);
  EXPECT_EQ(read_display_image(path("graded.png")).width(), 64);
  const DisplayImage a = read_display_image(path("graded.png")),
                     b = read_display_image(path("walk/frame-00-pixel.png"));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.pixels()[i].g, b.pixels()[i].g, 0.02);
}

}  // namespace
}  // namespace plenolab
