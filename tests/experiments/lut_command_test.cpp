// `plenolab lut` as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

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

TEST_F(LutCommand, TheIdentityOfABlendTakesTheDomainOfTheOthers) {
  write_lut(path("wide.cube"), bake_lut(3, [](Rgb c) { return c * 0.5f; }, {0, 0, 0}, {2, 2, 2}));
  EXPECT_NEAR(value_of({"lut", "blend", path("wide.cube") + "=0.5", "-o", path("blend.cube")}, "lut_maximum"),
              1.5, 1e-6);
  EXPECT_EQ(read_lut(path("blend.cube")).domain_max, (Rgb{2, 2, 2}));
  // Tables of different domains are brought to one by convert.
  const std::vector<std::string> both{
      "lut", "blend", path("wide.cube") + "=0.5", path("dim.cube") + "=0.5", "-o", path("b.cube")};
  expect_one_clear_sentence(run_program(both), "of the domains 0 to 2 and 0 to 1 cannot be blended");
  ASSERT_EQ(run_program({"lut", "convert", path("dim.cube"), "--domain", "0,2", "--size", "3", "-o",
                         path("dim.cube.wide.cube")})
                .status,
            0);
  EXPECT_EQ(read_lut(path("dim.cube.wide.cube")).node(1, 2, 0), (Rgb{0.5f, 0.5f, 0}))
      << "0.5 at input 1, and at the end of its domain beyond";
  for (const char* domain : {"0", "1,0", "0,1,2", "0,nan", "0,x"})
    expect_one_clear_sentence(
        run_program({"lut", "convert", path("dim.cube"), "--domain", domain, "-o", path("b.cube")}),
        "--domain needs LOW,HIGH", 2);
}

TEST_F(LutCommand, TablesOfCurvesBecomeLatticesAndTheirErrorIsTold) {
  std::string text = "LUT_1D_SIZE 1024\n";
  for (int i = 0; i < 1024; ++i) {
    const double x = i / 1023.0;
    text += fmt::format("{} {} {}\n", x * x, x, 1 - x);
  }
  write_text_file(path("curves.cube"), text);
  const std::vector<std::string> convert{"lut", "convert", path("curves.cube"), "-o", path("c.cube")};
  EXPECT_EQ(value_of(convert, "lut_curve_nodes"), 1024);
  const double error = value_of(convert, "lut_largest_curve_error");
  EXPECT_GT(error, 1e-6);
  EXPECT_LT(error, 1e-4) << "a quarter of the squared spacing of 65 nodes";
  EXPECT_EQ(read_lut(path("c.cube")).size, 65);
  std::vector<std::string> finer = convert;
  finer.insert(finer.end(), {"--size", "129"});
  EXPECT_LT(value_of(finer, "lut_largest_curve_error"), 0.5 * error);
  EXPECT_EQ(read_lut(path("c.cube")).size, 129);
  // A picture takes the curves themselves: a step that a lattice of 65 nodes has no place for.
  std::string step = "LUT_1D_SIZE 256\n";
  for (int i = 0; i < 256; ++i) step += fmt::format("{0} {0} {0}\n", i < 100 ? 0.25 : 1.5);
  write_text_file(path("step.cube"), step);
  DisplayImage codes(256, 1);
  for (int i = 0; i < 256; ++i) codes.at(i, 0) = Rgb{1, 1, 1} * (static_cast<float>(i) / 255);
  write_display_image(path("codes.png"), codes);
  EXPECT_EQ(
      value_of({"lut", "apply", path("step.cube"), path("codes.png"), "-o", path("s.png")}, "values_cut"),
      3 * 156);
  const DisplayImage stepped = read_display_image(path("s.png"));
  EXPECT_NEAR(stepped.at(99, 0).g, 0.25, 0.003);
  EXPECT_EQ(stepped.at(100, 0).g, 1);
}

TEST_F(LutCommand, ClampingMakesATableFitAStripAndCounts) {
  write_lut(path("hot.cube"), bake_lut(2, [](Rgb c) { return Rgb{2 * c.r, c.g, c.b}; }));
  const ProgramResult refused = run_program({"lut", "convert", path("hot.cube"), "-o", path("hot.png")});
  expect_one_clear_sentence(refused, "--clamp");
  EXPECT_EQ(value_of({"lut", "convert", path("hot.cube"), "--clamp", "-o", path("hot.png")}, "values_cut"),
            4);
  expect_one_clear_sentence(
      run_program({"lut", "convert", "identity", "--title", "x", "-o", path("titled.png")}), "--title", 2);
}

TEST_F(LutCommand, KeepsTheBitsOfThePictureAndSaysThatTransparencyIsLost) {
  write_display_image(path("deep.png"), read_display_image(path("picture.png")), PngDepth::k16Bit);
  const auto bits = [&](const std::string& name) {
    return static_cast<int>(read_text_file(path(name)).at(24));
  };
  ASSERT_EQ(run_program({"lut", "apply", "identity", path("deep.png"), "-o", path("d.png")}).status, 0);
  EXPECT_EQ(bits("d.png"), 16);
  ASSERT_EQ(run_program({"lut", "apply", "identity", path("picture.png"), "-o", path("p.png")}).status, 0);
  EXPECT_EQ(bits("p.png"), 8);
  // Colour type 6 is red, green, blue, alpha.
  cv::imwrite(path("glass.png"), cv::Mat(4, 4, CV_8UC4, cv::Scalar(10, 20, 30, 128)));
  const ProgramResult glass =
      run_program({"lut", "apply", "identity", path("glass.png"), "-o", path("g.png")});
  EXPECT_NE(glass.out.find("transparency"), std::string::npos) << glass.out;
}

TEST_F(LutCommand, TransferBringsColoursNearer) {
  ASSERT_EQ(
      run_program({"lut", "apply", path("dim.cube"), path("picture.png"), "-o", path("dim.png")}).status, 0);
  const std::vector<std::string> transfer{
      "lut", "transfer", path("picture.png"), path("dim.png"), "-o", path("t.cube"), "--size", "17"};
  EXPECT_LT(value_of(transfer, "colour_distance_after"), 0.2 * value_of(transfer, "colour_distance_before"));
}

TEST_F(LutCommand, TransferSaysWhatItsTableLoses) {
  // A target that two nodes an axis are far too few for.
  write_lut(path("bent.cube"), bake_lut(33, [](Rgb c) {
              return Rgb{c.r * c.r, c.g * c.g * c.g, 1 - c.r * c.g};
            }));
  ASSERT_EQ(
      run_program({"lut", "apply", path("bent.cube"), path("picture.png"), "-o", path("bent.png")}).status,
      0);
  const auto transfer = [&](const std::string& size) {
    return std::vector<std::string>{
        "lut", "transfer", path("picture.png"), path("bent.png"), "-o", path("t.cube"), "--size", size};
  };
  EXPECT_LT(value_of(transfer("2"), "colour_distance_unbaked"),
            value_of(transfer("2"), "colour_distance_after"));
  EXPECT_NE(run_program(transfer("2")).out.find("give more nodes (--size)"), std::string::npos);
  EXPECT_EQ(run_program(transfer("33")).out.find("note"), std::string::npos);
}

/// A volume before the camera, and a depth map three quarters of which lie in it.
class LutFrame : public LutCommand {
 protected:
  LutFrame() {
    write_text_file(path("volumes.json"), R"({"format": "plenolab-volumes", "version": 1, "volumes": [
      {"name": "far", "min": [-9, 4, -9], "max": [9, 6, 9], "blend_radius_m": 8, "lut": "dim.cube"}]})");
    Plane<float> depth(16, 8, 5);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 4; ++x) depth.at(x, y) = 1;
    write_exr(path("depth.exr"), SceneImage(16, 8), {{"depth", &depth}});
  }
  ProgramResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = frame;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  void expect_wrong_use(const std::vector<std::string>& more, const std::string& mentions) const {
    expect_one_clear_sentence(run(more), mentions, 2);
  }
  const std::vector<std::string> frame{"lut", "frame", path("volumes.json"), "--depth", path("depth.exr")};
};

TEST_F(LutFrame, NeverWritesOneResultOverTheOtherNorOneOfTwo) {
  const std::string picture = path("picture.png"), graded = path("graded.png");
  expect_wrong_use({"--image", picture, "--graded", graded, "-o", graded}, "--graded and -o are both");
  expect_wrong_use({"--image", picture, "--graded", picture}, "would replace the input");
  // The blend leaves 0 to 1: no strip holds it, and nothing may be left of the attempt.
  write_lut(path("dim.cube"), bake_lut(2, [](Rgb c) { return c * 3.0f; }));
  expect_one_clear_sentence(run({"--image", picture, "--graded", graded, "-o", path("frame.png")}),
                            "an image strip holds only outputs of 0 to 1");
  EXPECT_FALSE(fs::exists(graded));
  EXPECT_FALSE(fs::exists(path("frame.png")));
}

TEST_F(LutFrame, GradesLikeLutApplyAndLeavesItsRunBesideBothFiles) {
  write_display_image(path("deep.png"), read_display_image(path("picture.png")), PngDepth::k16Bit);
  ASSERT_EQ(run({"--image", path("deep.png"), "--graded", path("graded.png"), "-o", path("frame.cube"),
                 "--interpolation", "trilinear"})
                .status,
            0);
  EXPECT_TRUE(fs::exists(path("graded.png.run.json")));
  EXPECT_TRUE(fs::exists(path("frame.cube.run.json")));
  EXPECT_EQ(static_cast<int>(read_text_file(path("graded.png")).at(24)), 16) << "the bits of the picture";
  ASSERT_EQ(run_program({"lut", "apply", path("frame.cube"), path("deep.png"), "-o", path("applied.png"),
                         "--interpolation", "trilinear"})
                .status,
            0);
  EXPECT_EQ(read_display_image(path("graded.png")), read_display_image(path("applied.png")));
  std::vector<std::string> with_rows = frame;
  with_rows.insert(with_rows.end(), {"--image", path("deep.png"), "--graded", path("graded.png")});
  EXPECT_EQ(value_of(with_rows, "values_cut"), 0);
}

TEST_F(LutFrame, RefusesAPictureOfAnotherSize) {
  write_display_image(path("small.png"), DisplayImage(8, 8));
  expect_one_clear_sentence(run({"--image", path("small.png"), "--graded", path("graded.png")}),
                            "they are not of one frame");
}

TEST_F(LutFrame, SaysWhatIsWrongWithACamera) {
  for (const char* option : {"--camera", "--forward", "--up"}) {
    for (const char* value : {"1,2", "1,2,3,4", "1,2,x", "nan,0,0", "1", "inf,0,0"})
      expect_wrong_use({option, value}, fmt::format("{} needs three numbers X,Y,Z, not '{}'", option, value));
  }
  expect_wrong_use({"--forward", "0,0,0"}, "--forward 0,0,0 is no direction");
  expect_wrong_use({"--forward", "0,0,-2"}, "--up 0,0,1 is parallel to --forward 0,0,-2: give another --up");
  const std::vector<std::string> linear{"lut", "frame", path("volumes.json"), "--method", "linear"};
  const auto run_linear = [&](const char* option, const std::string& value) {
    std::vector<std::string> arguments = linear;
    arguments.insert(arguments.end(), {option, value});
    return run_program(arguments);
  };
  expect_one_clear_sentence(run_linear("--camera", "nan,0,0"), "--camera needs three numbers", 2);
  for (const auto& [option, value] :
       {std::pair("--depth", path("depth.exr")), std::pair("--up", std::string("0,1,0")),
        std::pair("--stride", std::string("2")), std::pair("--fov", std::string("60"))})
    expect_one_clear_sentence(run_linear(option, value), std::string(option) + ": --method linear", 2);
  expect_wrong_use({"--bits", "8"}, "--bits: there is no --image to grade");
}

TEST_F(LutFrame, ACameraThatLooksUpOrDownNeedsNoUpOfItsOwn) {
  for (const char* forward : {"0,1,0.5", "0,1,-3"})
    EXPECT_EQ(run({"--forward", forward}).status, 0) << forward;
  // Tilted by a quarter turn about the axis to the right: up is what was backwards.
  EXPECT_EQ(run({"--forward", "0,0,1", "--up", "0,-1,0.7"}).status, 0);
}

TEST_F(LutFrame, IsBlendedByWhatTheCameraSeesOrWhereItStands) {
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
  EXPECT_NE(read_text_file(path("sweep/run.json")).find("picture.png"), std::string::npos) << "its input";
  EXPECT_EQ(run_program({"sweep", "lut", path("absent.png")}).status, 1);
}

TEST_F(LutCommand, TheSweepOfAPictureWithoutErrorHasRowsAndNoPlot) {
  write_display_image(path("plain.PNG"), DisplayImage(1, 1, {0, 0, 0}));
  const ProgramResult result =
      run_program({"sweep", "lut", path("plain.PNG"), "--runs", "1", "-o", path("plain")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(path("plain/rows.csv")));
}

TEST_F(LutCommand, TheSweepOfRadianceSaysHowItIsShown) {
  write_exr(path("photo.exr"), SceneImage(4, 4, {2, 2, 2}), {});
  const ProgramResult result =
      run_program({"sweep", "lut", path("photo.exr"), "--runs", "1", "-o", path("photo")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("radiance times 0.5"), std::string::npos) << result.out;
  const nlohmann::json run = nlohmann::json::parse(read_text_file(path("photo/run.json")));
  EXPECT_DOUBLE_EQ(run.at("parameters").at("exposure").get<double>(), 0.5);
  EXPECT_EQ(run.at("inputs").size(), 1u);
}

TEST_F(LutCommand, FramesOfTheWalkAreWhatTheCommandForOneFrameMakesOfThem) {
  const std::vector<std::string> walk{"lut", "walk",      "--width", "64", "--height",
                                      "36",  "--density", "0.1",     "-o", path("walk")};
  const double weight = value_of(walk, "blend_weight", "method", "pixel");
  EXPECT_NEAR(value_of({"lut", "frame", path("walk/volumes.json"), "--depth", path("walk/frame-000.exr"),
                        "--camera", "0,2,1.65", "--fov", "75", "--image", path("walk/frame-000.png"),
                        "--graded", path("graded.png")},
                       "blend_weight", "volume", "corridor"),
              weight, 1e-9);
  EXPECT_EQ(read_display_image(path("graded.png")).width(), 64);
  // rows.csv holds what `lut frame` has to be told of every frame.
  const std::string rows = read_text_file(path("walk/rows.csv"));
  for (const char* quantity : {"camera_x", "camera_z", "forward_x", "forward_z", "up_z", "fov_h"})
    EXPECT_NE(rows.find(quantity), std::string::npos) << quantity;
  expect_one_clear_sentence(
      run_program({"lut", "walk", "--width", "8192", "--height", "8192", "-o", path("w")}), "at most", 2);
  const DisplayImage a = read_display_image(path("graded.png")),
                     b = read_display_image(path("walk/frame-000-pixel.png"));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.pixels()[i].g, b.pixels()[i].g, 0.02);
}

}  // namespace
}  // namespace plenolab
