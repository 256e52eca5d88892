#include "analysis/timing.h"

#include <gtest/gtest.h>

#include <cstring>

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

TEST(Timing, SeesMemoryThatTheWorkTouches) {
  if (!reset_peak_resident()) GTEST_SKIP() << "the system does not reset the peak";
  TimingOptions options;
  options.runs = 1;
  options.warm_up_runs = 0;
  volatile char sink = 0;
  const TimingSummary summary = time_repeated(
      [&] {
        std::vector<char> block(64u << 20);
        std::memset(block.data(), 1, block.size());
        sink = block[block.size() / 2];
      },
      options);
  ASSERT_TRUE(summary.peak_memory_mib.has_value());
  EXPECT_GT(*summary.peak_memory_mib, 48);
}

TEST(Timing, WritesRowsWithStableNames) {
  TimingSummary summary = summarise_times({2, 1});
  ResultTable table;
  add_timing_rows(table, summary, {{"method", "fast"}});
  summary.peak_memory_mib = 12;
  add_timing_rows(table, summary, {{"method", "linear"}});
  ASSERT_EQ(table.rows().size(), 13u);
  EXPECT_EQ(table.rows()[0].quantity, "seconds_median");
  EXPECT_EQ(table.rows()[0].value, 1.5);
  EXPECT_EQ(table.rows()[12].quantity, "peak_memory_mib");
}

}  // namespace
}  // namespace plenolab
