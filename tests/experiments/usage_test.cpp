#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/io/exr.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/suggest.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

void expect_wrong_use(const Arguments& arguments, const std::string& mentions) {
  SCOPED_TRACE(arguments.empty() ? "" : arguments[0]);
  expect_one_clear_sentence(run_program(arguments), mentions, 2);
}

TEST(Suggestions, AreTheNearestWordOrNone) {
  const std::vector<std::string> words{"scenes", "render", "reproduce", "synth"};
  EXPECT_EQ(nearest("rendr", words), "render");
  EXPECT_EQ(nearest("redner", words), "render");
  EXPECT_EQ(nearest("scene", words), "scenes");
  EXPECT_EQ(nearest("repro", words), "reproduce");
  EXPECT_EQ(nearest("frobnicate", words), "");
  EXPECT_EQ(nearest("", words), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), words), "");
  EXPECT_EQ(did_you_mean("syth", words), "; did you mean 'synth'?");
}

TEST(Checks, TakeExactlyTheirRange) {
  const auto takes = [](const CLI::Validator& check, const std::string& text) { return check(text).empty(); };
  for (const char* text : {"0.25", "4", "1e0"}) EXPECT_TRUE(takes(number_between(0.25, 4), text)) << text;
  for (const char* text : {"0", "4.1", "nan", "inf", "-1", "", "1x", "1,5"})
    EXPECT_FALSE(takes(number_between(0.25, 4), text)) << text;
  EXPECT_TRUE(takes(positive_number(), "1e-300"));
  for (const char* text : {"0", "-0", "inf", "nan", "-1", "1e999"})
    EXPECT_FALSE(takes(positive_number(), text)) << text;
  EXPECT_TRUE(takes(positive_or_infinite(), "inf"));
  EXPECT_FALSE(takes(positive_or_infinite(), "nan"));
  for (const char* text : {"1", "16384"}) EXPECT_TRUE(takes(whole_number(1, 16384), text)) << text;
  for (const char* text : {"0", "16385", "1.5", "1e3", "99999999999999999999"})
    EXPECT_FALSE(takes(whole_number(1, 16384), text)) << text;
  EXPECT_TRUE(takes(multiple_of(16, 64), "48"));
  for (const char* text : {"0", "17", "80", "-16"}) EXPECT_FALSE(takes(multiple_of(16, 64), text)) << text;
  EXPECT_TRUE(takes(seed_number(), "18446744073709551615"));
  EXPECT_FALSE(takes(seed_number(), "-1"));
  EXPECT_TRUE(takes(file_ending_in({".exr"}), "a.EXR"));
  EXPECT_FALSE(takes(file_ending_in({".exr"}), "exr"));
}

TEST(Usage, AnUnknownWordIsNamedWithTheNearestKnownOne) {
  expect_wrong_use({}, "scenes, render");
  expect_wrong_use({"rendr", "cellar"}, "no command 'rendr'; did you mean 'render'?");
  expect_wrong_use({"frobnicate"}, "no command 'frobnicate' (see");
  expect_wrong_use({"--versoin"}, "no option '--versoin'; did you mean '--version'?");
  expect_wrong_use({"synth", "dir", "--att", "0,0", "-o", "x.exr"}, "no option --att; did you mean '--at'?");
  expect_wrong_use({"scenes", "--jsom=x"}, "no option --jsom; did you mean '--json'?");
  expect_wrong_use({"scenes", "further"}, "further argument 'further'");
  expect_wrong_use({"render", "celar", "-o", "x"}, "no scene 'celar'; did you mean 'cellar'?");
  expect_wrong_use({"sweep", "synthesis", "nope"}, "no scene 'nope'");
  expect_wrong_use({"metric", "--ref", "a.exr", "--test", "b.exr", "--metric", "psrn"},
                   "did you mean 'psnr'?");
  expect_wrong_use({"render", "cellar", "--preset", "quik", "-o", "x"}, "did you mean 'quick'?");
  expect_wrong_use({"reproduce", "altmeier-fig-999"}, "altmeier-fig-999");
}

TEST(Usage, AValueOutOfRangeNamesTheOptionTheValueAndTheRange) {
  const Arguments synth{"synth", "dir", "--at", "0,0", "-o", "x.exr"};
  const auto with = [](Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_wrong_use(with(synth, {"--step", "0"}), "--step: give a number from 0.25 to 4, not '0'");
  expect_wrong_use(with(synth, {"--step", "nan"}), "--step: give a number from 0.25 to 4, not 'nan'");
  expect_wrong_use(with(synth, {"--key-views", "3"}), "--key-views: give 4 or 2 or 1, not '3'");
  expect_wrong_use(with(synth, {"--memory", "0"}),
                   "--memory: give a whole number from 1 to 4194304, not '0'");
  expect_wrong_use(with(synth, {"--threads", "-3"}),
                   "--threads: give a whole number from 0 to 1024, not '-3'");
  expect_wrong_use(with(synth, {"--seed", "-1"}), "--seed: ");
  expect_wrong_use({"synth", "dir", "--at", "0,0", "-o", "x.jpg"},
                   "--out: give a file name that ends in .exr");
  expect_wrong_use({"synth", "dir", "--at"}, "--at needs a value");
  expect_wrong_use(with(synth, {"--at", "1,1"}), "--at can be given only once");
  expect_wrong_use({"render", "cellar", "-o", "x", "--paths", "17"},
                   "--paths: give a multiple of 16 from 16 to 1048576, not '17'");
  expect_wrong_use({"render", "cellar", "-o", ""}, "--out: give a name, not ''");
  expect_wrong_use({"metric", "--ref", "a.exr", "--test", "b.exr", "--exposure", "0"},
                   "--exposure: give a number above 0, not '0'");
  expect_wrong_use({"convert", "dir", "--fov-h", "180", "-o", "x"}, "--fov-h: give a number from ");
  expect_wrong_use({"scenes", "--json", "-", "--csv", "-"}, "--json - and --csv -");
}

TEST(Usage, AValueThatDoesNotFitTheLightFieldIsWrongUseAndLeavesNothing) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), out = folder.path() / "out.exr";
  expect_wrong_use({"synth", field, "--at", "2.5,1", "-o", out},
                   "--at: 2.5,1 is outside the 3×3 grid: S goes from 0 to 2, T from 0 to 2");
  expect_wrong_use({"synth", field, "--at", "1", "-o", out}, "--at: '1' is not a position");
  expect_wrong_use({"synth", field, "--at", "1,1", "--inspect", "48,0", "-o", out}, "--inspect: '48,0'");
  expect_wrong_use({"video", field, "--path", "0,0:3,0", "-o", out}, "--path: ");
  expect_wrong_use({"evaluate", field, "--key-stride", "1"}, "--key-stride: ");
  expect_wrong_use({"evaluate", field, "--key-stride", "3"},
                   "--key-stride: 3 is more than the 3×3 grid allows");
  EXPECT_FALSE(fs::exists(out));
}

TEST(Usage, ACutOutsideTheFramesIsWrongUse) {
  const TemporaryFolder folder;
  const SceneImage frame(4, 3, Rgb{1, 1, 1});
  const fs::path frames = folder.path() / "frames";
  write_exr(frames / "a.exr", frame);
  std::ofstream(frames / ".b.exr") << "left by a killed process";
  expect_wrong_use({"epi", frames, "--row", "3", "-o", "x.png"}, "--row: give a whole number from 0 to 2");
  expect_wrong_use({"epi", frames, "--column", "4", "-o", "x.png"},
                   "--column: give a whole number from 0 to 3");
  expect_wrong_use({"epi", frames, "--column", "0", "--exposure", "1", "-o", "x.exr"}, "--exposure");
  EXPECT_EQ(run_program({"epi", frames, "--column", "3", "-o", folder.path() / "x.png"}).status, 0);
}

TEST(Usage, OptionsThatDoNotApplyAreWrongUse) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field"), out = folder.path() / "out";
  expect_wrong_use({"convert", field, "--spacing-x", "0.2", "-o", out}, "--spacing-x");
  expect_wrong_use({"convert", field, "--linear", "-o", out}, "--linear");
  expect_wrong_use({"video", field, "--path", "0,1:2,1", "--exposure", "2", "-o", out}, "--exposure");
  for (const Arguments& command : {Arguments{"synth", field, "--at", "0,0", "-o", out.string() + ".exr"},
                                   {"video", field, "--path", "0,1:2,1", "-o", out},
                                   {"evaluate", field}}) {
    Arguments depth = command, camera = command;
    depth.insert(depth.end(), {"--screen-depth", "2"});
    camera.insert(camera.end(), {"--camera", "fixed-screen"});
    expect_wrong_use(depth, "--screen-depth is for --camera fixed-screen");
    expect_wrong_use(camera, "needs --screen-depth");
  }
  fs::remove(field / "lightfield.json");
  expect_wrong_use({"convert", field, "-o", out}, "--spacing-x and --fov-h");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(Usage, AMissingOrDamagedFileIsAFailureNotWrongUse) {
  const TemporaryFolder folder;
  const std::string missing = folder.path() / "missing";
  expect_one_clear_sentence(run_program({"info", missing + ".exr"}), missing);
  expect_one_clear_sentence(run_program({"synth", missing, "--at", "0,0", "-o", "x.exr"}), missing);
  expect_one_clear_sentence(run_program({"sweep", "synthesis", missing}), missing);
  expect_one_clear_sentence(run_program({"epi", missing, "--row", "0", "-o", "x.png"}), missing);
  std::ofstream(missing + ".exr") << "not an EXR";
  expect_one_clear_sentence(run_program({"info", missing + ".exr"}), missing);
}

}  // namespace
}  // namespace plenolab
