#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/reproduce/reproduction.h"

namespace plenolab {
namespace {

bool is_of_display(const Reproduction& item) {
  const std::string id = item.id;
  return item.chapter == Chapter::kDisplay ||
         (id.starts_with("hansen-claim-h") && id != "hansen-claim-h1" && id != "hansen-claim-h13");
}

/// An item in a tiny run; items share their scenes, and each is run once.
const ReproductionResult& result_of(const std::string& id) {
  static Laboratory laboratory(
      {.effort = Effort::kTiny, .cache = {}, .seed = 1, .threads = 2, .on_view = {}});
  static std::map<std::string, ReproductionResult> results;
  if (const auto found = results.find(id); found != results.end()) return found->second;
  return results.emplace(id, select_reproductions({id}).front()->run(laboratory)).first->second;
}

const LedgerEntry& claim(const std::string& item, const std::string& id) {
  for (const LedgerEntry& entry : result_of(item).ledger)
    if (entry.claim.id == id) return entry;
  throw std::logic_error("no claim " + id);
}

std::vector<ResultRow> rows_of(const std::string& item, const std::string& quantity) {
  std::vector<ResultRow> found;
  for (const ResultRow& row : result_of(item).rows.rows())
    if (row.quantity == quantity) found.push_back(row);
  return found;
}

/// A column of text; empty if the row has none.
std::string column_text(const ResultRow& row, const std::string& name) {
  for (const auto& [key, value] : row.columns)
    if (const auto* text = std::get_if<std::string>(&value); text && key == name) return *text;
  return "";
}

void expect_complete(const std::string& id, const ReproductionResult& result) {
  for (const std::string* text : {&result.paper_shows, &result.ours_shows, &result.differs}) {
    EXPECT_TRUE(text->ends_with('.')) << id << ": " << *text;
    EXPECT_EQ(text->find("nan"), std::string::npos) << id << ": " << *text;
    EXPECT_EQ(text->find("{}"), std::string::npos) << id << ": " << *text;
  }
  EXPECT_FALSE(result.rows.empty()) << id;
  for (const ResultRow& row : result.rows.rows()) EXPECT_FALSE(std::isnan(row.value)) << id << row.quantity;
  for (const NamedPlot& plot : result.plots) EXPECT_NO_THROW(plot.plot.plot.validate()) << id;
}

/// All of them measure something ≥ 0: ratios, shares, pixels.
void expect_sound(const LedgerEntry& entry) {
  EXPECT_FALSE(entry.verdict.explanation.empty()) << entry.claim.id;
  if (!entry.verdict.interval) return;
  EXPECT_GE(entry.verdict.interval->low, 0) << entry.claim.id;
  EXPECT_LE(entry.verdict.interval->low, entry.verdict.number) << entry.claim.id;
  EXPECT_GE(entry.verdict.interval->high, entry.verdict.number) << entry.claim.id;
}

TEST(DisplayItems, AllSayWhatThePaperAndWeShowAndWhyTheyDifferAndRatiosAreNeverNegative) {
  int items = 0;
  for (const Reproduction& item : reproductions()) {
    if (!is_of_display(item)) continue;
    const ReproductionResult& result = result_of(item.id);
    expect_complete(item.id, result);
    for (const LedgerEntry& entry : result.ledger) expect_sound(entry);
    ++items;
  }
  EXPECT_GE(items, 20);
}

TEST(DisplayItems, H2SaysThatItsMeasureWasChangedAndWhatTheFirstGave) {
  const Verdict& verdict = claim("hansen-claim-h2", "H-2").verdict;
  EXPECT_NE(verdict.explanation.find("after a first look"), std::string::npos);
  EXPECT_EQ(rows_of("hansen-claim-h2", "edge_difference_ratio_first_measure").size(), 1u);
  EXPECT_EQ(rows_of("hansen-claim-h2", "hole_difference_ratio").size(), 1u);
  for (const ResultRow& row : rows_of("hansen-claim-h2", "near_edge_share")) EXPECT_LT(row.value, 1);
}

TEST(DisplayItems, H5aHoldsByConstructionAndSaysSo) {
  const Verdict& verdict = claim("hansen-claim-h5", "H-5a").verdict;
  EXPECT_EQ(verdict.outcome, Outcome::kConfirmed);
  EXPECT_NE(verdict.explanation.find("by construction"), std::string::npos);
  EXPECT_LE(verdict.number, 0.5 + 1e-6);
}

TEST(DisplayItems, TheCausesOfDisplacedMatchesAddUp) {
  std::map<std::string, double> sums;
  for (const char* cause : {"outline", "background", "foreground"})
    for (const ResultRow& row : rows_of("hansen-claim-h5", std::string("share_of_displaced_") + cause))
      sums[column_text(row, "scene") + column_text(row, "method")] += row.value;
  EXPECT_EQ(sums.size(), 10u);
  for (const auto& [setting, sum] : sums) EXPECT_TRUE(std::abs(sum - 1) < 1e-9 || sum == 0) << setting << sum;
}

TEST(DisplayItems, EveryCodingOfDepthHasARowOfItsOwn) {
  EXPECT_EQ(claim("hansen-claim-h8", "H-8a-linear").verdict.quantity, "difference_8_bit_linear_over_exact");
  EXPECT_EQ(claim("hansen-claim-h8", "H-8a-z-buffer").verdict.quantity,
            "difference_8_bit_z_buffer_over_exact");
}

TEST(DisplayItems, AveragedDepthMakesStrayDepthsAndAveragedColourDoesNot) {
  double sharp = 0, colour = 0, both = 0;
  for (const ResultRow& row : rows_of("hansen-claim-h9", "stray_depth_share")) {
    const std::string input = column_text(row, "input");
    (input == "point-sampled" ? sharp : input == "colour averaged" ? colour : both) += row.value;
  }
  EXPECT_DOUBLE_EQ(colour, sharp) << "matching looks at depth alone";
  EXPECT_GT(both, sharp);
}

TEST(DisplayItems, ALightFieldIsTimedWithWhatItNeeds) {
  const Verdict& verdict = claim("hansen-claim-h6", "H-6").verdict;
  EXPECT_EQ(verdict.scenes.size(), 2u);
  EXPECT_GT(verdict.number, 0);
  for (const ResultRow& row : rows_of("hansen-claim-h6", "render_ns_per_pixel")) EXPECT_GT(row.value, 0);
}

}  // namespace
}  // namespace plenolab
