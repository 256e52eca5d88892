#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "experiments/cli/arguments.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/cli/wide_table.h"
#include "experiments/score.h"

namespace plenolab {
namespace {

TEST(Arguments, PositionsAreTwoFiniteNumbers) {
  EXPECT_EQ(parse_position("1.5,-2", "--at"), (CameraPosition{1.5, -2}));
  for (const char* text : {"", "1", "1,", "1,2,3", "a,b", "1,nan", "1, 2", "inf,0"})
    EXPECT_THROW(parse_position(text, "--at"), UsageError) << text;
}

TEST(Arguments, PathsAreSpreadEvenlyAndReachBothEndsExactly) {
  const auto positions = parse_path("0,0:3,0:3,1", 9);
  ASSERT_EQ(positions.size(), 9u);
  EXPECT_EQ(positions.front(), (CameraPosition{0, 0}));
  EXPECT_EQ(positions.back(), (CameraPosition{3, 1}));
  EXPECT_NEAR(positions[2].s, 1, 1e-12);
  EXPECT_NEAR(positions[7].t, 0.5, 1e-12);
  EXPECT_EQ(parse_path("1,1:2,2", 1), std::vector<CameraPosition>{(CameraPosition{1, 1})});
  EXPECT_THROW(parse_path("1,1", 5), UsageError);
  EXPECT_THROW(parse_path("0,0:1,1", 0), UsageError);
}

TEST(Arguments, APathThatStandsStillStaysThere) {
  for (const CameraPosition p : parse_path("1,2:1,2", 4)) EXPECT_EQ(p, (CameraPosition{1, 2}));
}

TEST(Arguments, ListsDropEmptyParts) {
  EXPECT_EQ(split_list("psnr,,ssim,"), (std::vector<std::string>{"psnr", "ssim"}));
}

TEST(Durations, ReadLikeSpokenOnes) {
  EXPECT_EQ(format_duration(0.4), "0 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(185), "3 min 05 s");
  EXPECT_EQ(format_duration(7800), "2 h 10 min");
}

TEST(WideTable, PutsQuantitiesBesideEachOtherAndLeavesMissingOnesEmpty) {
  ResultTable table;
  table.add({"a", 1, "1", {{"view", std::string("x")}}});
  table.add({"b", 2, "1", {{"view", std::string("x")}}});
  table.add({"b", 3, "1", {{"view", std::string("y")}}});
  table.add({"c", 9, "1", {{"view", std::string("y")}}});
  const ReportTable wide = wide_table(table, {"view"}, {{"a", "A"}, {"b", "B"}});
  ASSERT_EQ(wide.rows.size(), 2u);
  EXPECT_EQ(std::get<double>(wide.rows[0][2]), 2);
  EXPECT_EQ(std::get<std::string>(wide.rows[1][1]), "");
  EXPECT_EQ(std::get<double>(wide.rows[1][2]), 3);
  EXPECT_EQ(to_wide_text(table, {"view"}, {{"a", "A"}, {"b", "B"}}), "view  A  B\nx     1  2\ny        3\n");
}

TEST(PooledPsnr, IsThePsnrOfTheMeanSquaredError) {
  EXPECT_NEAR(pooled_psnr_db({20, 20}), 20, 1e-12);
  EXPECT_NEAR(pooled_psnr_db({20, 10}), -10 * std::log10(0.055), 1e-12);
  EXPECT_TRUE(std::isinf(pooled_psnr_db({INFINITY, INFINITY})));
  EXPECT_NEAR(pooled_psnr_db({INFINITY, 20}), 20 + 10 * std::log10(2.0), 1e-12);
}

}  // namespace
}  // namespace plenolab
