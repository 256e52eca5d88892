#include "analysis/timing.h"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"

namespace plenolab {
namespace {

TEST(Timing, SummarisesGivenTimes) {
  const TimingSummary summary = summarise_times({5, 1, 3, 2, 4});
  EXPECT_EQ(summary.runs, 5);
  EXPECT_EQ(summary.median_s, 3);
  EXPECT_EQ(summary.lower_quartile_s, 2);
  EXPECT_EQ(summary.upper_quartile_s, 4);
  EXPECT_EQ(summary.min_s, 1);
  EXPECT_EQ(summary.max_s, 5);
}

TEST(Timing, RunsWarmUpsAndTimedRunsAsOftenAsAsked) {
  int calls = 0;
  TimingOptions options;
  options.runs = 4;
  options.warm_up_runs = 2;
  const TimingSummary summary = time_repeated([&] { ++calls; }, options);
  EXPECT_EQ(calls, 6);
  EXPECT_EQ(summary.runs, 4);
  EXPECT_LE(summary.min_s, summary.median_s);
  EXPECT_LE(summary.median_s, summary.max_s);
  options.runs = 0;
  EXPECT_THROW(time_repeated([] {}, options), InputError);
}

TEST(Timing, WorkIsTimedInTurnAndEachStageHasItsMedian) {
  std::string order;
  std::vector<double> first{100, 3, 1, 2}, second{200, 30, 10, 20};  // the warm-up runs are far off
  const auto next = [](std::vector<double>& values) {
    const double value = values.front();
    values.erase(values.begin());
    return value;
  };
  const auto medians = medians_in_turn({[&] {
                                          order += 'a';
                                          const double v = next(first);
                                          return std::vector{v, 5 * v};
                                        },
                                        [&] {
                                          order += 'b';
                                          return std::vector{next(second)};
                                        }},
                                       {.runs = 3});
  EXPECT_EQ(order, "abababab");
  EXPECT_EQ(medians, (std::vector<std::vector<double>>{{2, 10}, {20}}));
  EXPECT_THROW(medians_in_turn({}, {.runs = 0}), InputError);
}

TEST(Timing, WritesRowsWithStableNames) {
  ResultTable table;
  add_timing_rows(table, summarise_times({2, 1}), {{"method", "fast"}});
  ASSERT_EQ(table.rows().size(), 6u);
  EXPECT_EQ(table.rows()[0].quantity, "seconds_median");
  EXPECT_EQ(table.rows()[0].value, 1.5);
  EXPECT_EQ(table.rows()[5].quantity, "runs");
}

}  // namespace
}  // namespace plenolab
