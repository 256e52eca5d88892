// plenolab batch: interruptions, parts, threads and failures do not change what comes out.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <limits>
#include <thread>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/random.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/lightfield/light_field_folder.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/reproduce/laboratory.h"
#include "metrics/consistency.h"
#include "tests/experiments/batch/batch_command.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

class BatchInterruption : public BatchCommand {
 protected:
  /// Starts the study and kills the program once it has stored so many items. Whether it was still running.
  bool run_and_kill(const std::string& name, std::size_t items) {
    RunningProgram program({"batch", "run", study_, "-o", folder(name), "--threads", "1"});
    for (int i = 0; i < 20'000 && stored_items(folder(name)) < items; ++i)
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    program.send(SIGKILL);
    return program.wait().status == -SIGKILL;
  }
};

TEST_F(BatchCommand, WritesOneTidyTableOneOfTimesAReportAndWhereTheyComeFrom) {
  const ProgramResult result = run("out", {"--json", "-"});
  const Json document = Json::parse(result.out);
  std::size_t qualities = 0;
  for (const Json& row : document.at("rows")) qualities += row.at("quantity") == "tmqi" ? 1 : 0;
  EXPECT_EQ(qualities, 18u);
  EXPECT_EQ(csv("out").find("seconds"), std::string::npos) << "times differ from run to run";
  EXPECT_TRUE(
      csv("out").starts_with("input,preset,view,operator,variant,settings,note,quantity,value,unit\r\n"));
  EXPECT_NE(batch_file(folder("out"), "timings.csv")
                .find("field,,\"2,2\",bilateral,naive,contrast=30,seconds_median,"),
            std::string::npos);
  EXPECT_NE(batch_file(folder("out"), "report.html").find("tmqi (higher is better) over run time"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(fs::path(folder("out")) / "plots" / "tmqi-over-time.svg"));
  const Json run_json = Json::parse(batch_file(folder("out"), "run.json"));
  EXPECT_EQ(run_json.at("parameters").at("items"), 18);
  EXPECT_EQ(run_json.at("inputs").size(), 2u);
}

TEST_F(BatchCommand, AFinishedStudyIsNotComputedAgain) {
  run("out");
  const std::string first = csv("out"), times = batch_file(folder("out"), "timings.csv");
  const ProgramResult again = run("out");
  EXPECT_NE(again.out.find("18 items: 18 were there, 0 computed, 0 failed"), std::string::npos) << again.out;
  EXPECT_EQ(csv("out"), first);
  EXPECT_EQ(batch_file(folder("out"), "timings.csv"), times) << "nothing was timed again";
}

TEST_F(BatchInterruption, KilledAndStartedAgainItEndsLikeAnUninterruptedRun) {
  run("whole");
  int kills = 0;
  for (std::uint64_t attempt = 0; attempt < 3; ++attempt) {
    const std::string name = "killed-" + std::to_string(attempt);
    for (const std::size_t items : {1 + random_u64(3, attempt, 0) % 5, 7 + random_u64(3, attempt, 1) % 6})
      kills += run_and_kill(name, items) ? 1 : 0;
    const std::size_t kept = stored_items(folder(name));
    const ProgramResult rest = run(name);
    EXPECT_NE(rest.out.find("18 items: " + std::to_string(kept) + " were there"), std::string::npos)
        << rest.out;
    EXPECT_EQ(csv(name), csv("whole"));
  }
  EXPECT_GE(kills, 3) << "the program was too quick to be killed: the test tests nothing";
}

TEST_F(BatchCommand, AStopSignalTellsThatTheSameCommandGoesOn) {
  RunningProgram program({"batch", "run", study_, "-o", folder("out"), "--threads", "1"});
  while (stored_items(folder("out")) < 2) std::this_thread::sleep_for(std::chrono::microseconds(500));
  program.send(SIGTERM);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, -SIGTERM) << result.err;
  EXPECT_NE(result.err.find("the same command goes on with them"), std::string::npos) << result.err;
}

TEST_F(BatchCommand, ThreadsDoNotChangeResults) {
  run("one", {"--threads", "1"});
  run("two", {"--threads", "2"});
  EXPECT_EQ(csv("one"), csv("two"));
}

TEST_F(BatchCommand, TwoShardsMergedAreOneRun) {
  run("whole");
  const ProgramResult part = run("first", {"--shard", "1/2"});
  EXPECT_NE(part.out.find("9 items of other shards are missing"), std::string::npos) << part.out;
  EXPECT_FALSE(fs::exists(fs::path(folder("first")) / "results.csv"));
  const std::vector<std::string> merge{"batch", "merge", study_, folder("first"), "-o", folder("merged")};
  expect_one_clear_sentence(run_program(merge), "9 of 18 items are missing: field 1,1 bilateral");
  run("second", {"--shard", "2/2"});
  std::vector<std::string> both = merge;
  both.insert(both.begin() + 4, folder("second"));
  EXPECT_EQ(run_program(both).status, 0);
  EXPECT_EQ(csv("merged"), csv("whole"));
}

TEST_F(BatchCommand, TheLastShardInOneFolderWritesTheReport) {
  run("whole");
  run("out", {"--shard", "2/2"});
  EXPECT_FALSE(fs::exists(fs::path(folder("out")) / "report.html"));
  run("out", {"--shard", "1/2"});
  EXPECT_EQ(csv("out"), csv("whole"));
}

TEST_F(BatchCommand, ADamagedResultIsToldAndComputedAgain) {
  run("out");
  const std::string whole = csv("out");
  const std::vector<fs::path> files = item_files(folder("out"));
  std::string text = read_text_file(files[0]);
  text.at(text.find("\"value\": 0") + 9) = '1';
  write_text_file(files[0], text);
  write_text_file(files[1], read_text_file(files[1]).substr(0, 100));
  write_text_file(files[2], read_text_file(files[3]));
  fs::resize_file(files[4], 0);
  const ProgramResult again = run("out");
  EXPECT_NE(again.out.find("18 items: 14 were there, 4 computed"), std::string::npos) << again.out;
  EXPECT_EQ(std::count(again.err.begin(), again.err.end(), '\n'), 4) << again.err;
  EXPECT_NE(again.err.find("is damaged and is computed again"), std::string::npos) << again.err;
  EXPECT_EQ(csv("out"), whole);
}

TEST_F(BatchCommand, WhatFailsIsNamedAndStopsNothingElse) {
  const fs::path damaged = parent_.path() / "damaged.exr", dot = parent_.path() / "dot.exr";
  write_scene_image(damaged, SceneImage(64, 48, {1, 1, 1}), 10);
  fs::resize_file(damaged, fs::file_size(damaged) / 2);
  write_scene_image(dot, SceneImage(1, 1, {1, 1, 1}), 10);
  Json study = tiny_batch();
  study["inputs"].insert(study["inputs"].begin(), Json::object({{"image", "damaged.exr"}}));
  study["inputs"].push_back({{"image", "missing.exr"}});
  study["inputs"].push_back({{"image", "dot.exr"}});
  study["operators"].push_back({{"name", "bilateral"}, {"variant", "enhanced"}});
  write_tiny_batch(parent_.path(), study);
  const ProgramResult result = run("out", {}, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("7 of 36 items failed: damaged.exr reinhard02 "), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("and 4 more"), std::string::npos) << result.err;
  const std::string rows = csv("out"), page = batch_file(folder("out"), "report.html");
  for (const char* name : {"damaged.exr", "missing.exr"}) {
    EXPECT_NE(rows.find(std::string(name) + ",,,reinhard02"), std::string::npos) << rows.substr(0, 500);
    EXPECT_NE(page.find(name), std::string::npos);
  }
  EXPECT_NE(rows.find("needs disparity"), std::string::npos) << "dot.exr has none";
  std::size_t qualities = 0;
  for (std::size_t at = 0; (at = rows.find(",tmqi,", at)) != std::string::npos; ++at) ++qualities;
  EXPECT_EQ(qualities, 29u);
  const std::string failed_twice = run("out", {}, 1).out;
  EXPECT_NE(failed_twice.find("36 items: 29 were there, 0 computed, 7 failed"), std::string::npos)
      << failed_twice;
  EXPECT_EQ(csv("out"), rows);
}

TEST_F(BatchCommand, KeyViewAdjustmentGivesTheViewsOfTonemapLf) {
  Json study = tiny_batch();
  study["inputs"][0].erase("cd_m2_per_unit");
  study["inputs"].push_back(Json::object({{"image", "alone.exr"}}));
  study["operators"] = Json::parse(R"([{"name": "reinhard05", "variant": "adjusted"}])");
  write_tiny_batch(parent_.path(), study);
  write_scene_image(parent_.path() / "alone.exr", plane_field(3).view(1, 1)->colour);
  const ProgramResult result = run("out", {"--json", "-"}, 1);
  EXPECT_NE(result.err.find(
                "1 of 10 items failed: alone.exr reinhard05 naive+adjusted (key-view adjustment is for"),
            std::string::npos)
      << result.err;
  ASSERT_EQ(run_program({"tonemap-lf", folder("field"), "-o", folder("mapped"), "--operator", "reinhard05",
                         "--variant", "adjusted"})
                .status,
            0);
  const DisplayLightField mapped = open_display_light_field(folder("mapped"));
  const Json rows = Json::parse(result.out).at("rows");
  int compared = 0;
  for (const Json& row : rows)
    if (row.at("quantity") == "mean_luma") {
      const std::string view = row.at("view");
      EXPECT_NEAR(row.at("value"), mean_luma(mapped.view(view[0] - '0', view[2] - '0')->colour), 1e-12)
          << view;
      ++compared;
    }
  EXPECT_EQ(compared, 9);
}

TEST_F(BatchCommand, PixelsThatAreNotFiniteAreCountedAndLeftOutOfMetrics) {
  SceneImage image = plane_field(3).view(1, 1)->colour;
  image.at(3, 4).g = std::numeric_limits<float>::quiet_NaN();
  image.at(30, 20).r = std::numeric_limits<float>::infinity();
  write_scene_image(parent_.path() / "holes.exr", image, 10);
  Json study = tiny_batch();
  study["inputs"] = Json::parse(R"([{"image": "holes.exr"}])");
  write_tiny_batch(parent_.path(), study);
  run("out");
  EXPECT_NE(csv("out").find("holes.exr,,,reinhard02,naive,,,left_out_pixels,2,px"), std::string::npos)
      << csv("out");
  EXPECT_NE(csv("out").find("holes.exr,,,reinhard02,naive,,,tmqi,"), std::string::npos) << csv("out");
}

TEST_F(BatchCommand, AnExtendedStudyComputesOnlyWhatIsNew) {
  run("out");
  Json study = tiny_batch();
  study["operators"].push_back({{"name", "reinhard02"}, {"variant", "joint"}});
  write_tiny_batch(parent_.path(), study);
  EXPECT_NE(run("out").out.find("27 items: 18 were there, 9 computed"), std::string::npos);
}

TEST_F(BatchCommand, PlanTellsWhatIsDoneAndHowLongTheRestTakes) {
  const auto plan = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"batch", "plan", study_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  EXPECT_NE(plan({}).find("18 items, 18 to do\n"), std::string::npos) << plan({});
  run("out", {"--shard", "1/3"});
  EXPECT_NE(plan({"-o", folder("out")}).find("18 items, 12 to do, about "), std::string::npos);
  const Json rows = Json::parse(plan({"-o", folder("out"), "--json", "-"})).at("rows");
  ASSERT_EQ(rows.size(), 21u);
  EXPECT_EQ(rows[5].at("state"), "done");
  EXPECT_EQ(rows[6].at("state"), "to do");
  EXPECT_EQ(rows[20].at("quantity"), "seconds_to_do");
}

TEST_F(BatchCommand, RefusesWhatItMustNotTouchOrCannotKnow) {
  write_text_file(parent_.path() / "mine" / "letter.txt", "dear");
  expect_one_clear_sentence(run("mine", {}, 1), "exists and holds no batch");
  expect_one_clear_sentence(run("out", {"--shard", "3/2"}, 2), "--shard: give I/N", 2);
  expect_one_clear_sentence(run_program({"batch", "merge", study_, folder("mine"), "-o", folder("out")}),
                            "holds no results of a batch");
  expect_one_clear_sentence(run_program({"batch", "rum", study_}), "did you mean 'run'?", 2);
  expect_one_clear_sentence(run_program({"batch", "run", study_ + "x", "-o", folder("out")}),
                            "does not exist");
  Json study = tiny_batch();
  study["seed"] = 7;
  write_tiny_batch(parent_.path(), study);
  expect_one_clear_sentence(run("out", {"--seed", "8"}, 2), "has a seed of its own, 7", 2);
  EXPECT_FALSE(fs::exists(folder("out")));
}

/// Puts views of our own into the render cache in place of a scene's, which would take seconds to render.
/// Returns them as a light field.
LightField fill_cache(const std::string& id, const fs::path& cache) {
  Laboratory laboratory({.effort = Effort::kTiny, .cache = {}, .on_view = {}});
  const ViewGrid grid = laboratory.grid(id);
  const RenderSettings settings{.paths_per_pixel = laboratory.paths_per_pixel(id)};
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      KeyView<SceneReferred> view{SceneImage(grid.width, grid.height),
                                  DisparityMap(grid.width, grid.height, 1)};
      for (std::size_t i = 0; i < view.colour.size(); ++i)
        view.colour.pixels()[i] =
            Rgb{1, 0.9f, 0.8f} * static_cast<float>(1 + i % 97 + 100 * column + 10 * row);
      const CameraPosition position{static_cast<double>(column), static_cast<double>(row)};
      write_exr(cache / id / (render_cache_key(laboratory.scene(id), grid, position, settings) + ".exr"),
                view.colour, {{"disparity", &view.disparity}}, {.colour_type = ExrPixelType::kFloat});
      views.push_back(std::move(view));
    }
  return LightField::from_views(grid, RadianceUnit::kCdM2, id, std::move(views));
}

TEST_F(BatchCommand, MapsScenesOfTheRenderCacheLikeTonemapLf) {
  const LightField field = fill_cache("dunes", folder("cache"));
  Json study = tiny_batch();
  study["inputs"] = Json::parse(R"([{"scene": "dunes", "preset": "tiny", "views": [[2, 0], [1, 1]]}])");
  study["operators"] = Json::parse(R"([{"name": "reinhard05", "variant": "joint"}, {"name": "histogram"}])");
  write_tiny_batch(parent_.path(), study);
  const Json rows = Json::parse(run("out", {"--cache", folder("cache"), "--json", "-"}).out).at("rows");
  int compared = 0;
  const auto sink = [&](const std::string& op) {
    return [&, op](int column, int row, const ToneMapped& mapped, const FittedOperator&) {
      for (const Json& entry : rows)
        if (entry.at("quantity") == "mean_luma" && entry.at("operator") == op &&
            entry.at("view") == std::to_string(column) + "," + std::to_string(row)) {
          EXPECT_EQ(entry.at("value"), mean_luma(mapped.image)) << op << " " << entry.at("view");
          ++compared;
        }
    };
  };
  for (const auto& [op, variant] : {std::pair{"reinhard05", "joint"}, std::pair{"histogram", "naive"}}) {
    const OperatorInfo& info = find_operator(op);
    map_light_field(info, variant, default_values(info.settings), field, measure_light_field(field),
                    sink(op));
  }
  EXPECT_EQ(compared, 4);
}

TEST(BatchHelp, EverySubcommandExplainsItselfWithAnExample) {
  for (const char* command : {"plan", "run", "merge"}) {
    const ProgramResult result = run_program({"batch", command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_NE(result.out.find(std::string("plenolab batch ") + command + " study.json"), std::string::npos)
        << result.out;
  }
}

}  // namespace
}  // namespace plenolab
