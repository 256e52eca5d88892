#include <gtest/gtest.h>

#include "experiments/reproduce/luminance/luminance_tools.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {
namespace {

/// All items of the chapter on one small display.
const std::vector<std::pair<std::string, ReproductionResult>>& results() {
  static const auto all = [] {
    Laboratory laboratory({.effort = Effort::kTiny, .cache = {}, .seed = 1, .threads = 2, .on_view = {}});
    std::vector<std::pair<std::string, ReproductionResult>> list;
    for (const Reproduction& item : reproductions())
      if (item.chapter == Chapter::kLuminance) list.emplace_back(item.id, item.run(laboratory));
    return list;
  }();
  return all;
}

const ReproductionResult& result_of(const std::string& id) {
  return std::find_if(results().begin(), results().end(),
                      [&](const auto& entry) { return entry.first == id; })
      ->second;
}

double value_of(const std::string& id, const std::string& quantity) {
  for (const ResultRow& row : result_of(id).rows.rows())
    if (row.quantity == quantity) return row.value;
  ADD_FAILURE() << id << " has no " << quantity;
  return 0;
}

TEST(LuminanceItems, AllSayWhatThePaperAndWeShowAndWhyTheyDiffer) {
  ASSERT_EQ(results().size(), 12u);
  for (const auto& [id, result] : results()) {
    for (const std::string* text : {&result.paper_shows, &result.ours_shows, &result.differs}) {
      EXPECT_TRUE(text->ends_with('.')) << id << ": " << *text;
      for (const char* bad : {" nan", " inf", "-nan"})
        EXPECT_EQ(text->find(bad), std::string::npos) << id << ": " << *text;
    }
    EXPECT_FALSE(result.rows.empty()) << id;
    for (const NamedPlot& plot : result.plots) EXPECT_NO_THROW(plot.plot.plot.validate()) << id;
  }
}

TEST(LuminanceItems, EveryClaimOfThePaperHasAVerdict) {
  std::vector<std::string> ids;
  for (const auto& entry : results())
    for (const LedgerEntry& claim : entry.second.ledger) {
      ids.push_back(claim.claim.id);
      EXPECT_FALSE(claim.verdict.explanation.empty()) << claim.claim.id;
    }
  EXPECT_EQ(ids, (std::vector<std::string>{"D-1a", "D-1b", "D-2a", "D-2b", "D-3a", "D-3b", "D-4a", "D-4b",
                                           "D-5", "D-6", "D-7a", "D-7b", "D-7c"}));
}

TEST(LuminanceItems, SpreadEqualsBruteForceWhereNeighboursAgree) {
  EXPECT_LT(value_of("doronin-claim-d5", "ln_largest_where_neighbours_agree"), 1e-5);
}

TEST(LuminanceItems, FiguresShowThreeViewsWithBothReferencesAndAllMethods) {
  for (const char* id : {"doronin-fig-5", "doronin-fig-6"}) {
    int comparisons = 0;
    for (const ReportBlock& block : result_of(id).blocks)
      if (const auto* comparison = std::get_if<ImageComparison>(&block)) {
        ++comparisons;
        EXPECT_EQ(comparison->images.size(), 6u) << id;
      }
    EXPECT_GE(comparisons, 3) << id;
  }
}

TEST(LuminanceItems, DetailIsKeptBestAtTheScreen) {
  const ReproductionResult& result = result_of("doronin-claim-d6");
  double at_screen = 0, far = 0;
  for (const ResultRow& row : result.rows.rows())
    if (row.quantity == "detail_kept") {
      const double depth = std::get<double>(row.columns[0].second);
      if (depth == 0) at_screen += row.value;
      if (depth > 3) far += row.value;
    }
  EXPECT_GT(at_screen, far);
}

}  // namespace
}  // namespace plenolab
