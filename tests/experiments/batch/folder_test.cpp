// What a folder of a batch keeps, shares and refuses.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/batch/item_lock.h"
#include "experiments/batch/item_result.h"
#include "tests/experiments/batch/batch_command.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

class BatchFolder : public BatchCommand {
 protected:
  void change_study(const std::function<void(Json&)>& change) {
    Json study = tiny_batch();
    change(study);
    write_tiny_batch(parent_.path(), study);
  }
  /// A study of the same light field, in another file.
  std::string other_study() {
    Json study = tiny_batch();
    study["metrics"] = {"brisque"};
    const fs::path path = parent_.path() / "other.json";
    write_text_file(path, study.dump());
    return path;
  }
  Json items(const std::string& name) {
    Json all = Json::object();
    for (const fs::path& file : item_files(folder(name)))
      all[file.filename().string()] = Json::parse(read_text_file(file));
    return all;
  }
};

TEST_F(BatchFolder, OfAnotherStudyIsReplacedOnlyWithForceAndLosesNoResult) {
  run("out");
  const std::string before = csv("out"), other = other_study();
  const std::vector<std::string> command{"batch", "run", other, "-o", folder("out")};
  expect_one_clear_sentence(run_program(command), "holds the batch of another study, ");
  EXPECT_EQ(csv("out"), before);
  std::vector<std::string> forced = command;
  forced.emplace_back("--force");
  EXPECT_EQ(run_program(forced).status, 0);
  EXPECT_NE(csv("out").find("brisque_plenolab"), std::string::npos);
  for (const char* name : {"tmqi-over-time.svg", "tmqi-over-time-dark.svg"})
    EXPECT_FALSE(fs::exists(fs::path(folder("out")) / "plots" / name)) << name;
  expect_one_clear_sentence(run("out", {}, 1), "holds the batch of another study, ");
  EXPECT_NE(run("out", {"--force"}).out.find("18 were there, 0 computed"), std::string::npos);
  EXPECT_EQ(csv("out"), before);
}

TEST_F(BatchFolder, OfTheSameStudyGoesOnUnderAnotherPathOrExtended) {
  run("out", {"--shard", "1/2"});
  fs::create_directory(parent_.path() / "elsewhere");
  fs::copy(parent_.path() / "field", parent_.path() / "elsewhere" / "field",
           fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  fs::copy_file(study_, parent_.path() / "elsewhere" / "copy.json");
  const std::string copy = parent_.path() / "elsewhere" / "copy.json";
  EXPECT_EQ(run_program({"batch", "run", copy, "-o", folder("out")}).status, 0) << "the same bytes";
  write_text_file(copy, read_text_file(copy) + "\n");
  EXPECT_EQ(run_program({"batch", "run", copy, "-o", folder("out")}).status, 0) << "the same path";
}

TEST_F(BatchFolder, AMetricMoreOrLessMapsAndTimesNothingAgain) {
  run("out");
  const std::string times = batch_file(folder("out"), "timings.csv"), before = csv("out");
  change_study([](Json& study) { study["metrics"] = {"tmqi", "brisque"}; });
  EXPECT_NE(run("out").out.find("18 items: 0 were there, 18 computed"), std::string::npos);
  EXPECT_EQ(batch_file(folder("out"), "timings.csv"), times);
  const std::string both = csv("out");
  EXPECT_NE(both.find("brisque_plenolab"), std::string::npos);
  change_study([](Json&) {});
  EXPECT_NE(run("out").out.find("18 were there, 0 computed"), std::string::npos);
  EXPECT_EQ(csv("out"), before);
  change_study([](Json& study) { study["metrics"] = {"tmqi", "brisque"}; });
  EXPECT_NE(run("out").out.find("18 were there, 0 computed"), std::string::npos) << "it was kept";
  EXPECT_EQ(csv("out"), both);
  run("fresh");
  EXPECT_EQ(csv("fresh"), both) << "in one go as in two";
}

TEST_F(BatchFolder, AMetricThatFailsLeavesTheOthersTheirNumbers) {
  change_study([](Json& study) {
    study["inputs"][0].erase("cd_m2_per_unit");
    study["inputs"][0]["views"] = "centre";
    study["metrics"] = {"drim", "tmqi"};
  });
  const std::string why = "drim: it needs the luminance of a value of 1, which field does not say";
  EXPECT_NE(run_program({"batch", "plan", study_}).out.find(why), std::string::npos);
  EXPECT_NE(run("out", {}, 1).err.find("2 of 2 items failed: field 1,1 reinhard02 naive (" + why),
            std::string::npos);
  const std::string rows = csv("out");
  EXPECT_NE(rows.find("field,,\"1,1\",reinhard02,naive,,,tmqi,0."), std::string::npos) << rows;
  EXPECT_NE(rows.find(why + ": give \"\"cd_m2_per_unit\"\"\",failed,1,1"), std::string::npos) << rows;
}

TEST_F(BatchFolder, HoldsASmallPictureOfEachMappedImageAndLargeOnesIfAsked) {
  change_study([](Json& study) {
    study["inputs"] = Json::parse(R"([{"image": "wide.exr"}])");
    study["keep_images"] = true;
  });
  SceneImage image(700, 40, {1, 1, 1});
  for (std::size_t i = 0; i < image.size(); i += 3) image.pixels()[i] = {0.1f, 0.1f, 0.2f};
  write_scene_image(parent_.path() / "wide.exr", image, 10);
  run("out");
  for (const fs::path& file : item_files(folder("out"))) {
    const DisplayImage picture = read_display_image(fs::path(file).replace_extension(".png"));
    EXPECT_EQ(picture.width(), 320);
    EXPECT_EQ(picture.height(), 18);
  }
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(fs::path(folder("out")) / "images"))
    images.push_back(entry.path());
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(read_display_image(images[0]).width(), 700);
  EXPECT_NE(images[0].filename().string().find("wide.exr-"), std::string::npos);
  fs::remove(images[0]);
  EXPECT_NE(run("out").out.find("1 were there, 1 computed"), std::string::npos);
  EXPECT_TRUE(fs::exists(images[0]));
}

TEST_F(BatchFolder, NearlyWhiteImagesAreNamedAndMarked) {
  write_scene_image(parent_.path() / "flat.exr", SceneImage(64, 48, {500, 500, 500}), 1);
  change_study([](Json& study) {
    study["inputs"] = Json::parse(R"([{"image": "flat.exr"}])");
    study["operators"] = Json::parse(R"([{"name": "reinhard05", "settings": {"limits": "none", "b": 8}}])");
  });
  const std::string out = run("out").out;
  EXPECT_NE(out.find("nearly white (mean luma above 0.9): 1 of 1: flat.exr reinhard05"), std::string::npos)
      << out;
  EXPECT_NE(batch_file(folder("out"), "report.html").find("nearly white: reinhard05"), std::string::npos);
}

TEST_F(BatchFolder, AnItemThatAnotherRunIsAtIsTakenFromItWhenItIsThere) {
  run("whole");
  fs::create_directories(folder("out"));
  const fs::path held = item_files(folder("whole")).front();
  ItemLocks locks(folder("out"));
  ASSERT_TRUE(locks.try_lock(held.stem()));
  RunningProgram program({"batch", "run", study_, "-o", folder("out")});
  for (int i = 0; i < 10'000 && stored_items(folder("out")) < 17; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(stored_items(folder("out")), 17u);
  for (const char* extension : {".png", ".json"})
    fs::copy_file(fs::path(held).replace_extension(extension),
                  fs::path(folder("out")) / "items" / (held.stem().string() + extension));
  locks.unlock(held.stem());
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("18 items: 1 were there, 17 computed"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("another run is at work in "), std::string::npos) << result.err;
  EXPECT_EQ(csv("out"), csv("whole"));
}

TEST_F(BatchFolder, MergeKeepsWhatIsThereAndJoinsMetrics) {
  run("first");
  run("second");
  const Json first = items("first");
  const ProgramResult merged =
      run_program({"batch", "merge", study_, folder("second"), "-o", folder("first")});
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_NE(merged.out.find("kept 18 results that were in "), std::string::npos) << merged.out;
  EXPECT_EQ(items("first"), first);
  change_study([](Json& study) { study["metrics"] = {"brisque"}; });
  run("third");
  change_study([](Json& study) { study["metrics"] = {"tmqi", "brisque"}; });
  EXPECT_EQ(
      run_program({"batch", "merge", study_, folder("first"), folder("third"), "-o", folder("all")}).status,
      0);
  run("whole");
  EXPECT_EQ(csv("all"), csv("whole"));
  EXPECT_TRUE(fs::exists(fs::path(folder("all")) / "items" /
                         item_files(folder("all")).front().filename().replace_extension(".png")));
}

TEST_F(BatchFolder, ImagesThatAreNoRadianceAreKnownBeforehand) {
  write_display_image(parent_.path() / "shown.png", DisplayImage(8, 8, {}));
  change_study([](Json& study) {
    study["inputs"] = Json::parse(R"([{"image": "shown.png"}, {"image": "gone.exr"}, {"light_field": "field",
        "views": "centre"}])");
    study["operators"].push_back({{"name", "histogram"}, {"variant", "adjusted"}});
  });
  const std::string out = run_program({"batch", "plan", study_}).out;
  EXPECT_NE(out.find("3 items cannot be done, wholly or in part: shown.png holds display values"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("gone.exr does not exist"), std::string::npos) << out;
}

TEST_F(BatchFolder, ScenesOfLuminanceDisplaysAndMetricsThatDoNotFitAreNamed) {
  change_study([](Json& study) { study["inputs"] = Json::parse(R"([{"scene": "pillars"}])"); });
  expect_one_clear_sentence(run("out", {}, 1), "which is for luminance displays");
  change_study([](Json& study) { study["metrics"] = {"tmqj"}; });
  const std::string error = run("out", {}, 1).err;
  EXPECT_NE(error.find("choose from all, "), std::string::npos) << error;
  EXPECT_EQ(error.find("psnr"), std::string::npos) << error;
  EXPECT_EQ(error.find("tmqi, tmqi"), std::string::npos) << error;
}

}  // namespace
}  // namespace plenolab
