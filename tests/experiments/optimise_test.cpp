#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/optimise/tone_optimiser.h"
#include "experiments/sweep_optimise.h"
#include "tests/experiments/plane_field.h"
#include "tests/experiments/run_program.h"

namespace plenolab {
namespace {

/// Bright and dark halves with detail in both.
SceneImage two_halves(int width = 64, int height = 40) {
  SceneImage scene(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      scene.at(x, y) = Rgb{1, 0.9f, 0.8f} * static_cast<float>((x < width / 2 ? 0.5 : 800) *
                                                               (1.5 + std::sin(0.7 * x) * std::cos(0.5 * y)));
  return scene;
}

ToneOptimisationOptions short_search(int shrink = 1) {
  ToneOptimisationOptions options;
  options.shrink = shrink;
  options.evolution.children = 4;
  options.evolution.most_iterations = 4;
  return options;
}

TEST(ToneOptimiser, IsNeverWorseThanTheStartAtTheSizeOfTheSearch) {
  for (const char* quantity : {"feature_photographic", "feature_content_adaptive", "tmqi"}) {
    ToneOptimisationOptions options = short_search();
    options.quantity = quantity;
    const ToneOptimisation found = optimise_tones(two_halves(), {}, options);
    const bool higher = std::string(quantity) == "tmqi";
    EXPECT_GE(higher ? found.best_value : -found.best_value, higher ? found.start_value : -found.start_value)
        << quantity;
    // Full size is the size of the search here: the trace's last cost is the value of the result.
    EXPECT_NEAR(higher ? -found.evolution.score : found.evolution.score, found.best_value, 1e-9) << quantity;
    EXPECT_NO_THROW(found.best.validate());
  }
}

TEST(ToneOptimiser, IsTheSameForAnyNumberOfThreadsAndDiffersBySeed) {
  const auto run = [](int threads, std::uint64_t seed) {
    ToneOptimisationOptions options = short_search(2);
    options.evolution.seed = seed;
    ComparisonConditions conditions;
    conditions.threads = threads;
    return optimise_tones(two_halves(), conditions, options);
  };
  const ToneOptimisation one = run(1, 5), three = run(3, 5);
  EXPECT_EQ(one.evolution.best, three.evolution.best);
  EXPECT_EQ(one.best_value, three.best_value);
  for (std::size_t i = 0; i < one.image.size(); ++i)
    ASSERT_EQ(one.image.pixels()[i], three.image.pixels()[i]);
  EXPECT_NE(one.evolution.best, run(1, 6).evolution.best);
}

TEST(ToneOptimiser, AppliesTheBandsOfTheSearchToTheFullImage) {
  const ToneOptimisation found = optimise_tones(two_halves(), {}, short_search(4));
  EXPECT_EQ(found.best.band_scale, 4);
  EXPECT_EQ(found.image.width(), 64);
}

TEST(ToneOptimiser, CopesWithBlackConstantTinyAndDamagedImages) {
  SceneImage damaged = two_halves(9, 7);
  damaged.at(0, 0) = {NAN, INFINITY, -1};
  const std::vector<SceneImage> images{SceneImage(16, 12), SceneImage(16, 12, Rgb{5, 5, 5}),
                                       SceneImage(1, 1, Rgb{1, 2, 3}), damaged};
  for (std::size_t i = 0; i < images.size(); ++i)
    for (const int shrink : {1, 64}) {
      const ToneOptimisation found = optimise_tones(images[i], {}, short_search(shrink));
      EXPECT_TRUE(std::isfinite(found.best_value)) << i;
      for (const Rgb& c : found.image.pixels())
        ASSERT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1) << i;
    }
}

TEST(ToneOptimiser, BlocksAreAveragedAndBordersKeepTheirOwn) {
  SceneImage image(3, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) image.at(x, y) = Rgb{1, 1, 1} * static_cast<float>(x + 10 * y);
  const SceneImage small = averaged_down(image, 2);
  ASSERT_EQ(small.width(), 2);
  ASSERT_EQ(small.height(), 1);
  EXPECT_FLOAT_EQ(small.at(0, 0).g, 5.5f);
  EXPECT_FLOAT_EQ(small.at(1, 0).g, 7);
}

/// A few bright grains on fine texture: blocks average both away.
SceneImage grains() {
  SceneImage scene(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      scene.at(x, y) = Rgb{1, 1, 1} *
                       static_cast<float>(
                           x % 8 == 0 && y % 8 == 0 ? 5000 : 1 + 0.5 * std::sin(2.5 * x) * std::sin(2.7 * y));
  return scene;
}

TEST(ToneOptimiser, IsNeverWorseThanTheStartAtFullSizeEither) {
  int kept = 0;
  for (const char* quantity : {"feature_photographic", "tmqi", "feature_content_adaptive"}) {
    ToneOptimisationOptions options = short_search(4);
    options.quantity = quantity;
    const Objective objective = describe_objective(quantity);
    const ToneOptimisation found = optimise_tones(grains(), {}, options);
    EXPECT_LE(objective.cost(found.best_value), objective.cost(found.start_value)) << quantity;
    EXPECT_EQ(found.start_kept, objective.cost(found.found_value) > objective.cost(found.start_value));
    if (found.start_kept) {
      EXPECT_EQ(parameters_of(found.best), parameters_of({}));
    }
    kept += found.start_kept;
  }
  EXPECT_GT(kept, 0) << "no example of a search on the smaller image that leads astray";
}

TEST(ToneOptimiser, RefusesToShrinkBelowOnePixelPerDegree) {
  ToneOptimisationOptions options = short_search(32);
  options.quantity = "drim_mean_total";
  EXPECT_THROW(optimise_tones(two_halves(), {}, options), InputError);
}

TEST(ToneOptimiser, ParametersAndOptionsAreTheSameThing) {
  const std::vector<double> parameters{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  EXPECT_EQ(parameters_of(generic_options(parameters)), parameters);
}

TEST(ToneOptimiser, SaysWhatIsOutOfRange) {
  ToneOptimisationOptions options = short_search(0);
  EXPECT_THROW(optimise_tones(two_halves(), {}, options), InputError);
  options = short_search();
  options.quantity = "beauty";
  EXPECT_THROW(optimise_tones(two_halves(), {}, options), InputError);
  EXPECT_THROW(generic_options(std::vector<double>{1, 2}), std::logic_error);
}

TEST(OptimiseSweep, HasNoErrorAtTheBestAndMoreWithoutSearch) {
  SweepImage image{"halves", {}};
  image.view.colour = std::make_shared<const SceneImage>(two_halves());
  const ResultTable table =
      sweep_optimise(image, 1, "feature_photographic", {{1, 4, 0}, {1, 4, 3}, {2, 2, 2}}, {.runs = 1});
  std::vector<double> errors;
  for (const ResultRow& row : table.rows())
    if (row.quantity == "objective_excess") errors.push_back(row.value);
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_EQ(*std::min_element(errors.begin(), errors.end()), 0);
  EXPECT_GT(errors[0], errors[1]) << "the start is worse than what a search at full size finds";
}

TEST(OptimiseSweep, TakesTheMedianOfSeveralSeeds) {
  SweepImage image{"halves", {}};
  image.view.colour = std::make_shared<const SceneImage>(two_halves());
  const auto rows = [&](std::uint64_t seed) {
    std::map<std::string, double> values;
    const ResultTable table =
        sweep_optimise(image, 1, "feature_photographic", {{1, 3, 3}}, {.runs = 3, .seed = seed});
    for (const ResultRow& row : table.rows()) values[row.quantity] = row.value;
    return values;
  };
  auto first = rows(1), other = rows(50);
  EXPECT_LT(first["objective_best"], first["objective"]);
  EXPECT_LT(first["objective"], first["objective_worst"]);
  EXPECT_NE(first["objective"], other["objective"]);
}

class OptimiseCommand : public testing::Test {
 protected:
  void SetUp() override { write_scene_image(scene_, two_halves(), 100); }
  ProgramResult run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"optimise",   scene_, "-o",           out_,
                                       "--children", "3",    "--iterations", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  TemporaryFolder folder_;
  std::string scene_ = (folder_.path() / "scene.exr").string(), out_ = (folder_.path() / "out.png").string();
};

TEST_F(OptimiseCommand, WritesImageTraceAndPlotAndSaysTheSettings) {
  const std::string trace = (folder_.path() / "trace.csv").string(),
                    plot = (folder_.path() / "plot").string();
  const ProgramResult result = run({"--shrink", "2", "--trace", trace, "--plot", plot});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const std::string& file : {out_, out_ + ".run.json", trace, plot + ".svg"})
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_NE(read_text_file(trace).find("parameter_d_l"), std::string::npos);
  EXPECT_NE(result.out.find("--set scale=2"), std::string::npos) << result.out;
}

TEST_F(OptimiseCommand, ItsSettingsGiveTheSameImageByTonemap) {
  const ProgramResult result = run({"--shrink", "2"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::vector<std::string> arguments{"tonemap",    scene_,   "-o", (folder_.path() / "again.png").string(),
                                     "--operator", "generic"};
  std::istringstream words(result.out.substr(result.out.find("--set")));
  for (std::string word; words >> word;) arguments.push_back(word);
  const ProgramResult again = run_program(arguments);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(read_text_file(out_) == read_text_file(folder_.path() / "again.png"));
}

TEST_F(OptimiseCommand, RefusesWrongUseInOneSentence) {
  for (const auto& [words, hint] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--metric", "feature_photografic"}, "did you mean"},
           {{"--shrink", "0"}, "--shrink"},
           {{"--children", "0"}, "--children"},
           {{"--deviation", "-1"}, "--deviation"}}) {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.status, 2) << hint;
    EXPECT_NE(result.err.find(hint), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(OptimiseCommand, WritesNoPictureWhereItsTraceCannotBeWritten) {
  const ProgramResult result = run({"--trace", "/proc/trace.csv"});
  expect_one_clear_sentence(result, "cannot write /proc/trace.csv");
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(OptimiseCommand, TellsOfRepairsAndQuotesNamesForTheShell) {
  scene_ = (folder_.path() / "it's a scene.exr").string();
  SceneImage damaged = two_halves();
  damaged.at(3, 3).r = -1;
  write_scene_image(scene_, damaged, 100);
  const ProgramResult result = run({});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 values of the image were NaN"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("/it'\\''s a scene.exr' -o"), std::string::npos) << result.out;
}

TEST_F(OptimiseCommand, NeedsTheScaleOfAbsoluteLuminanceOnlyWhereItMatters) {
  write_scene_image(scene_, two_halves());
  const ProgramResult unknown = run({});
  expect_one_clear_sentence(unknown, "--cd-m2-per-unit: feature_content_adaptive needs the luminance", 2);
  EXPECT_FALSE(std::filesystem::exists(out_));
  for (const auto& words : std::vector<std::vector<std::string>>{{"--cd-m2-per-unit", "100"},
                                                                 {"--metric", "feature_photographic"}}) {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.status, 0) << result.err;
  }
}

TEST_F(OptimiseCommand, PicturesAreJudgedAsTheyAreLookedAt) {
  const auto drim = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--metric", "drim_mean_total"});
    const ProgramResult result = run(more);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out.substr(0, result.out.find("seconds_search"));
  };
  EXPECT_NE(drim({}), drim({"--pixels-per-degree", "5", "--display-black", "20"}));
  expect_one_clear_sentence(run({"--pixels-per-degree", "5"}), "does not depend on them", 2);
}

}  // namespace
}  // namespace plenolab
