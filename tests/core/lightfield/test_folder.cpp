#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/lightfield/bare_folder.h"
#include "core/lightfield/description.h"
#include "core/lightfield/light_field_folder.h"
#include "tests/core/lightfield/synthetic.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

const std::string kGood =
    R"({"format": "plenolab-lightfield", "version": 1, "grid": {"columns": 3, "rows": 2},
  "spacing": {"x": 0.12, "y": 0.1}, "image": {"width": 32, "height": 18, "fov_h_deg": 50.0}, "radiance": "relative",
  "views": "view_{row:02}_{column:02}.exr",
  "channels": {"r": "ViewLayer.Combined.R", "g": "ViewLayer.Combined.G", "b": "ViewLayer.Combined.B", "depth": "ViewLayer.Depth.Z"}})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Description, ReadsWhatItSaysAndComesBackFromText) {
  const LightFieldDescription d = parse_description(kGood, "a.json");
  EXPECT_EQ(d.grid.columns, 3);
  EXPECT_EQ(d.grid.spacing_y_m, 0.1);
  EXPECT_EQ(d.geometry, "ViewLayer.Depth.Z");
  EXPECT_EQ(d.geometry_kind, GeometryChannel::kDepth_m);
  const LightFieldDescription back = parse_description(format_description(d), "b.json");
  EXPECT_EQ(back.grid, d.grid);
  EXPECT_EQ(back.view_pattern, d.view_pattern);
  EXPECT_EQ(back.geometry_kind, d.geometry_kind);
  EXPECT_EQ(back.r, d.r);
}

TEST(Description, EveryMistakeNamesTheFileAndTheKey) {
  const std::tuple<std::string, std::string, std::string> cases[] = {
      {"\"version\": 1", "\"version\": 2", "version"},
      {"\"version\": 1,", "", "version"},
      {"\"columns\": 3", "\"columns\": \"3\"", "grid.columns"},
      {"\"columns\": 3", "\"columns\": 2.5", "grid.columns"},
      {"\"columns\": 3", "\"columns\": 0", "grid.columns"},
      {"\"columns\": 3", "\"columns\": 99999999999999999999", "grid.columns"},
      {"\"rows\": 2", "\"rows\": 9999", "grid.rows"},
      {"\"x\": 0.12", "\"x\": -0.12", "spacing.x"},
      {"\"x\": 0.12", "\"x\": null", "spacing.x"},
      {"\"width\": 32", "\"width\": 1000000", "image.width"},
      {"50.0", "180", "image.fov_h_deg"},
      {"\"relative\"", "\"lux\"", "radiance"},
      {"{row:02}", "{y:02}", "views"},
      {"{row:02}_", "", "views"},
      {"view_{row", "../view_{row", "views"},
      {"view_{row", "/etc/view_{row", "views"},
      {"view_{row", "a/../../view_{row", "views"},
      {"\"depth\":", "\"depht\":", "channels.depht"},
      {", \"depth\": \"ViewLayer.Depth.Z\"", "", "channels.disparity"},
      {"\"ViewLayer.Depth.Z\"", "\"Z\", \"disparity\": \"d\"", "channels.disparity"},
      {"\"ViewLayer.Combined.R\"", "\"\"", "channels.r"},
      {"\"image\": {", "\"image\": [], \"comment\": {", "image"},
      {"plenolab-lightfield", "other", "format"},
      {"\"radiance\"", "\"radianz\"", "radianz"}};
  for (const auto& [from, to, key] : cases) {
    const std::string text = with(from, to);
    const std::string message = message_of([&] { parse_description(text, "lf.json"); });
    EXPECT_NE(message.find("lf.json: \"" + key + "\""), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  for (const std::string& text :
       {std::string(), std::string("[1]"), std::string("{"), std::string(100000, '['), std::string("nul")})
    EXPECT_THROW(parse_description(text, "lf.json"), InputError);
}

TEST(ViewPattern, WidthsPadWithZerosOrBlanks) {
  EXPECT_EQ(expand_view_pattern("v{column}_{row:03}.exr", 12, 7, "n"), "v12_007.exr");
  EXPECT_EQ(expand_view_pattern("{row:2d}/{column:1}.exr", 1, 2, "n"), " 2/1.exr");
  for (const char* wrong : {"{row}", "{row}{column", "{row}{column}}", "{row:x}{column}", "{row:-2}{column}",
                            "{row:999}{column}", "{}{row}{column}"})
    EXPECT_THROW(expand_view_pattern(wrong, 0, 0, "n"), InputError) << wrong;
}

TEST(LightFieldFolder, ALightFieldComesBackFromDisk) {
  const TemporaryFolder folder;
  const LightField original = TwoPlanes{}.light_field();
  WriteLightFieldOptions options;
  options.colour_type = ExrPixelType::kFloat;
  options.compression = ExrCompression::kPiz;
  const fs::path path = folder.path() / "sub" / "lf";
  write_light_field(path, original, options);
  EXPECT_TRUE(is_light_field_folder(path));
  EXPECT_EQ(light_field_kind(path), RadianceKind::kSceneReferred);
  const LightField back = open_light_field(path);
  EXPECT_EQ(back.grid(), original.grid());
  EXPECT_EQ(back.unit(), RadianceUnit::kCdM2);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      EXPECT_EQ(back.view(column, row)->colour, original.view(column, row)->colour);
      EXPECT_EQ(back.view(column, row)->disparity, original.view(column, row)->disparity);
    }
}

TEST(LightFieldFolder, DisplayAndSceneLightFieldsAreNotConfused) {
  const TemporaryFolder folder;
  TwoPlanes scene;
  scene.radiance = 1;
  write_light_field(folder.path() / "d", scene.light_field<DisplayReferred>());
  write_light_field(folder.path() / "s", scene.light_field());
  EXPECT_EQ(light_field_kind(folder.path() / "d"), RadianceKind::kDisplayReferred);
  EXPECT_EQ(open_display_light_field(folder.path() / "d").grid(), scene.grid);
  EXPECT_THROW(open_light_field(folder.path() / "d"), InputError);
  EXPECT_THROW(open_display_light_field(folder.path() / "s"), InputError);
  EXPECT_THROW(open_light_field(folder.path()), InputError);
}

TEST(LightFieldFolder, AFolderAppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  TwoPlanes scene;
  scene.radiance = 1e6f;  // beyond half
  EXPECT_THROW(write_light_field(folder.path() / "lf", scene.light_field()), InputError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  scene.radiance = 1;
  fs::create_directory(folder.path() / "lf");
  write_light_field(folder.path() / "lf/", scene.light_field());
  EXPECT_THROW(write_light_field(folder.path() / "lf", scene.light_field()), InputError);
  EXPECT_EQ(open_light_field(folder.path() / "lf").grid(), scene.grid);
}

TEST(LightFieldFolder, MissingDamagedAndUnfittingViewsAreNamedWhenOpened) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "lf", view = path / "view_01_02.exr";
  write_light_field(path, TwoPlanes{}.light_field());
  fs::remove(view);
  EXPECT_NE(message_of([&] { open_light_field(path); }).find("view_01_02.exr does not exist"),
            std::string::npos);
  std::ofstream(view) << "no image";
  EXPECT_NE(message_of([&] { open_light_field(path); }).find("view_01_02.exr is not an OpenEXR file"),
            std::string::npos);
  const Plane<float> small(5, 5);
  write_exr(view, SceneImage(5, 5), {{"disparity", &small}});
  EXPECT_NE(message_of([&] { open_light_field(path); }).find("view_01_02.exr has 5 × 5 pixels"),
            std::string::npos);
  write_exr(view, SceneImage(96, 72));
  EXPECT_NE(message_of([&] { open_light_field(path); }).find("no channel \"disparity\""), std::string::npos);
}

TEST(LightFieldFolder, DisparityOfTheWrongSignIsNamedWithItsViewAndValue) {
  const TemporaryFolder folder;
  write_light_field(folder.path() / "lf", TwoPlanes{}.light_field());
  Plane<float> disparity(96, 72, 1);
  for (const float wrong : {-3.5f, std::nanf(""), INFINITY}) {
    disparity.at(4, 6) = wrong;
    write_exr(folder.path() / "lf" / "view_00_01.exr", SceneImage(96, 72), {{"disparity", &disparity}});
    const LightField lf = open_light_field(folder.path() / "lf");
    const std::string message = message_of([&] { lf.view(1, 0); });
    EXPECT_NE(message.find("view_00_01.exr"), std::string::npos) << message;
    EXPECT_NE(message.find(fmt::format("{} at pixel (4, 6)", wrong)), std::string::npos) << message;
  }
}

// A folder as a renderer leaves it: its own channel names, planar depth, 1e10 for the background.
void write_depth_folder(const fs::path& folder, const ViewGrid& grid, const Plane<float>& depth,
                        const std::string& pattern) {
  const Plane<float> colour(grid.width, grid.height, 2.0f);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      write_exr(folder / fmt::format(fmt::runtime(pattern), fmt::arg("row", row), fmt::arg("column", column),
                                     fmt::arg("index", row * grid.columns + column)),
                SceneImage(grid.width, grid.height),
                {{"ViewLayer.Combined.R", &colour},
                 {"ViewLayer.Combined.G", &colour},
                 {"ViewLayer.Combined.B", &colour},
                 {"ViewLayer.Depth.Z", &depth}});
}

TEST(LightFieldFolder, PlanarDepthBecomesDisparityAndTheBackgroundZero) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / kDescriptionFile, kGood);
  const ViewGrid grid = parse_description(kGood, "x").grid;
  Plane<float> depth(32, 18, 2.5f);
  depth.at(0, 0) = 1e10f;
  depth.at(1, 0) = INFINITY;
  write_depth_folder(folder.path(), grid, depth, "view_{row:02}_{column:02}.exr");
  const auto view = open_light_field(folder.path()).view(2, 1);
  EXPECT_EQ(view->colour.at(3, 3), (Rgb{2, 2, 2}));
  EXPECT_EQ(view->disparity.at(0, 0), 0);
  EXPECT_EQ(view->disparity.at(1, 0), 0);
  EXPECT_FLOAT_EQ(view->disparity.at(5, 5), static_cast<float>(grid.disparity_px(2.5)));
  for (const float wrong : {-1.0f, 0.0f, std::nanf("")}) {
    depth.at(7, 2) = wrong;
    write_depth_folder(folder.path(), grid, depth, "view_{row:02}_{column:02}.exr");
    const std::string message = message_of([&] { open_light_field(folder.path()).view(0, 0); });
    EXPECT_NE(message.find("(7, 2)"), std::string::npos) << message;
  }
}

TEST(BareFolder, RowsAndColumnsAreFoundInTheNames) {
  const ViewGrid grid{.columns = 3,
                      .rows = 2,
                      .spacing_x_m = 0.2,
                      .spacing_y_m = 0.1,
                      .width = 8,
                      .height = 6,
                      .fov_h_deg = 40};
  const Plane<float> depth(8, 6, 4);
  BareFolderOptions options;
  options.spacing_x_m = 0.2;
  options.fov_h_deg = 40;
  options.r = "ViewLayer.Combined.R";
  options.g = "ViewLayer.Combined.G";
  options.b = "ViewLayer.Combined.B";
  for (const char* pattern : {"s7_r{row}_c{column:03}.exr", "{row:02}-{column}.EXR"}) {
    const TemporaryFolder folder;
    write_depth_folder(folder.path(), grid, depth, pattern);
    write_text_file(folder.path() / "._r0_c0.exr", "what a file manager leaves beside a view");
    const LightField lf = import_bare_folder(folder.path(), options);
    EXPECT_EQ(lf.grid(), grid);
    EXPECT_FLOAT_EQ(lf.view(2, 1)->disparity.at(0, 0), static_cast<float>(grid.disparity_px(4)));
    EXPECT_EQ(lf.view(2, 1)->colour.at(0, 0).r, 2);
  }
  const TemporaryFolder folder;
  write_depth_folder(folder.path(), grid, depth, "frame{index:04}.exr");
  EXPECT_THROW(import_bare_folder(folder.path(), options), InputError);
  options.columns = 3;
  EXPECT_EQ(import_bare_folder(folder.path(), options).grid(), grid);
  fs::remove(folder.path() / "frame0002.exr");
  EXPECT_THROW(import_bare_folder(folder.path(), options), InputError);
}

TEST(BareFolder, AmbiguityIsAnErrorThatSaysWhatDecidesIt) {
  const TemporaryFolder folder;
  const Plane<float> depth(4, 4, 1);
  write_exr(folder.path() / "a_0_0.exr", SceneImage(4, 4), {{"Z", &depth}, {"left.Z", &depth}});
  EXPECT_NE(message_of([&] { import_bare_folder(folder.path(), {}); }).find("several channels"),
            std::string::npos);
  BareFolderOptions options;
  options.depth = "Z";
  EXPECT_EQ(import_bare_folder(folder.path(), options).grid().columns, 1);
  write_exr(folder.path() / "other.exr", SceneImage(4, 4), {{"Z", &depth}});
  EXPECT_NE(message_of([&] { import_bare_folder(folder.path(), options); }).find("named differently"),
            std::string::npos);
  options.pattern = "a_{row}_{column}.exr";
  EXPECT_EQ(import_bare_folder(folder.path(), options).grid().rows, 1);
}

}  // namespace
}  // namespace plenolab
