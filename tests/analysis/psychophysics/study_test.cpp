// From files of counts and trials to the table of a study.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/psychophysics/dprime.h"
#include "analysis/psychophysics/study_table.h"
#include "core/base/error.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

std::vector<StudyCount> counts_from(const std::string& text) {
  return parse_study_counts(parse_csv(text, "counts.csv"));
}

std::vector<StudyTrial> trials_from(const std::string& rows) {
  return parse_study_trials(parse_csv(
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused\n" +
          rows,
      "trials.csv"));
}

const std::string kTable51 =
    "display,image,n,k,verdict\n"
    "light-field,1,34,12,PASSED\nlight-field,2,34,21,PASSED\nlight-field,3,34,16,PASSED\n"
    "light-field,4,34,15,PASSED\nlight-field,5,34,6,FAILED\n"
    "monitor,1,34,19,PASSED\nmonitor,2,34,18,PASSED\nmonitor,3,34,11,PASSED\n"
    "monitor,4,34,16,PASSED\nmonitor,5,34,6,FAILED\n";

TEST(Csv, ReadsQuotesLineBreaksAndByteOrderMarks) {
  const CsvTable table = parse_csv(
      "\xEF\xBB\xBF"
      "a,b\r\n\"x, \"\"y\"\"\",\"1\n2\"\r\n,3\n",
      "t.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].fields, (std::vector<std::string>{"x, \"y\"", "1\n2"}));
  EXPECT_EQ(table.rows[1].line, 4);
}

TEST(Csv, RefusesWhatIsNotPlainlyRightWithItsLine) {
  const auto message = [](const std::string& text) { return message_of([&] { parse_csv(text, "t.csv"); }); };
  EXPECT_EQ(message("a,b\n1\n"), "t.csv, line 2: 1 fields instead of the 2 that the header names");
  EXPECT_EQ(message("a,a\n1,2\n"), "t.csv, line 1: two columns are called 'a'");
  EXPECT_EQ(message("a,\n1,2\n"), "t.csv, line 1: a column has no name");
  EXPECT_EQ(message("a,b\n1,2\n\n3,4\n"), "t.csv, line 3: the line is empty");
  EXPECT_EQ(message("a\n\"1\n"), "t.csv, line 3: a quote is never closed");
  EXPECT_EQ(message("a\n1\"2\n"), "t.csv, line 2: a quote stands in the middle of a field");
  EXPECT_EQ(message("a\n\"1\"2\n"), "t.csv, line 2: something stands behind a closing quote");
  EXPECT_EQ(message("a\n1\r2\n"), "t.csv, line 2: a carriage return stands in the middle of a line");
  EXPECT_EQ(message(""), "t.csv holds no rows below a header line");
  EXPECT_EQ(message("a,b\n"), "t.csv holds no rows below a header line");
  EXPECT_EQ(message(std::string("a\n\0", 3)), "t.csv, line 1: holds a NUL character: it is not a text file");
}

TEST(StudyCounts, RefuseFieldsThatCannotBe) {
  const auto message = [](const std::string& rows) {
    return message_of([&] { counts_from("display,image,n,k\n" + rows); });
  };
  EXPECT_EQ(message("m,1,34,35\n"), "counts.csv, line 2: 'k' must be a whole number from 0 to 34, not '35'");
  EXPECT_EQ(message("m,1,34,1.5\n"),
            "counts.csv, line 2: 'k' must be a whole number from 0 to 34, not '1.5'");
  EXPECT_EQ(message("m,1,0,0\n"),
            "counts.csv, line 2: 'n' must be a whole number from 1 to 1000000000, not '0'");
  EXPECT_EQ(message("m,,34,3\n"), "counts.csv, line 2: 'image' is empty");
  EXPECT_EQ(message("m,1,34,3\nm,1,34,4\n"), "counts.csv, line 3: image '1' on 'm' stands already in line 2");
  EXPECT_EQ(message_of([] { counts_from("display,image,n\nm,1,34\n"); }),
            "counts.csv has no column 'k': it has display, image, n");
  EXPECT_EQ(message_of([] { counts_from("display,image,n,k,verdict\nm,1,34,3,passed?\n"); }),
            "counts.csv, line 2: 'verdict' must be one of PASSED, FAILED, not 'passed?'");
}

TEST(StudyTrials, ImagesOfATrialFileAreListedByNameAndNotAsSomebodySawThem) {
  const auto counts =
      count_choices(trials_from("p1,real,b,1,monitor,o,1,image 10,0,1,1,2,1,1,1,0\n"
                                "p1,real,b,1,monitor,o,2,image 2,0,1,1,2,1,1,1,0\n"
                                "p1,real,c,2,glasses,o,1,image 02,0,1,1,2,1,1,1,0\n"
                                "p1,real,b,1,monitor,o,3,image 1,0,1,1,2,1,1,1,0\n"
                                "p1,real,b,1,monitor,o,4,image,0,1,1,2,1,1,1,0\n"
                                "p1,real,c,2,glasses,o,2,image 2,0,1,1,2,1,1,1,0\n"));
  std::vector<std::string> names;
  for (const StudyCount& count : counts) names.push_back(count.display + "/" + count.image);
  EXPECT_EQ(names, (std::vector<std::string>{"glasses/image 02", "glasses/image 2", "monitor/image",
                                             "monitor/image 1", "monitor/image 2", "monitor/image 10"}));
}

TEST(StudyTrials, AreCountedWithoutCatchTrials) {
  const auto trials = trials_from(
      "P1,real,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\n"
      "P1,real,b1,1,monitor,ab,2,cave,1,0,1,2.5,1,1,1,0\n"
      "P2,real,b1,1,monitor,ab,1,cave,0,0,0,2.5,1,1,1,0\n"
      "P2,pilot,b2,2,light-field,ab,1,cave,0,0,1,2.5,1,1,1,0\n");
  const auto counts = count_choices(trials_of_mode(trials, TrialMode::kReal));
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0].chose_test.hits, 1);
  EXPECT_EQ(counts[0].chose_test.trials, 2);
  EXPECT_EQ(counts[0].participants, 2);
  EXPECT_EQ(count_choices(trials).size(), 2u);
  EXPECT_EQ(message_of([&] { trials_of_mode(trials, TrialMode::kSimulated); }),
            "no trial is of mode 'simulated': there are trials of mode pilot, real");
}

TEST(StudyTrials, RefuseATrialThatAParticipantHasTwice) {
  EXPECT_EQ(message_of([] {
              trials_from(
                  "P1,real,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\n"
                  "P1,real,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\n");
            }),
            "trials.csv, line 3: participant 'P1' has trial 1 of block 'b1' already in line 2");
  EXPECT_EQ(message_of([] { trials_from("P1,reel,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\n"); }),
            "trials.csv, line 2: 'mode' must be one of real, pilot, simulated, not 'reel'");
  EXPECT_EQ(message_of([] { trials_from("P1,real,b1,1,monitor,ab,1,cave,0,1,2,nan,1,1,1,0\n"); }),
            "trials.csv, line 2: 'chose_test' must be 0 or 1, not '2'");
  EXPECT_EQ(message_of([] { trials_from("P1,real,b1,1,monitor,ab,1,cave,0,1,1,nan,1,1,1,0\n"); }),
            "trials.csv, line 2: 'response_s' must be a number from 0 to 86400, not 'nan'");
}

TEST(Observer, SideAndLapsesFollowFromWhatWasChosen) {
  // Left is chosen when the test lies left and is chosen, or lies right and is not.
  const auto trials = trials_from(
      "P1,real,b1,1,monitor,ab,1,cave,0,1,1,2.5,1,1,1,0\n"
      "P1,real,b1,1,monitor,ab,2,cave,0,0,0,2.5,1,1,1,0\n"
      "P1,real,b1,1,monitor,ab,3,cave,1,1,0,2.5,1,1,1,0\n"
      "P1,real,b1,1,monitor,ab,4,cave,1,0,1,2.5,1,1,1,0\n");
  const auto bias = position_bias(trials);
  ASSERT_TRUE(bias);
  EXPECT_EQ(bias->left.count.hits, 2);
  EXPECT_EQ(bias->p_value, 1);
  const auto lapse = lapse_rate(trials);
  ASSERT_TRUE(lapse);
  EXPECT_EQ(lapse->wrong.count.trials, 2);
  EXPECT_EQ(lapse->lapse.estimate, 1);
  EXPECT_LE(lapse->lapse.high, 1);
  EXPECT_FALSE(position_bias({}));
  EXPECT_FALSE(lapse_rate({trials[0]}));
}

TEST(StudyTable, RecomputesThePrintedVerdictsOfTable51) {
  const Study study = analyse_counts(counts_from(kTable51));
  for (const StudyRow& row : study.rows) {
    EXPECT_EQ(row.critical, 11);
    EXPECT_EQ(row.passed, row.count.printed_verdict == "PASSED") << row.count.display << row.count.image;
    EXPECT_FALSE(row.equivalent());
  }
  EXPECT_NEAR(study.any_false_pass, 0.368783361003846, 1e-12);
}

TEST(StudyTable, SaysIndistinguishableOnlyAfterAnEquivalenceTest) {
  for (const std::int64_t n : {1, 34, 40, 100, 1000})
    for (const double margin : {0.05, 0.15, 0.3})
      for (std::int64_t k = 0; k <= n; k += std::max<std::int64_t>(1, n / 50)) {
        StudyOptions options;
        options.equivalence.margin = margin;
        const StudyRow row = analyse_counts({{"d", "i", {k, n}, 0, ""}}, options).rows[0];
        const bool says = verdict_text(row, options).find("indistinguishable") != std::string::npos;
        EXPECT_EQ(says, equivalence_p({k, n}, options.equivalence) < 0.05) << k << " of " << n;
      }
}

TEST(StudyTable, SaysWhenNoCountCouldShowEquivalenceOrPass) {
  const Study study = analyse_counts(counts_from(kTable51));
  EXPECT_EQ(
      verdict_text(study.rows[1], study.options),
      "passed: 21 of 34 reach 11, so the rate is above 0.19 (p = 4.96e-08); no count of 34 trials could "
      "show that the rate lies within 0.5 ± 0.15.");
  StudyOptions strict;
  strict.p_null = 0.9;
  const Study hopeless = analyse_counts({{"d", "i", {3, 3}, 0, ""}}, strict);
  EXPECT_FALSE(hopeless.rows[0].passed);
  EXPECT_FALSE(std::signbit(hopeless.any_false_pass));
  EXPECT_TRUE(verdict_text(hopeless.rows[0], strict).starts_with("failed: no count of 3 trials"));
}

/// How answers to image b go with those to image a.
enum class Likeness { kAlike, kDiffer };

/// `people` participants see images a and b once on one display, and every second of them takes the test
/// image for the reference: of b those who took a's and those who did not as often, or the same people.
/// Each has `catches` catch trials, of which the first `wrong` people fail one.
std::vector<StudyTrial> guessers(int people, int catches, int wrong, Likeness likeness = Likeness::kAlike) {
  std::vector<StudyTrial> trials;
  for (int p = 0; p < people; ++p) {
    StudyTrial trial;
    trial.participant = fmt::format("P{}", p);
    trial.mode = "real";
    trial.block = "b1";
    trial.display = "monitor";
    for (const std::string image : {"a", "b"}) {
      trial.image = image;
      trial.test_first = p % 8 < 4;
      trial.chose_test = (image == "b" && likeness == Likeness::kAlike ? p / 2 : p) % 2 == 0;
      trials.push_back(trial);
      ++trial.trial;
    }
    trial.is_catch = true;
    for (int c = 0; c < catches; ++c, ++trial.trial) {
      trial.chose_test = p < wrong && c == 0;
      trials.push_back(trial);
    }
  }
  return trials;
}

std::string equivalence_of_first(const std::vector<StudyTrial>& trials, const StudyOptions& options = {}) {
  const Study study = analyse_trials(trials, options);
  return equivalence_text(study.rows[0], options.equivalence);
}

TEST(StudyTable, CallsImagesIndistinguishableWhereEveryCatchTrialWasRight) {
  EXPECT_TRUE(equivalence_of_first(guessers(200, 1, 0)).starts_with("indistinguishable within 0.5 ± 0.15"));
}

TEST(StudyTable, WithholdsIndistinguishableWhereNobodyIsKnownToHaveLooked) {
  const std::string without = equivalence_of_first(guessers(200, 0, 0));
  EXPECT_EQ(without.find("indistinguishable"), std::string::npos) << without;
  EXPECT_TRUE(without.ends_with("but there were no catch trials, so nobody is known to have looked"));
  const std::string half = equivalence_of_first(guessers(200, 1, 100));
  EXPECT_EQ(half.find("indistinguishable"), std::string::npos) << half;
  EXPECT_NE(half.find("but 100 of 200 catch trials were wrong"), std::string::npos) << half;
}

TEST(StudyTable, WithholdsIndistinguishableWhereParticipantsDiffer) {
  const Study study = analyse_trials(guessers(200, 1, 0, Likeness::kDiffer));
  ASSERT_LT(study.observers[0].participants->p_value, study.options.alpha);
  for (const StudyRow& row : study.rows) {
    EXPECT_LT(row.equivalence_p_holm, study.options.alpha);
    EXPECT_FALSE(row.indistinguishable(study.options.equivalence));
    const std::string text = equivalence_text(row, study.options.equivalence);
    EXPECT_NE(text.find("but only on average: participants differ on this display"), std::string::npos)
        << text;
  }
}

TEST(StudyTable, ParticipantsWhoDifferOnOneDisplayCastNoDoubtOnAnother) {
  std::vector<StudyTrial> trials = guessers(200, 1, 0);
  for (StudyTrial trial : guessers(200, 1, 0, Likeness::kDiffer)) {
    trial.display = "light-field";
    trial.block = "b2";
    trials.push_back(trial);
  }
  const Study study = analyse_trials(trials);
  for (const StudyRow& row : study.rows)
    EXPECT_EQ(row.indistinguishable(study.options.equivalence), row.count.display == "monitor")
        << row.count.display << row.withheld;
}

TEST(StudyTable, TheSeedIsThatOfTheResampling) {
  const std::vector<StudyTrial> trials = guessers(30, 1, 0);
  const auto effect = [&](std::uint64_t seed) {
    StudyOptions options;
    options.seed = seed;
    return analyse_trials(trials, options).observers[0].participants.value();
  };
  EXPECT_EQ(effect(7).p_value, effect(7).p_value);
  EXPECT_NE(effect(7).p_value, effect(8).p_value);
  EXPECT_EQ(effect(7).correlation.estimate, effect(8).correlation.estimate);
}

TEST(StudyTable, TheLimitOfLapsesIsTheOneStated) {
  const std::vector<StudyTrial> trials = guessers(200, 1, 4);
  const double high = lapse_rate(trials)->lapse.high;
  StudyOptions options;
  options.most_lapses = high;
  EXPECT_TRUE(equivalence_of_first(trials, options).starts_with("indistinguishable"));
  options.most_lapses = high - 1e-9;
  EXPECT_FALSE(equivalence_of_first(trials, options).starts_with("indistinguishable"));
}

TEST(StudyTable, WithholdsIndistinguishableWhereParticipantsRepeatAnImage) {
  std::vector<StudyTrial> trials = guessers(200, 1, 0);
  for (StudyTrial& trial : trials)
    trial.participant = fmt::format("P{}", std::stoi(trial.participant.substr(1)) / 10);
  const std::string text = equivalence_of_first(trials);
  EXPECT_TRUE(text.ends_with("but participants have several trials of the image, which are not independent"))
      << text;
}

TEST(StudyTable, OverdispersionIsThatOfOneImageAndOnlyWhereItIsRepeated) {
  const auto repeated_by = [](int tenth) {
    std::vector<StudyTrial> trials = guessers(200, 1, 0, Likeness::kDiffer);
    for (StudyTrial& trial : trials)
      trial.participant = fmt::format("P{}", std::stoi(trial.participant.substr(1)) % tenth);
    return analyse_trials(trials);
  };
  const auto overdispersion_rows = [](const Study& study) {
    const ResultTable table = study_table(study);
    return std::count_if(table.rows().begin(), table.rows().end(),
                         [](const ResultRow& row) { return row.quantity == "overdispersion"; });
  };
  const Study once = repeated_by(200), often = repeated_by(20);
  EXPECT_FALSE(once.rows[0].repeats);
  EXPECT_EQ(overdispersion_rows(once), 0);
  // Of 20 participants with ten trials of an image each, every second always takes the test image.
  ASSERT_TRUE(often.rows[0].repeats);
  EXPECT_EQ(overdispersion_rows(often), 2);
  EXPECT_GT(often.rows[0].repeats->fit.overdispersion.low, 0.9);
  EXPECT_NEAR(often.rows[0].repeats->fit.design_effect, 10, 0.1);
  ASSERT_TRUE(once.observers[0].participants);
  EXPECT_LT(once.observers[0].participants->p_value, 0.01);
}

TEST(StudyTable, EquivalenceIsCorrectedForTheNumberOfRows) {
  const StudyCount count{"d", "1", {50, 100}, 0, ""};
  const StudyRow alone = analyse_counts({count}).rows[0];
  EXPECT_TRUE(alone.indistinguishable({}));
  std::vector<StudyCount> many(50, count);
  for (std::size_t i = 0; i < many.size(); ++i) many[i].image = std::to_string(i);
  const StudyRow one = analyse_counts(many).rows[0];
  EXPECT_NEAR(one.equivalence_p_holm, 50 * one.equivalence_p, 1e-12);
  EXPECT_TRUE(one.equivalent());
  EXPECT_FALSE(one.indistinguishable({}));
  EXPECT_TRUE(
      equivalence_text(one, {}).starts_with("that the rate lies within 0.5 ± 0.15 is not shown after"));
}

TEST(StudyTable, SurvivesExtremeCounts) {
  for (const double p_null : {0.0, 1e-12, 0.19, 1 - 1e-12}) {
    StudyOptions options;
    options.p_null = p_null;
    const Study study = analyse_counts({{"d", "none", {0, 1'000'000'000}, 0, ""},
                                        {"d", "all", {1'000'000'000, 1'000'000'000}, 0, ""},
                                        {"d", "one", {1, 1}, 0, ""}},
                                       options);
    EXPECT_GT(study_table(study).rows().size(), 30u);  // add() throws for NaN
    if (p_null < 0.5) {
      EXPECT_LT(study.rows[1].p_value, 0.05);
    }
  }
}

TEST(StudyTable, TakesTheIntervalAskedForAndGivesSensitivityOfTheRightAnswers) {
  StudyOptions options;
  options.interval = IntervalMethod::kWilson;
  const Study study = analyse_counts({{"d", "i", {12, 34}, 0, ""}}, options);
  EXPECT_NEAR(study.rows[0].rate.low, 0.214879205948795, 1e-12);  // R: prop.test(correct = FALSE)
  const ResultTable table = study_table(study);
  bool found = false;
  for (const ResultRow& row : table.rows())
    if (row.quantity == "dprime" && std::get<std::string>(row.columns.back().second) == "abx-independent") {
      found = true;
      EXPECT_NEAR(row.value, dprime_of(22.5 / 35, DprimeModel::kAbxIndependent), 1e-12);
    }
  EXPECT_TRUE(found);
}

TEST(StudyTable, RefusesOptionsOutOfRange) {
  const auto with = [](const std::function<void(StudyOptions&)>& change) {
    StudyOptions options;
    change(options);
    return message_of([&] { analyse_counts({{"d", "i", {1, 2}, 0, ""}}, options); });
  };
  EXPECT_EQ(with([](StudyOptions& o) { o.p_null = 1; }), "the tested rate is 1 but must lie in [0, 1)");
  EXPECT_EQ(with([](StudyOptions& o) { o.alternatives = {2}; }), "the true rate 2 must lie in [0, 1]");
  EXPECT_EQ(with([](StudyOptions& o) { o.most_lapses = 2; }),
            "the largest share of lapses is 2 but must lie in [0, 1]");
  EXPECT_THROW(analyse_counts({}), InputError);
}

TEST(StudyPlot, HasABarForEachImageAndDisplayAndTheLineToReach) {
  const Study study = analyse_counts(counts_from(kTable51));
  const Plot plot = study_plot(study, true);
  EXPECT_EQ(plot.categories.size(), 5u);
  ASSERT_EQ(plot.series.size(), 4u);
  EXPECT_EQ(plot.series[1].points[0].y, 19);
  EXPECT_EQ(plot.series[2].points[0].y, 11);
  EXPECT_EQ(plot.series[3].points[0].y, 17);
  EXPECT_NO_THROW(plot_svg(plot));
  const Study mixed = analyse_counts({{"d", "1", {1, 2}, 0, ""}, {"e", "2", {1, 3}, 0, ""}});
  EXPECT_THROW(study_plot(mixed, true), InputError);
  EXPECT_NO_THROW(study_plot(mixed).validate());
}

}  // namespace
}  // namespace plenolab
