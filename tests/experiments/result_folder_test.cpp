#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/exr.h"
#include "experiments/cli/result_folder.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

void write_result(const ResultFolder& folder, const std::string& file, const std::string& text) {
  Provenance provenance = start_provenance({"plenolab", folder.command});
  write_result_folder(folder, provenance,
                      [&](const fs::path& temporary) { write_text_file(temporary / file, text); });
}

std::string message_of(const ResultFolder& folder) {
  try {
    write_result(folder, "new.txt", "new");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_refused(const ResultFolder& folder, const std::string& mentions) {
  const std::string message = message_of(folder);
  EXPECT_NE(message.find(mentions), std::string::npos) << message;
}

TEST(ResultFolder, TheSameCommandOnTheSameItemReplacesItsResultWhole) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "deep" / "result";
  write_result({path, "render", "cellar"}, "sub/old.txt", "old");
  write_result({path, "render", "cellar"}, "new.txt", "new");
  EXPECT_EQ(read_text_file(fs::path(path) / "new.txt"), "new");
  EXPECT_FALSE(fs::exists(fs::path(path) / "sub"));
  const auto run = nlohmann::json::parse(read_text_file(fs::path(path) / "run.json"));
  EXPECT_EQ(run.at("result").at("item"), "cellar");
  EXPECT_EQ(run.at("result").at("files"), nlohmann::json::array({"new.txt"}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "deep"), {}), 1);
}

TEST(ResultFolder, AnotherResultIsReplacedOnlyByForce) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "result";
  write_result({path, "render", "cellar"}, "old.txt", "old");
  expect_refused({path, "render", "boats"}, "holds the result of 'plenolab render cellar'");
  expect_refused({path, "sweep", "cellar"}, "--force");
  EXPECT_EQ(read_text_file(fs::path(path) / "old.txt"), "old");
  write_result({path, "sweep", "cellar", true}, "new.txt", "new");
  EXPECT_FALSE(fs::exists(fs::path(path) / "old.txt"));
}

TEST(ResultFolder, FilesOfOthersAreNeverTouched) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "result";
  write_result({path, "render", "cellar"}, "old.txt", "old");
  write_text_file(fs::path(path) / "sub" / "notes.txt", "mine");
  for (const bool force : {false, true})
    expect_refused({path, "render", "cellar", force}, "holds sub/notes.txt, which plenolab did not write");
  EXPECT_EQ(read_text_file(fs::path(path) / "sub" / "notes.txt"), "mine");
  const std::string foreign = folder.path() / "foreign";
  write_text_file(fs::path(foreign) / "notes.txt", "mine");
  for (const char* run : {"", "{}", "[1]", "{\"result\": {\"command\": 1}}", "{\"result\": "}) {
    if (*run) write_text_file(fs::path(foreign) / "run.json", run);
    for (const bool force : {false, true}) expect_refused({foreign, "render", "cellar", force}, "no result");
  }
  write_text_file(folder.path() / "file", "mine");
  expect_refused({folder.path() / "file", "render", "cellar", true}, "is not a folder");
}

TEST(ResultFolder, AnInputIsNeverReplacedEvenByForce) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "field";
  write_result({path, "render", "cellar"}, "view.txt", "view");
  Provenance provenance = start_provenance({"plenolab", "video"});
  for (const fs::path& input : {fs::path(path), fs::path(path) / "view.txt"}) {
    provenance.inputs = {{input.string(), ""}};
    EXPECT_THROW(
        write_result_folder({path, "video", "field", true}, provenance, [](const fs::path&) { FAIL(); }),
        UsageError);
  }
  EXPECT_EQ(read_text_file(fs::path(path) / "view.txt"), "view");
  EXPECT_NO_THROW(require_keeps_inputs(provenance, folder.path() / "other"));
}

TEST(ResultFolder, ATonemappedImageDoesNotReplaceItsInput) {
  const TemporaryFolder folder;
  const std::string image = folder.path() / "image.exr";
  write_exr(image, SceneImage(8, 6, Rgb{1, 2, 3}), {}, {});
  const std::string before = read_text_file(image);
  expect_one_clear_sentence(run_program({"tonemap", image, "-o", image, "--operator", "reinhard02"}),
                            "would replace the input", 2);
  EXPECT_EQ(read_text_file(image), before);
}

TEST(ResultFolder, AFailedRunKeepsTheEarlierResult) {
  const TemporaryFolder folder;
  const ResultFolder result{folder.path() / "result", "render", "cellar"};
  write_result(result, "old.txt", "old");
  Provenance provenance = start_provenance({"plenolab", "render"});
  EXPECT_THROW(write_result_folder(result, provenance,
                                   [](const fs::path& temporary) {
                                     write_text_file(temporary / "half.txt", "half");
                                     throw InputError("no more");
                                   }),
               InputError);
  EXPECT_EQ(read_text_file(fs::path(result.path) / "old.txt"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

/// A command that writes a folder, and one that would write another result there.
struct FolderCommand {
  std::vector<std::string> arguments, other;
};

TEST(ResultFolder, EveryCommandKeepsTheOneRule) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"),
                 other = written_plane(folder.path() / "other");
  const std::string cache = folder.path() / "cache";
  const std::vector<std::string> tiny{"--columns", "1", "--rows", "1", "--width", "16", "--cache", cache};
  const auto render = [&](const std::string& scene) {
    std::vector<std::string> arguments{"render", scene};
    arguments.insert(arguments.end(), tiny.begin(), tiny.end());
    return arguments;
  };
  const std::vector<FolderCommand> commands{
      {render("cellar"), render("boats")},
      {{"convert", field, "--unchecked"}, {"convert", other, "--unchecked"}},
      {{"video", field, "--path", "0,1:2,1", "--frames", "2"}, {"video", field, "--path", "1,0:1,2"}},
      {{"evaluate", field}, {"evaluate", other}},
      {{"sweep", "synthesis", field, "--runs", "1"}, {"sweep", "synthesis", other, "--runs", "1"}},
      {{"reproduce", "altmeier-claim-g3", "--preset", "tiny", "--cache", cache},
       {"reproduce", "altmeier-fig-37", "--preset", "tiny", "--cache", cache}},
  };
  for (const FolderCommand& command : commands) {
    const fs::path out = folder.path() / ("out-" + command.arguments[0]);
    const auto run = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), {"-o", out});
      return run_program(arguments);
    };
    for (int time = 0; time < 2; ++time) {
      const ProgramResult result = run(command.arguments);
      EXPECT_EQ(result.status, 0) << command.arguments[0] << ": " << result.err;
    }
    const std::string run_json = read_text_file(out / "run.json");
    expect_one_clear_sentence(run(command.other), "'plenolab " + command.arguments[0]);
    write_text_file(out / "notes.txt", "mine");
    expect_one_clear_sentence(run(command.arguments), "notes.txt");
    EXPECT_EQ(read_text_file(out / "notes.txt"), "mine");
    EXPECT_EQ(read_text_file(out / "run.json"), run_json);
  }
}

}  // namespace
}  // namespace plenolab
