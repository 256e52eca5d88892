#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "experiments/reproduce/luminance/figure_words.h"
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

TEST(LuminanceFigureWords, SayWhetherAmplitudesAreAsInFigure3) {
  LuminanceCurves curves{"Made up", std::log(5.0), std::log(4.0), 2, 3, 0.2, 0.3};
  const std::string other = compare_with_figure_3(curves);
  EXPECT_NE(other.find("other than in the paper, the amplitude of BruteForce is the larger (a factor of 5.00 "
                       "against 4.00 of Accumulative)"),
            std::string::npos)
      << other;
  EXPECT_NE(other.find("Accumulative is the more restless"), std::string::npos) << other;
  EXPECT_NE(other.find("farther from the true pictures than All (0.300 against 0.200"), std::string::npos);
  std::swap(curves.brute_range, curves.accumulative_range);
  curves.accumulative_variation = 1;
  curves.brute_to_truth = 0.1;
  const std::string as_paper = compare_with_figure_3(curves);
  EXPECT_NE(as_paper.find("as in the paper, the amplitude of Accumulative"), std::string::npos) << as_paper;
  EXPECT_NE(as_paper.find("no more restless"), std::string::npos);
  EXPECT_NE(as_paper.find("is nearer to"), std::string::npos);
  curves.brute_to_truth = 0.199;
  EXPECT_NE(compare_with_figure_3(curves).find("no nearer to"), std::string::npos);
  curves.brute_to_truth.reset();
  EXPECT_EQ(compare_with_figure_3(curves).find("true pictures"), std::string::npos);
}

TEST(LuminanceFigureWords, SayWhereAllBeatsAccumulativeInFigure4) {
  PsnrCurves curves{
      "Made up", "OnResult", {-2, -1, 0, 1, 2}, {9, 9, 9, 9, 9}, {9.5, 9.5, 9.5, 9.5, 8}, {10, 10, 10, 8, 8}};
  const std::string agrees = compare_with_figure_4(curves);
  EXPECT_NE(agrees.find("above All at 80 % and Accumulative at 60 %"), std::string::npos) << agrees;
  EXPECT_NE(agrees.find("as in the paper."), std::string::npos) << agrees;
  EXPECT_NE(agrees.find("better than Accumulative from 1 to 2 m."), std::string::npos) << agrees;
  curves.accumulative_db = {10, 8, 10, 8, 8};
  const std::string differs = compare_with_figure_4(curves);
  EXPECT_NE(differs.find("other than in the paper"), std::string::npos) << differs;
  EXPECT_NE(differs.find("at -1 m, from 1 to 2 m"), std::string::npos) << differs;
  EXPECT_EQ(where_greater({0, 1}, {1, 1}, {2, 2}), "nowhere");
  EXPECT_EQ(where_greater({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, {1, 0, 1, 0, 1, 1, 1, 0, 1, 0, 1},
                          std::vector<double>(11, 0.5)),
            "in 5 pieces between 0 and 10 m, the longest from 4 to 6 m");
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
