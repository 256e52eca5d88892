#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/psychophysics/csv.h"
#include "core/base/file.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"

namespace plenolab {
namespace {

/// Tables transcribed from the papers: tests/data/paper-tables.
CsvTable paper_table(const std::string& name) {
  return parse_csv(read_text_file(std::string(PLENOLAB_SOURCE_DIR "/tests/data/paper-tables/") + name), name);
}

TEST(PublishedStudies, HoldTheCountsAsPrinted) {
  const CsvTable table = paper_table("hansen-klein-5.1-sessions.csv");
  const auto main = published_main_study(), initial = published_initial_study();
  ASSERT_EQ(table.rows.size(), main.size() + initial.size());
  for (const CsvRow& row : table.rows) {
    const auto& counts = table.text(row, "experiment") == "main" ? main : initial;
    const std::string image = "Image " + table.text(row, "image");
    const bool monitor = table.text(row, "condition") == "monitor";
    const auto found = std::find_if(counts.begin(), counts.end(), [&](const StudyCount& c) {
      return c.image == image && (c.display == "monitor") == monitor;
    });
    ASSERT_NE(found, counts.end());
    EXPECT_EQ(found->chose_test.hits, table.whole(row, "chose_reprojected", 0, 100));
    EXPECT_EQ(found->chose_test.trials, table.whole(row, "n", 0, 100));
    EXPECT_EQ(found->printed_verdict, table.text(row, "printed_result"));
  }
}

TEST(PublishedStudies, HoldTheDifferencesAsPrinted) {
  const CsvTable table = paper_table("hansen-klein-5.2-5.4-image-difference.csv");
  const PublishedDifferences d = published_differences();
  for (const CsvRow& row : table.rows) {
    const std::string statistic = table.text(row, "statistic");
    if (statistic == "min") continue;
    const auto& values = statistic == "max" ? d.largest : statistic == "mean" ? d.mean : d.median;
    const double sum =
        table.number(row, "r", 0, 1) + table.number(row, "g", 0, 1) + table.number(row, "b", 0, 1);
    EXPECT_NEAR(values[static_cast<std::size_t>(table.whole(row, "image", 1, 5) - 1)], sum / 3, 1e-12)
        << statistic;
  }
}

TEST(PublishedStudies, HoldTheRunTimesAsPrinted) {
  const CsvTable table = paper_table("hansen-klein-5.1-run-time.csv");
  const auto times = published_run_times();
  ASSERT_EQ(times.size(), table.rows.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(times[i].seconds.mean, table.number(table.rows[i], "mean_s", 0, 1));
    EXPECT_EQ(times[i].seconds.sd, table.number(table.rows[i], "sd_s", 0, 1));
    EXPECT_EQ(times[i].seconds.n, table.whole(table.rows[i], "n", 1, 10000));
  }
}

TEST(StudyItems, CountWhatOutlivesHolmAndSayWhatDoesNot) {
  const Study study = analyse_counts(published_main_study(), published_options());
  const VerdictCount count = count_verdicts(study);
  EXPECT_EQ(count.passed, 8);
  EXPECT_EQ(count.disagreeing, 0);
  EXPECT_EQ(count.passed_after_holm, 6);  // R: Holm p of 12 and 11 of 34 are 0.075 and 0.135
  EXPECT_EQ(count.equivalent, 0);
  EXPECT_EQ(taken_back_by_holm(study),
            "Image 1 on light-field (p = 0.0188, Holm 0.075), Image 3 on monitor (p = 0.0450, Holm 0.135)");
  std::vector<StudyCount> swapped = published_main_study();
  swapped[0].printed_verdict = "FAILED";
  EXPECT_EQ(count_verdicts(analyse_counts(swapped, published_options())).disagreeing, 1);
}

TEST(StudyItems, RunAtOnceSayThreeThingsAndFollowFromTheirNumbers) {
  Laboratory laboratory({.effort = Effort::kTiny, .cache = {}, .on_view = {}});
  for (const Reproduction* item :
       select_reproductions({"hansen-table-5.1", "hansen-fig-5.2", "hansen-table-e", "study-planning",
                             "hansen-run-time-test", "hansen-claim-h1", "hansen-claim-h13"})) {
    const ReproductionResult result = item->run(laboratory);
    EXPECT_FALSE(result.paper_shows.empty() || result.ours_shows.empty() || result.differs.empty())
        << item->id;
    EXPECT_FALSE(result.rows.empty() || result.blocks.empty()) << item->id;
    for (const LedgerEntry& entry : result.ledger) {
      ASSERT_TRUE(entry.verdict.interval) << entry.claim.id;
      EXPECT_EQ(entry.verdict.outcome,
                decide(*entry.verdict.interval, entry.verdict.comparison, entry.verdict.threshold))
          << entry.claim.id;
    }
    const ReproductionResult again = item->run(laboratory);
    EXPECT_EQ(to_csv(again.rows), to_csv(result.rows)) << item->id;
  }
  EXPECT_EQ(laboratory.tally().rendered, 0);
}

}  // namespace
}  // namespace plenolab
