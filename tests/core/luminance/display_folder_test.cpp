#include "core/luminance/display_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "tests/core/luminance/ray_fixtures.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

class DisplayFolderTest : public testing::Test {
 protected:
  DisplayFolderTest()
      : folder_(fs::temp_directory_path() /
                ("plenolab-display-" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
  }
  ~DisplayFolderTest() override { fs::remove_all(folder_); }

  SceneRays write(const ProjectorDisplay& display) const {
    SceneRays rays(display.size());
    for (int k = 0; k < display.size().images; ++k)
      for (int u = 0; u < display.size().width; ++u)
        for (int v = 0; v < display.size().height; ++v)
          rays.at({k, u, v}) = {static_cast<float>(k), static_cast<float>(u), static_cast<float>(v)};
    write_display_folder(folder_, display, rays);
    return rays;
  }
  void replace(const std::string& from, const std::string& to) const {
    std::string text = read_text_file(folder_ / "display.json");
    ASSERT_NE(text.find(from), std::string::npos);
    write_text_file(folder_ / "display.json", text.replace(text.find(from), from.size(), to));
  }
  void expect_refused(const std::string& word) const {
    try {
      read_display_folder(folder_);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }

  fs::path folder_;
};

TEST_F(DisplayFolderTest, ReadsBackWhatWasWritten) {
  const ProjectorDisplay display({.projector_distance_m = 0.7,
                                  .projectors = 3,
                                  .width = 4,
                                  .height = 2,
                                  .layout = ProjectorDisplayOptions::Layout::kArc});
  const SceneRays rays = write(display);
  EXPECT_TRUE(is_display_folder(folder_));
  const DisplayFolder read = read_display_folder(folder_);
  EXPECT_EQ(static_cast<const RayValues<Rgb>&>(read.rays), rays);
  const ProjectorDisplay again(read.display);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(again.projector_x_m(k), display.projector_x_m(k), 1e-12);
    EXPECT_NEAR(again.position({k, 3, 0}).x_m, display.position({k, 3, 0}).x_m, 1e-12);
  }
}

TEST_F(DisplayFolderTest, SaysWhichFileAndKeyIsWrong) {
  write(small_projectors(2, 3, 2));
  replace("\"line\"", "\"circle\"");
  expect_refused("projectors.layout");
  replace("\"circle\"", "\"line\"");
  replace("\"version\": 1", "\"version\": 2");
  expect_refused("version");
  replace("\"version\": 2", "\"version\": 1");
  replace("projector-001.exr", "../secret.exr");
  expect_refused("inside the folder");
  replace("../secret.exr", "missing.exr");
  expect_refused("missing.exr");
}

TEST_F(DisplayFolderTest, ScalesImagesByTheirWhiteLuminanceUnlessTold) {
  const ProjectorDisplay display = small_projectors(2, 3, 2);
  const SceneRays rays = write(display);
  write_scene_image(folder_ / "projector-001.exr", image_of(rays, 1), 25.0);
  const DisplayFolder read = read_display_folder(folder_);
  EXPECT_EQ(read.rays.at({0, 2, 1}).g, 2);
  EXPECT_EQ(read.rays.at({1, 2, 1}).g, 50);
  EXPECT_EQ(read_display_folder(folder_, 3.0).rays.at({1, 2, 1}).g, 6);
}

TEST_F(DisplayFolderTest, RefusesImagesOfDifferentSizes) {
  write(small_projectors(2, 3, 2));
  fs::create_directories(folder_ / "other");
  SceneImage large(5, 2);
  write_scene_image(folder_ / "projector-001.exr", large);
  expect_refused("5 × 2");
}

}  // namespace
}  // namespace plenolab
