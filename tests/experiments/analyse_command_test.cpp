#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/psychophysics/planning.h"
#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

/// The value of the first row of a quantity in JSON results; NaN if there is none.
double value_of(const std::string& json, const std::string& quantity) {
  const nlohmann::json parsed = nlohmann::json::parse(json);
  for (const auto& row : parsed.at("rows"))
    if (row.at("quantity") == quantity) return row.at("value");
  return std::nan("");
}

double run_for(Arguments arguments, const std::string& quantity) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? value_of(result.out, quantity) : std::nan("");
}

class Analyse : public testing::Test {
 protected:
  fs::path written(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  }
  TemporaryFolder folder_;
};

TEST_F(Analyse, EverySubcommandExplainsItselfWithAnExample) {
  for (const std::string name : {"critical", "table", "psychometric", "welch", "dprime", "plan"}) {
    const ProgramResult result = run_program({"analyse", name, "--help"});
    EXPECT_EQ(result.status, 0) << name;
    EXPECT_NE(result.out.find("Example: plenolab analyse " + name), std::string::npos) << name;
  }
}

TEST_F(Analyse, GivesThePublishedNumbers) {
  EXPECT_EQ(run_for({"analyse", "critical", "--trials", "34"}, "critical_number"), 11);
  EXPECT_EQ(run_for({"analyse", "critical", "--trials", "100"}, "critical_number"), 27);
  EXPECT_NEAR(run_for({"analyse", "welch", "--first", "0.1870,0.1577,1000", "--second", "0.0184,0.0027,1000"},
                      "log10_p"),
              -166.9, 0.05);
  EXPECT_EQ(run_for({"analyse", "plan", "--true-rate", "0.35", "--power", "0.8"}, "trials_stable"), 53);
  EXPECT_NEAR(run_for({"analyse", "dprime", "--correct", "60,100", "--raw"}, "dprime"), 0.358286909243,
              1e-11);
}

TEST_F(Analyse, TableOfCountsSaysWhatPassingMeansAndDrawsIt) {
  const fs::path counts =
      written("counts.csv", "display,image,n,k,verdict\nm,1,34,12,PASSED\nm,5,34,6,PASSED\n");
  const ProgramResult result =
      run_program({"analyse", "table", counts, "--plot", folder_.path() / "choices"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("m 1: passed: 12 of 34 reach 11"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("Printed: PASSED, which the count contradicts."), std::string::npos);
  EXPECT_NE(result.out.find("no count of 34 trials could show"), std::string::npos);
  EXPECT_EQ(result.out.find("indistinguishable"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_.path() / "choices.svg"));
}

TEST_F(Analyse, FewerCorrectAnswersThanGuessingGivesAreNamedAsSuch) {
  const ProgramResult below = run_program({"analyse", "dprime", "--correct", "10,34"});
  EXPECT_NE(below.out.find("10 of 34 correct are fewer than guessing gives"), std::string::npos) << below.out;
  const ProgramResult above = run_program({"analyse", "dprime", "--correct", "17,34"});
  EXPECT_EQ(above.out.find("Careful"), std::string::npos) << above.out;
}

TEST_F(Analyse, APreferredSideIsNotTakenForLapsesWithoutSayingSo) {
  const std::string header =
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused\n";
  // Either everybody takes the left image always (the test image lies left in every second trial), or one
  // catch trial of two is wrong, as often on either side.
  const auto table_where = [&](bool left_always) {
    std::string text = header;
    for (int p = 0; p < 20; ++p)
      for (int t = 1; t <= 4; ++t)
        text += fmt::format("p{},real,b,1,m,o,{},{},{},{},{},2,1,1,1,0\n", p, t, t <= 2 ? "easy" : "image 1",
                            t <= 2 ? 1 : 0, t % 2, left_always ? t % 2 : (t == 1 + p % 2 ? 1 : 0));
    return run_program({"analyse", "table", written("trials.csv", text)}).out;
  };
  EXPECT_NE(table_where(true).find("Who prefers a side errs in catch trials too"), std::string::npos)
      << table_where(true);
  EXPECT_EQ(table_where(false).find("Who prefers a side"), std::string::npos) << table_where(false);
}

TEST_F(Analyse, PowerIsToldForEachNumberOfTrials) {
  const fs::path counts = written("counts.csv", "display,image,n,k\nm,1,34,12\nm,2,100,40\nm,3,34,6\n");
  const ProgramResult result = run_program({"analyse", "table", counts, "--true-rate", "0.35"});
  const auto told = [&](int trials, double power) {
    return result.out.find(
        fmt::format("Power of {} trials: an image whose true rate is 0.35 passes with probability {:.3f}.",
                    trials, power));
  };
  const std::size_t first = told(34, test_power(34, 0.19, 0.35));
  ASSERT_NE(first, std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("Power of 34", first + 1), std::string::npos);
  EXPECT_NE(told(100, test_power(100, 0.19, 0.35)), std::string::npos) << result.out;
}

TEST_F(Analyse, TrialsOfOtherModesDoNotCountUnlessAskedFor) {
  const fs::path trials = written(
      "trials.csv",
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused\r\n"
      "P1,real,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\r\n"
      "P2,simulated,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\r\n");
  EXPECT_EQ(run_for({"analyse", "table", trials}, "trials"), 1);
  EXPECT_EQ(run_for({"analyse", "table", trials, "--mode", "all"}, "trials"), 2);
  EXPECT_EQ(run_for({"analyse", "table", trials}, "observer_left_rate"), 1);
  expect_one_clear_sentence(run_program({"analyse", "table", trials, "--mode", "pilot"}),
                            "no trial is of mode 'pilot'");
}

TEST_F(Analyse, TrialsTellWhetherParticipantsDifferGivenTheImages) {
  std::string text =
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused\n";
  for (int p = 0; p < 40; ++p)
    for (int i = 0; i < 4; ++i)  // odd participants see nothing in images 1 and 3, even ones see all
      text += fmt::format("P{},real,b1,1,monitor,ab,{},{},0,{},{},2.5,1,1,1,0\n", p, i + 1, i, p / 2 % 2,
                          p % 2 * (i % 2));
  const fs::path trials = written("trials.csv", text);
  EXPECT_LT(run_for({"analyse", "table", trials}, "participant_effect_p"), 0.01);
  EXPECT_EQ(run_for({"analyse", "table", trials}, "participant_correlation"), 1);
  EXPECT_TRUE(std::isnan(run_for({"analyse", "table", trials}, "overdispersion")));
  const ProgramResult result = run_program({"analyse", "table", trials});
  EXPECT_NE(result.out.find("monitor: participants differ"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("several trials of one image"), std::string::npos);
}

TEST_F(Analyse, WhatIsResampledOfATableFollowsTheSeed) {
  std::string text =
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused\n";
  for (int p = 0; p < 30; ++p)
    for (int i = 0; i < 2; ++i)
      text += fmt::format("P{},real,b1,1,monitor,ab,{},{},0,{},{},2.5,1,1,1,0\n", p, i + 1, i, p / 4 % 2,
                          (i == 0 ? p : p / 2) % 2);
  const fs::path trials = written("trials.csv", text);
  const auto p_with = [&](const std::string& seed) {
    return run_for({"analyse", "table", trials, "--seed", seed}, "participant_effect_p");
  };
  EXPECT_EQ(p_with("7"), p_with("7"));
  EXPECT_NE(p_with("7"), p_with("8"));
}

TEST_F(Analyse, FitsLevelsAndSaysWhenTheyDetermineNothing) {
  const fs::path good = written("good.csv", "x,n,k\n1,40,20\n2,40,25\n3,40,33\n4,40,39\n5,40,40\n");
  EXPECT_EQ(run_for({"analyse", "psychometric", good, "--resamples", "100"}, "determined"), 1);
  const fs::path step = written("step.csv", "x,n,k\n1,40,0\n2,40,40\n");
  const ProgramResult result = run_program({"analyse", "psychometric", step, "--guess", "0"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("a step fits as well"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("threshold  "), std::string::npos);
}

TEST_F(Analyse, ValuesOfFramesGetABlockBootstrapToo) {
  std::string text = "frame,seconds\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(i) + "," + std::to_string(0.01 * (i % 7) + 1) + "\n";
  const fs::path frames = written("frames.csv", text);
  EXPECT_LT(run_for({"analyse", "welch", "--first", frames, "--second", frames, "--column", "seconds"},
                    "block_bootstrap_low"),
            0);
  expect_one_clear_sentence(run_program({"analyse", "welch", "--first", frames, "--second", frames}),
                            "--column", 2);
}

TEST_F(Analyse, WrongUseAndBadFilesGiveOneSentence) {
  const auto wrong = [](const Arguments& arguments, const std::string& mentions) {
    SCOPED_TRACE(mentions);
    expect_one_clear_sentence(run_program(arguments), mentions, 2);
  };
  wrong({"analyse"}, "give one of critical, table");
  wrong({"analyse", "tabel"}, "'plenolab analyse' has no 'tabel'; did you mean 'table'?");
  wrong({"analyse", "critical", "--trails", "3"},
        "'plenolab analyse critical' has no option --trails; did you");
  wrong({"analyse", "critical", "--trials", "0"}, "--trials");
  wrong({"analyse", "critical", "--trials", "34", "--true-rate", "2"}, "--true-rate");
  wrong({"analyse", "plan", "--true-rate", "0.1"}, "must be above the tested --rate");
  wrong({"analyse", "dprime"}, "--correct");
  wrong({"analyse", "dprime", "--correct", "5,4"}, "--correct: give K,N");
  wrong({"analyse", "welch", "--first", "1,2,1.5", "--second", "1,2,3"}, "--first: N must be a whole number");
  const fs::path bad = written("bad.csv", "display,image,n,k\nm,1,34,35\n");
  expect_one_clear_sentence(run_program({"analyse", "table", bad}), "line 2: 'k' must be a whole number");
  wrong({"analyse", "table", written("c.csv", "display,image,n,k\nm,1,34,3\n"), "--mode", "real"}, "--mode");
  expect_one_clear_sentence(run_program({"analyse", "table", folder_.path() / "none.csv"}), "none.csv");
}

}  // namespace
}  // namespace plenolab
