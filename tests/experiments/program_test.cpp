#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/io/exr.h"
#include "experiments/commands.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

/// Data from outside that is not part of the project (see tests/README.md); tests that need it skip without.
fs::path outside_data() {
  const char* folder = std::getenv("PLENOLAB_OUTSIDE_DATA");
  return folder ? folder : "";
}

void replace_in_file(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_text_file(file);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  write_text_file(file, text);
}

TEST(Program, EveryCommandExplainsItselfWithAnExample) {
  for (const Command& command : commands()) {
    const ProgramResult result = run_program({command.name, "--help"});
    EXPECT_EQ(result.status, 0) << command.name;
    EXPECT_NE(result.out.find("Example"), std::string::npos) << command.name;
    EXPECT_NE(result.out.find(std::string("plenolab ") + command.name), std::string::npos) << command.name;
  }
}

TEST(Program, DamagedExrFilesGiveOneSentenceOrAnImagePromptlyWithinOneGib) {
  if (outside_data().empty()) GTEST_SKIP() << "set PLENOLAB_OUTSIDE_DATA to a folder that holds damaged-exr/";
  int files = 0;
  for (const auto& entry : fs::directory_iterator(outside_data() / "damaged-exr")) {
    ++files;
    const TemporaryFolder folder;
    const fs::path copy = folder.path() / (entry.path().filename().string() + ".exr");
    fs::copy_file(entry.path(), copy);
    const ProgramResult result = run_program({"info", copy});
    EXPECT_TRUE(result.status == 0 || result.status == 1) << entry.path() << " status " << result.status;
    if (result.status == 1) expect_one_clear_sentence(result, copy);
    EXPECT_LT(result.peak_mib, 1024) << entry.path();
  }
  EXPECT_EQ(files, 21);
}

TEST(Program, MissingViewIsNamed) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  fs::path first_view;
  for (const auto& entry : fs::directory_iterator(field))
    if (entry.path().extension() == ".exr") first_view = std::max(first_view, entry.path());
  fs::remove(first_view);
  const fs::path out = folder.path() / "novel.exr";
  expect_one_clear_sentence(run_program({"synth", field, "--at", "0.5,0.5", "-o", out}),
                            first_view.filename().string());
  EXPECT_FALSE(fs::exists(out));
}

TEST(Program, WrongSizesAndJsonTypesNameTheKeyOrFile) {
  const TemporaryFolder folder;
  const fs::path sizes = written_plane(folder.path() / "sizes");
  replace_in_file(sizes / "lightfield.json", "\"width\": 48", "\"width\": 49");
  expect_one_clear_sentence(run_program({"info", sizes}), "48");
  const fs::path types = written_plane(folder.path() / "types");
  replace_in_file(types / "lightfield.json", "\"columns\": 3", "\"columns\": \"three\"");
  expect_one_clear_sentence(run_program({"info", types}), "columns");
  const fs::path text = written_plane(folder.path() / "text");
  write_text_file(text / "lightfield.json", "{\"format\": ");
  expect_one_clear_sentence(run_program({"info", text}), "lightfield.json");
}

TEST(Program, DisparityOfTheWrongSignFailsTheSelfCheckLoudly) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"info", written_plane(folder.path() / "wrong", -1)});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("sign"), std::string::npos) << result.err;
  EXPECT_EQ(run_program({"info", written_plane(folder.path() / "right")}).status, 0);
}

TEST(Program, NegativeDisparityNamesTheView) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const KeyView<SceneReferred> view{SceneImage(48, 32, Rgb{1, 1, 1}), DisparityMap(48, 32, -3.0f)};
  fs::path file;
  for (const auto& entry : fs::directory_iterator(field))
    if (entry.path().extension() == ".exr") file = entry.path();
  write_exr(file, view.colour, {{"disparity", &view.disparity}});
  expect_one_clear_sentence(run_program({"evaluate", field, "--key-stride", "2"}), file.filename().string());
}

TEST(Program, SynthOnAKeyViewReproducesThatViewExactly) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const fs::path out = folder.path() / "novel.exr";
  const ProgramResult result = run_program({"synth", field, "--at", "2,1", "-o", out});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(read_exr_image(out), plane_field(3).view(2, 1)->colour);
  EXPECT_TRUE(fs::exists(out.string() + ".run.json"));
}

TEST(Program, EvaluateWritesTheSameRowsAsJsonAndCsv) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const fs::path json = folder.path() / "rows.json", csv = folder.path() / "rows.csv";
  const ProgramResult result = run_program({"evaluate", field, "--json", json, "--csv", csv});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto parsed = nlohmann::json::parse(read_text_file(json));
  const std::string text = read_text_file(csv);
  EXPECT_EQ(parsed.at("rows").size() + 1,
            static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')));
  EXPECT_TRUE(parsed.at("run").contains("command_line"));
  const bool has_total = std::any_of(parsed.at("rows").begin(), parsed.at("rows").end(), [](const auto& row) {
    return row.at("quantity") == "psnr_gamma_db" && row.at("view") == "all" &&
           row.at("value").template get<double>() > 30;
  });
  EXPECT_TRUE(has_total);
}

TEST(Program, AnImportedHciFolderIsEvaluatedAsItIs) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), hci = folder.path() / "hci";
  const ProgramResult convert = run_program({"convert", field, "--to", "hci", "-o", hci});
  ASSERT_EQ(convert.status, 0) << convert.err;
  ASSERT_TRUE(fs::exists(hci / "input_Cam008.png"));
  const ProgramResult result = run_program({"evaluate", hci, "--key-stride", "2", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto rows = nlohmann::json::parse(result.out).at("rows");
  const auto total = std::find_if(rows.begin(), rows.end(), [](const auto& row) {
    return row.at("quantity") == "psnr_gamma_db" && row.at("view") == "all";
  });
  ASSERT_NE(total, rows.end());
  EXPECT_GT(total->at("value").get<double>(), 30);
}

TEST(Program, CsvGoesToStandardOutputAlone) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const ProgramResult result = run_program({"info", field, "--csv", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("path,")) << result.out.substr(0, 80);
  EXPECT_EQ(result.out.find("self-check:"), std::string::npos);
  EXPECT_EQ(run_program({"info", field, "--csv", "-", "--json", "-"}).status, 2);
}

TEST(Program, FramesOfAVideoMakeAnEpi) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const fs::path frames = folder.path() / "frames", slice = folder.path() / "deep" / "epi.exr";
  const ProgramResult video =
      run_program({"video", field, "--path", "0,1:2,1", "--frames", "5", "-o", frames});
  ASSERT_EQ(video.status, 0) << video.err;
  const ProgramResult epi = run_program({"epi", frames, "--row", "16", "-o", slice});
  ASSERT_EQ(epi.status, 0) << epi.err;
  const SceneImage image = read_exr_image(slice);
  EXPECT_EQ(image.width(), 48);
  EXPECT_EQ(image.height(), 5);
  EXPECT_EQ(image.at(20, 0), plane_field(3).view(0, 1)->colour.at(20, 16));
}

TEST(Program, RendererFoldersWithTheirOwnChannelNamesAreEvaluatedAsTheyAre) {
  if (outside_data().empty()) GTEST_SKIP() << "set PLENOLAB_OUTSIDE_DATA to a folder that holds blender-3x3/";
  const ProgramResult result =
      run_program({"evaluate", outside_data() / "blender-3x3", "--key-stride", "2", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto rows = nlohmann::json::parse(result.out).at("rows");
  const auto total = std::find_if(rows.begin(), rows.end(), [](const auto& row) {
    return row.at("quantity") == "views_scored" && row.at("view") == "all";
  });
  ASSERT_NE(total, rows.end());
  EXPECT_EQ(total->at("value"), 5);
}

}  // namespace
}  // namespace plenolab
