// plenolab batch: what is wrong with one input, one view or one study stays there and is said alike
// everywhere.
#include <gtest/gtest.h>

#include <chrono>

#include "core/io/image_file.h"
#include "core/lightfield/light_field_folder.h"
#include "tests/experiments/batch/batch_command.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

class BatchRobustness : public BatchCommand {
 protected:
  void add_input(const char* json) {
    study_json_["inputs"].push_back(Json::parse(json));
    write_tiny_batch(parent_.path(), study_json_);
  }
  Json study_json_ = tiny_batch();
};

void write_damaged_exr(const fs::path& file) {
  write_scene_image(file, SceneImage(64, 48, {1, 1, 1}), 10);
  fs::resize_file(file, fs::file_size(file) / 2);
}

TEST_F(BatchRobustness, WhatCannotBeOpenedIsTheProblemOfItsOwnItems) {
  fs::create_symlink("loop", parent_.path() / "loop");
  fs::create_directory(parent_.path() / "folder.exr");
  write_text_file(parent_.path() / "header.hdr",
                  "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999 +X 99999999\n");
  const std::string long_name(300, 'x');
  for (const std::string& input :
       {std::string(R"({"light_field": "loop"})"), std::string(R"({"image": "loop", "name": "loop-image"})"),
        std::string(R"({"image": "folder.exr"})"), std::string(R"({"image": "header.hdr"})"),
        R"({"light_field": ")" + long_name + R"("})", R"({"image": ")" + long_name + R"(.exr"})"})
    add_input(input.c_str());
  const ProgramResult result = run("out", {}, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("12 of 30 items failed: loop reinhard02 naive (loop cannot be opened: "),
            std::string::npos)
      << result.err;
  EXPECT_NE(csv("out").find("folder.exr is not a file"), std::string::npos) << csv("out");
  EXPECT_NE(result.out.find("18 computed, 12 failed"), std::string::npos) << result.out;
}

TEST_F(BatchRobustness, AViewThatThereIsNotFailsAloneAndIsNamed) {
  study_json_["inputs"][0]["views"] = Json::parse("[[0, 0], [9, 9]]");
  write_tiny_batch(parent_.path(), study_json_);
  const ProgramResult result = run("out", {}, 1);
  EXPECT_NE(result.out.find("4 items: 0 were there, 2 computed, 2 failed"), std::string::npos) << result.out;
  EXPECT_NE(csv("out").find("field,,\"0,0\",reinhard02,naive,,,tmqi,"), std::string::npos) << csv("out");
  EXPECT_NE(csv("out").find(
                "field,,\"9,9\",reinhard02,naive,,\"there is no view [9, 9] among its 3 × 3\",failed,1"),
            std::string::npos)
      << csv("out");
}

TEST_F(BatchRobustness, ShardsAndTheirMergeMayLieUnderDifferentPaths) {
  write_damaged_exr(parent_.path() / "damaged.exr");
  add_input(R"({"image": "damaged.exr"})");
  add_input(R"({"light_field": "nowhere"})");
  const TemporaryFolder elsewhere;
  const fs::path other = elsewhere.path() / "another" / "place";
  fs::create_directories(other.parent_path());
  fs::copy(parent_.path(), other, fs::copy_options::recursive);
  run("first", {"--shard", "1/2"});
  const ProgramResult second =
      run_program({"batch", "run", other / "study.json", "-o", other / "second", "--shard", "2/2"});
  expect_one_clear_sentence(second, "4 of 11 items of this shard failed");
  const auto merge = [&](const fs::path& study, const char* name) {
    expect_one_clear_sentence(
        run_program({"batch", "merge", study, folder("first"), other / "second", "-o", folder(name)}),
        "4 of 22 items failed: damaged.exr");
    return csv(name);
  };
  const std::string here = merge(study_, "here");
  EXPECT_EQ(here, merge(other / "study.json", "there"));
  run("whole", {}, 1);
  EXPECT_EQ(here, csv("whole"));
  EXPECT_EQ(here.find(parent_.path().string()), std::string::npos) << "notes name files as the study does";
}

TEST_F(BatchRobustness, AViewDamagedBelowItsHeaderIsNamedAsTheStudySpellsIt) {
  for (const auto& entry : fs::directory_iterator(parent_.path() / "field"))
    if (entry.path().extension() == ".exr")
      fs::resize_file(entry.path(), fs::file_size(entry.path()) * 3 / 4);
  run("out", {}, 1);
  EXPECT_NE(csv("out").find("field/"), std::string::npos) << csv("out");
  EXPECT_EQ(csv("out").find(parent_.path().string()), std::string::npos) << csv("out");
}

TEST_F(BatchRobustness, TablesOfAnEarlierStudyDoNotStayWhereItemsAreOpen) {
  run("out");
  write_text_file(fs::path(folder("out")) / "plots" / "mine.svg", "mine");
  write_scene_image(parent_.path() / "new.exr", SceneImage(64, 48, {1, 1, 1}), 10);
  add_input(R"({"image": "new.exr"})");
  const ProgramResult part = run("out", {"--shard", "1/2"});
  EXPECT_NE(part.out.find("removed results.csv, timings.csv, report.html, run.json of an earlier study"),
            std::string::npos)
      << part.out;
  for (const char* name :
       {"results.csv", "timings.csv", "report.html", "run.json", "plots/tmqi-over-time.svg"})
    EXPECT_FALSE(fs::exists(fs::path(folder("out")) / name)) << name;
  EXPECT_TRUE(fs::exists(fs::path(folder("out")) / "plots" / "mine.svg"));
  EXPECT_EQ(stored_items(folder("out")), 18u) << "results are never removed";
  const ProgramResult rest = run("out", {"--shard", "2/2"});
  EXPECT_EQ(rest.out.find("removed"), std::string::npos) << rest.out;
  EXPECT_NE(csv("out").find("new.exr"), std::string::npos);
}

TEST_F(BatchRobustness, AnInputGivenTwiceIsToldAsShared) {
  add_input(R"({"light_field": "field", "name": "again", "cd_m2_per_unit": 20, "views": "all"})");
  const std::string out = run("out").out;
  EXPECT_NE(out.find("36 items: 0 were there, 18 computed, 0 failed, 18 share the result of another"),
            std::string::npos)
      << out;
  EXPECT_NE(csv("out").find("again,,\"2,2\",bilateral"), std::string::npos);
}

TEST_F(BatchRobustness, WhatAKilledRunLeftHalfWrittenIsSweptUp) {
  run("out");
  const fs::path items = fs::path(folder("out")) / "items", left = items / ".abc.123-4.partial.json";
  write_text_file(left, "{");
  run("out");
  EXPECT_TRUE(fs::exists(left)) << "it may belong to a run that is writing";
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(2));
  run("out");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(stored_items(folder("out")), 18u);
}

TEST_F(BatchRobustness, TwoRunsAtOnceInOneFolderEndLikeOne) {
  run("whole");
  for (const auto& shards : {std::pair{"1/1", "1/1"}, std::pair{"1/2", "2/2"}}) {
    const std::string name = std::string("both-") + shards.second[0];
    RunningProgram first({"batch", "run", study_, "-o", folder(name), "--shard", shards.first});
    RunningProgram second({"batch", "run", study_, "-o", folder(name), "--shard", shards.second});
    EXPECT_EQ(first.wait().status, 0);
    EXPECT_EQ(second.wait().status, 0);
    EXPECT_EQ(csv(name), csv("whole"));
    EXPECT_EQ(stored_items(folder(name)), 18u);
  }
}

TEST_F(BatchRobustness, MergeSaysWhyAResultIsNotThere) {
  run("out");
  const auto merged = [&](const fs::path& from) {
    return run_program({"batch", "merge", study_, from, "-o", folder("merged")});
  };
  expect_one_clear_sentence(merged(folder("nothing")), "nothing does not exist");
  expect_one_clear_sentence(merged(study_), "study.json is not a folder");
  fs::create_directory(folder("empty"));
  expect_one_clear_sentence(merged(folder("empty")), "holds no results of a batch");
  const std::vector<fs::path> files = item_files(folder("out"));
  const std::string text = read_text_file(files[0]);
  fs::resize_file(files[0], 100);
  expect_one_clear_sentence(merged(folder("out")), "1 of 18 items are damaged: field ");
  // The result of another build: under another key, and with another name of the build.
  fs::remove(files[0]);
  auto other = nlohmann::ordered_json::parse(text);
  other["build"] = "another";
  write_text_file(fs::path(folder("out")) / "items" / "0123.json", other.dump());
  expect_one_clear_sentence(merged(folder("out")),
                            "1 of 18 items are there from another build of plenolab only");
  study_json_["repeat"] = 2;
  write_tiny_batch(parent_.path(), study_json_);
  expect_one_clear_sentence(merged(folder("out")),
                            "17 of 18 items are there only for other pixels or a study");
}

}  // namespace
}  // namespace plenolab
