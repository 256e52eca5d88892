#include "analysis/claims.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <limits>

namespace plenolab {
namespace {

TEST(Claims, AreDecidedOnlyByAnIntervalWhollyOnOneSide) {
  EXPECT_EQ(decide({1, 0.5, 1.5}, Comparison::kBelow, 2), Outcome::kConfirmed);
  EXPECT_EQ(decide({3, 2.5, 3.5}, Comparison::kBelow, 2), Outcome::kRefuted);
  EXPECT_EQ(decide({1.9, 1.5, 2.5}, Comparison::kBelow, 2), Outcome::kUndecided);
  EXPECT_EQ(decide({3, 2.5, 3.5}, Comparison::kAbove, 2), Outcome::kConfirmed);
  EXPECT_EQ(decide({1, 0.5, 1.5}, Comparison::kAbove, 2), Outcome::kRefuted);
}

TEST(Claims, StayUndecidedOnTheThresholdAndForNonFiniteEnds) {
  EXPECT_EQ(decide({2, 2, 2}, Comparison::kAbove, 2), Outcome::kUndecided);
  EXPECT_EQ(decide({1, 1, 2}, Comparison::kBelow, 2), Outcome::kUndecided);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(decide({5, 4, infinity}, Comparison::kAbove, 2), Outcome::kUndecided);
  EXPECT_EQ(decide({5, std::numeric_limits<double>::quiet_NaN(), 6}, Comparison::kAbove, 2),
            Outcome::kUndecided);
}

TEST(Ledger, GivesARowPerClaimWithItsInterval) {
  Verdict verdict =
      decide_claim({0.4, 0.3, 0.5}, Comparison::kBelow, 1, "unseen_share", "%", "95 % bootstrap");
  verdict.scenes = {"cellar", "desk"};
  const std::vector<LedgerEntry> ledger{
      {{"altmeier-1", "section 6.1", "few pixels stay unseen"}, verdict},
      {{"altmeier-2", "section 6.2", "looks natural"}, undecidable("needs people")}};
  ResultTable table;
  add_ledger_rows(table, ledger);
  const auto rows = rows_to_json(table);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["outcome"], "confirmed");
  EXPECT_EQ(rows[0]["quantity"], "unseen_share");
  EXPECT_EQ(rows[0]["interval_high"], 0.5);
  EXPECT_EQ(rows[0]["scenes"], "cellar, desk");
  EXPECT_EQ(rows[1]["outcome"], "undecided");
  EXPECT_EQ(rows[1]["quantity"], "claim_outcome");
}

}  // namespace
}  // namespace plenolab
