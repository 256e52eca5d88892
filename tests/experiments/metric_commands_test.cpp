// plenolab metric with tone mapped images, a viewer, maps, and without a reference.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

/// A scene with texture, with and without a stated unit, and a picture of it.
class MetricCommand : public testing::Test {
 protected:
  void SetUp() override {
    SceneImage scene(64, 48);
    DisplayImage picture(64, 48);
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const float wave = std::sin(0.9f * static_cast<float>(x)) * std::sin(0.7f * static_cast<float>(y));
        const float light = std::pow(10.0f, static_cast<float>(x) / 32) * (2 + wave);
        scene.at(x, y) = Rgb{1, 1, 1} * light;
        picture.at(x, y) = Rgb{1, 1, 1} * std::clamp(0.25f * std::log10(light) + 0.1f, 0.0f, 1.0f);
      }
    }
    write_scene_image(scene_, scene, 100);
    write_scene_image(relative_, scene);
    write_display_image(picture_, picture);
  }

  nlohmann::json rows_of(Arguments arguments) const {
    arguments.insert(arguments.begin(), "metric");
    arguments.insert(arguments.end(), {"--json", "-"});
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.status == 0 ? nlohmann::json::parse(result.out).at("rows") : nlohmann::json::array();
  }

  static bool has(const nlohmann::json& rows, const std::string& quantity) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const auto& row) { return row.at("quantity") == quantity; });
  }

  static double value_of(const nlohmann::json& rows, const std::string& quantity) {
    for (const auto& row : rows)
      if (row.at("quantity") == quantity) return row.at("value").template get<double>();
    ADD_FAILURE() << "no " << quantity;
    return NAN;
  }

  TemporaryFolder folder_;
  std::string scene_ = folder_.path() / "scene.exr", relative_ = folder_.path() / "relative.exr",
              picture_ = folder_.path() / "picture.png";
};

TEST_F(MetricCommand, ComparesATonemappedPictureWithItsScene) {
  const auto rows = rows_of({"--ref", scene_, "--test", picture_});
  for (const char* quantity : {"drim_share_any", "drim_mean_total", "tmqi", "feature_photographic",
                               "feature_content_adaptive", "brisque_plenolab"})
    EXPECT_TRUE(has(rows, quantity)) << quantity;
  EXPECT_FALSE(has(rows, "psnr_gamma_db")) << "it takes two images of one kind";
}

TEST_F(MetricCommand, TakesTheUnitFromTheFileOrTheUserAndRefusesToGuess) {
  const auto declared = rows_of({"--ref", scene_, "--test", picture_, "--metric", "drim"});
  const auto given =
      rows_of({"--ref", relative_, "--test", picture_, "--metric", "drim", "--cd-m2-per-unit", "100"});
  EXPECT_EQ(value_of(declared, "drim_mean_total"), value_of(given, "drim_mean_total"));
  expect_one_clear_sentence(
      run_program({"metric", "--ref", relative_, "--test", picture_, "--metric", "drim"}), "--cd-m2-per-unit",
      2);
  const auto all = rows_of({"--ref", relative_, "--test", picture_});
  EXPECT_FALSE(has(all, "drim_share_any"));
  EXPECT_TRUE(has(all, "note"));
  EXPECT_TRUE(has(all, "tmqi"));
}

TEST_F(MetricCommand, SeesWhatTheViewerSees) {
  const Arguments base{"--ref", scene_, "--test", picture_, "--metric", "drim"};
  Arguments far = base, dim = base;
  far.insert(far.end(), {"--pixels-per-degree", "200"});
  dim.insert(dim.end(), {"--display-peak", "1", "--display-black", "0.001"});
  EXPECT_NE(value_of(rows_of(base), "drim_mean_total"), value_of(rows_of(far), "drim_mean_total"));
  EXPECT_NE(value_of(rows_of(base), "drim_mean_total"), value_of(rows_of(dim), "drim_mean_total"));
  expect_one_clear_sentence(run_program({"metric", "--ref", scene_, "--test", picture_, "--metric", "drim",
                                         "--display-black", "400"}),
                            "--display-black 400 must be below", 2);
}

TEST_F(MetricCommand, WritesMapsWithTheSameNumbers) {
  const std::string maps = folder_.path() / "maps";
  const auto rows = rows_of({"--ref", scene_, "--test", picture_, "--metric", "drim", "--maps", maps});
  for (const char* name : {"drim.png", "drim-loss.png", "drim-amplification.png", "drim-reversal.png"})
    EXPECT_EQ(read_display_image(fs::path(maps) / name).width(), 64) << name;
  EXPECT_TRUE(fs::exists(fs::path(maps) / "run.json"));
  EXPECT_EQ(value_of(rows, "drim_share_any"),
            value_of(rows_of({"--ref", scene_, "--test", picture_, "--metric", "drim"}), "drim_share_any"));
}

TEST_F(MetricCommand, JudgesAPictureWithoutAReference) {
  const auto rows = rows_of({"--test", picture_});
  EXPECT_TRUE(has(rows, "brisque_plenolab"));
  expect_one_clear_sentence(run_program({"metric", "--test", picture_, "--metric", "psnr"}), "--ref", 2);
  expect_one_clear_sentence(run_program({"metric", "--test", scene_, "--metric", "brisque"}), ".png");
}

TEST_F(MetricCommand, LeavesOutNoMetricThatWasNamed) {
  const auto refused = [&](Arguments arguments, const std::string& hint) {
    arguments.insert(arguments.begin(), "metric");
    expect_one_clear_sentence(run_program(arguments), hint, 2);
  };
  refused({"--ref", scene_, "--test", picture_, "--metric", "psnr,tmqi"}, "psnr_linear does not take");
  refused({"--test", picture_, "--metric", "ssim,brisque"}, "ssim_gamma does not take");
  refused({"--ref", scene_, "--test", picture_, "--display-peak", "1e7"}, "--display-peak");
  refused({"--ref", scene_, "--test", picture_, "--display-black", "400"},
          "--display-black 400 must be below");
}

TEST_F(MetricCommand, ListsWhatThereIsAndWhichWayIsBetter) {
  const auto rows = rows_of({"--list"});
  EXPECT_TRUE(has(rows, "drim_mean_total"));
  const auto column = [&](const char* quantity, const char* name) {
    for (const auto& row : rows)
      if (row.at("quantity") == quantity) return row.at(name).get<std::string>();
    return std::string();
  };
  EXPECT_EQ(column("tmqi", "better"), "higher is better");
  EXPECT_EQ(column("brisque_plenolab", "takes"), "a picture alone");
  EXPECT_NE(run_program({"metric", "--list"}).out.find("lower is better"), std::string::npos);
  expect_one_clear_sentence(run_program({"metric"}), "give --test", 2);
}

TEST_F(MetricCommand, LeavesUndefinedPixelsOutOnlyIfAsked) {
  SceneImage damaged = read_scene_image(scene_);
  damaged.at(5, 7).g = std::nanf("");
  damaged.at(60, 3).r = HUGE_VALF;
  const std::string path = (folder_.path() / "damaged.exr").string();
  write_scene_image(path, damaged, 100);
  expect_one_clear_sentence(run_program({"metric", "--ref", path, "--test", picture_, "--metric", "drim"}),
                            "NaN or infinity");
  const auto rows = rows_of({"--ref", path, "--test", picture_, "--metric", "drim", "--ignore-undefined"});
  EXPECT_EQ(value_of(rows, "ignored_pixels"), 2);
  EXPECT_TRUE(has(rows, "drim_share_any"));
  EXPECT_FALSE(has(rows_of({"--ref", scene_, "--test", picture_, "--metric", "drim", "--ignore-undefined"}),
                   "ignored_pixels"));
}

TEST_F(MetricCommand, NamesTheKindsOfImagesForAnother) {
  expect_one_clear_sentence(run_program({"metric", "--ref", scene_, "--test", "picture.jpg"}),
                            "pictures are .png");
}

TEST_F(MetricCommand, TellsWhichWayRoundImagesGo) {
  expect_one_clear_sentence(run_program({"metric", "--ref", picture_, "--test", scene_}),
                            "tone mapped image as the test");
}

}  // namespace
}  // namespace plenolab
