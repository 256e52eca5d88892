#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/lightfield/light_field_folder.h"
#include "core/tonemap/operator.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

/// The rows of a run that must succeed.
nlohmann::json rows_of(Arguments arguments) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? nlohmann::json::parse(result.out).at("rows") : nlohmann::json::array();
}

/// Values of a quantity, in order.
std::vector<double> values_of(const nlohmann::json& rows, const std::string& quantity) {
  std::vector<double> values;
  for (const auto& row : rows)
    if (row.at("quantity") == quantity) values.push_back(row.at("value").get<double>());
  return values;
}

double value_of(const nlohmann::json& rows, const std::string& quantity) {
  const std::vector<double> values = values_of(rows, quantity);
  EXPECT_EQ(values.size(), 1u) << quantity;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : values.front();
}

fs::path written_view(const fs::path& file) {
  const auto view = plane_field(3).view(1, 1);
  write_exr(file, view->colour, {{"disparity", &view->disparity}}, {.colour_type = ExrPixelType::kFloat});
  return file;
}

void expect_display_values(const DisplayImage& image) {
  for (const Rgb& c : image.pixels())
    for (const float v : {c.r, c.g, c.b}) ASSERT_TRUE(v >= 0 && v <= 1) << v;
}

/// Both light fields hold the same bits.
void expect_equal_fields(const fs::path& a, const fs::path& b) {
  const DisplayLightField first = open_display_light_field(a), second = open_display_light_field(b);
  for (int row = 0; row < first.grid().rows; ++row)
    for (int column = 0; column < first.grid().columns; ++column) {
      EXPECT_EQ(first.view(column, row)->colour, second.view(column, row)->colour) << column << "," << row;
      EXPECT_EQ(first.view(column, row)->disparity, second.view(column, row)->disparity);
    }
}

TEST(TonemapCommand, EveryOperatorAndVariantForViewsWritesDisplayValuesAndWhatItFitted) {
  const TemporaryFolder folder;
  const fs::path view = written_view(folder.path() / "view.exr"), out = folder.path() / "mapped.exr";
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const OperatorVariant& variant : info.variants) {
      if (variant.scope == OperatorScope::kFrame) continue;
      SCOPED_TRACE(info.id + " " + variant.id);
      const auto rows = rows_of({"tonemap", view, "-o", out, "--operator", info.id, "--variant", variant.id});
      double sum = 0;
      const SceneImage mapped = read_exr_image(out);
      for (const Rgb& c : mapped.pixels()) sum += 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
      EXPECT_NEAR(value_of(rows, "mean_luma"), sum / (48 * 32), 1e-5);
      EXPECT_EQ(value_of(rows, "repaired_nan"), 0);
      EXPECT_TRUE(fs::exists(out.string() + ".run.json"));
    }
}

TEST(TonemapCommand, CountsWhatItRepairs) {
  const TemporaryFolder folder;
  const fs::path view = folder.path() / "defects.exr", out = folder.path() / "out.png";
  SceneImage image(8, 4, Rgb{1, 2, 3});
  image.at(0, 0).r = std::numeric_limits<float>::quiet_NaN();
  image.at(1, 0).g = std::numeric_limits<float>::infinity();
  image.at(2, 0).b = -1;
  image.at(3, 0) = Rgb{0, 0, 0};
  write_exr(view, image, {}, {.colour_type = ExrPixelType::kFloat});
  const auto rows = rows_of({"tonemap", view, "-o", out, "--operator", "robust"});
  EXPECT_EQ(value_of(rows, "repaired_nan"), 1);
  EXPECT_EQ(value_of(rows, "repaired_infinite"), 1);
  EXPECT_EQ(value_of(rows, "repaired_negative"), 1);
  EXPECT_EQ(read_display_image(out).width(), 8);
}

TEST(TonemapCommand, NotesWhichBranchAnOperatorTook) {
  const TemporaryFolder folder;
  const fs::path view = written_view(folder.path() / "view.exr");
  // Its range fits the display, so nothing is to be adjusted.
  const ProgramResult result =
      run_program({"tonemap", view, "-o", folder.path() / "out.png", "--operator", "histogram"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("note: linear mapping"), std::string::npos) << result.out;
}

TEST(TonemapCommand, TakesTheUnitFromTheFileTheLightFieldAroundItOrTheImage) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out.png";
  const auto unit_of = [&](const fs::path& image) {
    return value_of(rows_of({"tonemap", image, "-o", out, "--operator", "histogram"}), "cd_m2_per_unit");
  };
  const fs::path declared = folder.path() / "declared.exr", relative = folder.path() / "relative.exr";
  const SceneImage grey(8, 4, Rgb{2, 2, 2});
  write_exr(declared, grey, {}, {.float_attributes = {{kWhiteLuminance, 25.0f}}});
  write_exr(relative, grey);
  EXPECT_EQ(unit_of(declared), 25);
  EXPECT_NEAR(unit_of(relative), 50, 1e-3);  // so that the log average is 100 cd/m²
  const LightField plane = plane_field(3);
  std::vector<KeyView<SceneReferred>> views;
  for (int i = 0; i < 9; ++i) views.push_back(*plane.view(i % 3, i / 3));
  const fs::path field = folder.path() / "field";
  write_light_field(field,
                    LightField::from_views(plane.grid(), RadianceUnit::kCdM2, "plane", std::move(views)));
  EXPECT_EQ(unit_of(field / "view_01_01.exr"), 1);
  rows_of({"synth", field, "--at", "0.5,0", "-o", folder.path() / "novel.exr"});
  EXPECT_EQ(unit_of(folder.path() / "novel.exr"), 1);
  // Of a light field written by others, the description says it.
  write_exr(field / "view_01_01.exr", grey);
  EXPECT_EQ(unit_of(field / "view_01_01.exr"), 1);
}

TEST(TonemapCommand, ListsEveryOperatorVariantAndSettingForPeopleAndPrograms) {
  const auto rows = rows_of({"tonemap", "--list"});
  const std::string text = run_program({"tonemap", "--list"}).out;
  const auto listed = [&](const std::string& id, const char* column, const std::string& name) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) {
      return row.at("operator") == id && row.contains(column) && row.at(column) == name;
    });
  };
  for (const OperatorInfo& info : tone_mapping_operators()) {
    for (const OperatorVariant& variant : info.variants) {
      EXPECT_TRUE(listed(info.id, "variant", variant.id)) << info.id << " " << variant.id;
      EXPECT_NE(text.find("--variant " + variant.id), std::string::npos) << variant.id;
    }
    for (const Setting& setting : info.settings) {
      EXPECT_TRUE(listed(info.id, "setting", setting.name)) << info.id << " " << setting.name;
      EXPECT_NE(text.find("--set " + setting.name + "="), std::string::npos) << setting.name;
    }
  }
}

TEST(TonemapCommand, WritesTheLayersOfTheEnhancedBilateralOperator) {
  const TemporaryFolder folder;
  const fs::path view = folder.path() / "view.exr", layers = folder.path() / "layers";
  SceneImage image(64, 32, Rgb{1, 1, 1});
  DisparityMap disparity(64, 32, 1.0f);
  for (int y = 0; y < 32; ++y)
    for (int x = 32; x < 64; ++x) {
      image.at(x, y) = Rgb{1.5f, 1.5f, 1.5f};
      disparity.at(x, y) = 5;
    }
  write_exr(view, image, {{"disparity", &disparity}}, {.colour_type = ExrPixelType::kFloat});
  const ProgramResult result =
      run_program({"tonemap", view, "-o", folder.path() / "out.png", "--operator", "bilateral", "--variant",
                   "enhanced", "--set", "sigma_s=0.1", "--layers", layers});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* name : {"base.png", "detail.png", "foreground.png", "temporary.png"})
    EXPECT_EQ(read_display_image(layers / name).width(), 64) << name;
  const auto planes = read_exr_channels(layers / "layers.exr",
                                        {"log_luminance", "base", "detail", "foreground", "temporary"});
  for (std::size_t i = 0; i < planes[0].size(); ++i) {
    EXPECT_NEAR(planes[0].pixels()[i], planes[1].pixels()[i] + planes[2].pixels()[i], 1e-5);
    EXPECT_NEAR(planes[1].pixels()[i], planes[3].pixels()[i] + planes[4].pixels()[i], 1e-5);
  }
}

TEST(TonemapCommand, WrongUseNamesTheOptionAndWhatThereIs) {
  const auto expect_wrong = [](const Arguments& arguments, const std::string& mentions) {
    expect_one_clear_sentence(run_program(arguments), mentions, 2);
  };
  const auto mapping = [](const Arguments& more) {
    Arguments arguments{"tonemap", "a.exr", "-o", "b.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_wrong({"tonemap"}, "--list");
  expect_wrong({"tonemap", "a.exr"}, "--out");
  expect_wrong(mapping({}), "--operator is required");
  expect_wrong(mapping({"--operator", "reinhard5"}), "did you mean 'reinhard05'?");
  expect_wrong(mapping({"--operator", "reinhard05", "--variant", "joynt"}), "did you mean 'joint'?");
  expect_wrong(mapping({"--operator", "reinhard05", "--set", "q=1"}), "no setting q");
  expect_wrong(mapping({"--operator", "reinhard05", "--set", "b=9"}), "[-8, 8]");
  expect_wrong(mapping({"--operator", "reinhard05", "--variant", "interpolate-statistics"}),
               "plenolab video");
  expect_wrong(mapping({"--operator", "reinhard05", "--variant", "adjusted"}), "tonemap-lf");
  expect_wrong(mapping({"--operator", "reinhard05", "--layers", "x"}), "bilateral");
  expect_wrong({"tonemap-lf", "dir", "-o", "x", "--operator", "robust", "--support", "2"}, "adjusted");
  expect_wrong({"tonemap-lf", "dir", "-o", "x", "--operator", "robust", "--variant",
                "interpolate-statistics+adjusted"},
               "maps frames");
  expect_wrong({"video", "dir", "--path", "0,0:1,0", "-o", "x", "--fps", "30"}, "--fps is for --operator");
  expect_wrong({"video", "dir", "--path", "0,0:1,0", "-o", "x", "--consistency"},
               "--consistency is for --operator");
  expect_wrong({"video", "dir", "--path", "0,0:1,0", "-o", "x", "--operator", "bilateral", "--variant",
                "enhanced", "--map", "frames"},
               "needs disparity");
  expect_wrong({"sweep", "bilateral", "cellar", "--operator", "robust"}, "adjustment");
}

TEST(TonemapCommand, AnImageWithoutDisparitySaysWhatTheVariantNeeds) {
  const TemporaryFolder folder;
  const fs::path view = folder.path() / "view.hdr", out = folder.path() / "out.png";
  write_scene_image(view, plane_field(3).view(0, 0)->colour);
  expect_one_clear_sentence(
      run_program({"tonemap", view, "-o", out, "--operator", "bilateral", "--variant", "enhanced"}),
      "disparity");
  EXPECT_FALSE(fs::exists(out));
}

TEST(TonemapLightFieldCommand, EveryVariantGivesADisplayLightFieldWithTheSameDisparity) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const LightField original = plane_field(3);
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const OperatorVariant& variant : info.variants) {
      if (variant.scope == OperatorScope::kFrame) continue;
      SCOPED_TRACE(info.id + " " + variant.id);
      const fs::path out = folder.path() / (info.id + "-" + variant.id);
      rows_of({"tonemap-lf", field, "-o", out, "--operator", info.id, "--variant", variant.id});
      const DisplayLightField mapped = open_display_light_field(out);
      ASSERT_EQ(mapped.grid(), original.grid());
      expect_display_values(mapped.view(2, 1)->colour);
      EXPECT_EQ(mapped.view(2, 1)->disparity, original.view(2, 1)->disparity);
      EXPECT_TRUE(fs::exists(out / "run.json"));
    }
}

TEST(TonemapLightFieldCommand, AFitOfTheLightFieldMapsEqualRadianceAlikeInAllViews) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), out = folder.path() / "out";
  rows_of({"tonemap-lf", field, "-o", out, "--operator", "reinhard05", "--variant", "joint"});
  const DisplayLightField mapped = open_display_light_field(out);
  const LightField original = plane_field(3);
  // The plane moves by 3 px from column to column: these pixels show the same point.
  ASSERT_EQ(original.view(0, 0)->colour.at(20, 10), original.view(1, 0)->colour.at(17, 10));
  EXPECT_EQ(mapped.view(0, 0)->colour.at(20, 10), mapped.view(1, 0)->colour.at(17, 10));
}

TEST(TonemapLightFieldCommand, AdjustedIsTheOperatorAndThenKeyViewAdjustment) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), naive = folder.path() / "naive";
  const fs::path both = folder.path() / "both", then = folder.path() / "then";
  rows_of({"tonemap-lf", field, "-o", naive, "--operator", "reinhard05", "--variant", "naive"});
  const auto one = rows_of({"tonemap-lf", field, "-o", both, "--operator", "reinhard05", "--variant",
                            "adjusted", "--sigma-views", "1"});
  const auto two = rows_of({"adjust-lf", field, naive, "-o", then, "--sigma-views", "1"});
  expect_equal_fields(both, then);
  EXPECT_EQ(value_of(one, "correspondences_per_pixel"), value_of(two, "correspondences_per_pixel"));
  EXPECT_GT(value_of(two, "correspondences_per_pixel"), 1);
  EXPECT_FALSE(fs::exists(both / "mapped"));
}

TEST(TonemapLightFieldCommand, TheMemoryBoundAndThreadsDoNotChangeTheResult) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const fs::path a = folder.path() / "a", b = folder.path() / "b";
  const Arguments command{"tonemap-lf", field, "--operator", "histogram", "--variant", "joint+adjusted"};
  const auto with = [&](const Arguments& more) {
    Arguments arguments = command;
    arguments.insert(arguments.end(), more.begin(), more.end());
    rows_of(arguments);
  };
  with({"-o", a, "--threads", "1"});
  with({"-o", b, "--memory", "1", "--threads", "3"});
  expect_equal_fields(a, b);
}

TEST(TonemapLightFieldCommand, FailuresLeaveNothingBehind) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), out = folder.path() / "out";
  const fs::path mapped = folder.path() / "mapped";
  rows_of({"tonemap-lf", field, "-o", mapped, "--operator", "robust"});
  expect_one_clear_sentence(run_program({"tonemap-lf", mapped, "-o", out, "--operator", "robust"}),
                            "display-referred");
  expect_one_clear_sentence(run_program({"adjust-lf", field, field, "-o", out}), "tone mapped");
  write_text_file(field / "view_02_02.exr", read_text_file(field / "view_02_02.exr").substr(0, 2000));
  expect_one_clear_sentence(run_program({"tonemap-lf", field, "-o", out, "--operator", "robust"}),
                            "view_02_02.exr");
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST(MappedVideo, WritesFramesAndWhatEachWasMappedWith) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), out = folder.path() / "frames";
  const auto rows = rows_of({"video", field, "--path", "0,1:2,1", "--frames", "5", "--operator", "reinhard05",
                             "--variant", "interpolate-statistics", "--fps", "60", "-o", out});
  EXPECT_GT(value_of(rows, "seconds_preprocess"), 0);
  EXPECT_GT(value_of(rows, "seconds_postprocess_median"), 0);
  const std::string csv = read_text_file(out / "frames.csv");
  for (int i = 0; i < 5; ++i) {
    const std::string name = "frame_000" + std::to_string(i) + ".png";
    EXPECT_EQ(read_display_image(out / name).width(), 48);
    EXPECT_NE(csv.find(name), std::string::npos);
  }
  for (const char* quantity : {"mean_luma", "contrast", "luma_min", "luma_max", "seconds_synthesis"})
    EXPECT_NE(csv.find(quantity), std::string::npos) << quantity;
  EXPECT_FALSE(fs::exists(out / "key-views"));
}

/// Values of a quantity in frames.csv, in order.
std::vector<std::string> frame_values(const fs::path& frames, const std::string& quantity) {
  std::vector<std::string> values;
  const std::string csv = read_text_file(frames / "frames.csv"), key = "," + quantity + ",";
  for (std::size_t at = csv.find(key); at != std::string::npos; at = csv.find(key, at + 1)) {
    const std::size_t begin = at + key.size();
    values.push_back(csv.substr(begin, csv.find(',', begin) - begin));
  }
  return values;
}

TEST(MappedVideo, AnEyeThatDoesNotAdaptKeepsTheParametersOfTheFirstFrame) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const auto contrasts = [&](const std::string& time_s, const std::string& fps) {
    const fs::path out = folder.path() / ("frames-" + time_s + "-" + fps);
    rows_of({"video", field, "--path", "0,0:2,2", "--frames", "3", "--operator", "robust", "--variant",
             "interpolate-statistics", "--fps", fps, "--adaptation-time", time_s, "-o", out});
    return frame_values(out, "contrast");
  };
  const auto at_once = contrasts("0", "60"), slow = contrasts("1000000", "60");
  ASSERT_EQ(at_once.size(), 3u);
  EXPECT_NE(at_once[0], at_once[2]);
  EXPECT_NEAR(std::stod(slow[0]), std::stod(slow[2]), 1e-6);
  EXPECT_EQ(slow[0], at_once[0]);
  // A slideshow leaves the eye all the time it needs.
  EXPECT_NEAR(std::stod(contrasts("0.15", "0.001")[2]), std::stod(at_once[2]), 1e-9);
}

TEST(MappedVideo, FramesAtKeyViewsAreTheMappedKeyViewsWhereverTheOperatorStands) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), mapped = folder.path() / "mapped";
  rows_of({"tonemap-lf", field, "-o", mapped, "--operator", "reinhard05", "--variant", "joint"});
  const DisplayImage expected = open_display_light_field(mapped).view(2, 1)->colour;
  for (const char* place : {"key-views", "frames"}) {
    const fs::path out = folder.path() / place;
    rows_of({"video", field, "--path", "0,1:2,1", "--frames", "3", "--operator", "reinhard05", "--variant",
             "joint", "--map", place, "-o", out});
    const DisplayImage frame = read_display_image(out / "frame_0002.png");
    for (std::size_t i = 0; i < frame.size(); ++i)
      ASSERT_NEAR(frame.pixels()[i].g, expected.pixels()[i].g, 0.5 / 255 + 1e-6) << place;
  }
}

TEST(MappedVideo, ConsistencyIsMeasuredWhereverTheOperatorStands) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  for (const char* place : {"key-views", "frames"}) {
    const fs::path out = folder.path() / place;
    const auto rows =
        rows_of({"video", field, "--path", "0,1:2,1", "--frames", "5", "--operator", "reinhard05",
                 "--variant", "joint", "--map", place, "--consistency", "-o", out});
    EXPECT_GT(value_of(rows, "line_pixels"), 1000) << place;
    EXPECT_LT(value_of(rows, "frame_change_max"), 0.01) << place;
    EXPECT_GE(value_of(rows, "motion_luma_step_max"), 0) << place;
    EXPECT_EQ(frame_values(out, "line_change_rms").size(), 4u) << place;
  }
}

TEST(MappedVideo, EveryVariantMakesFrames) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const OperatorVariant& variant : info.variants) {
      const fs::path out = folder.path() / (info.id + variant.id);
      rows_of({"video", field, "--path", "0.5,0.5:1.5,0.5", "--frames", "2", "--operator", info.id,
               "--variant", variant.id, "-o", out});
      EXPECT_EQ(frame_values(out, "mean_luma").size(), 2u) << info.id << " " << variant.id;
    }
}

}  // namespace
}  // namespace plenolab
