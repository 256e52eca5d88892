#include <fmt/format.h>
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

/// Values of a quantity by scene.
std::map<std::string, double> by_scene(const std::string& item, const std::string& quantity) {
  std::map<std::string, double> values;
  for (const ResultRow& row : rows_of(item, quantity)) values[column_text(row, "scene")] = row.value;
  return values;
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
  // Both former measures with what they give in this run.
  for (const char* quantity :
       {"edge_difference_ratio_first_measure", "edge_difference_ratio_second_measure"}) {
    const auto rows = rows_of("hansen-claim-h2", quantity);
    ASSERT_EQ(rows.size(), 1u) << quantity;
    EXPECT_NE(verdict.explanation.find(format_number(rows[0].value, 3) + " ("), std::string::npos)
        << quantity << ": " << verdict.explanation;
  }
}

TEST(DisplayItems, PlacesOfH2AddUpToTheWholePicture) {
  const auto near = by_scene("hansen-claim-h2", "near_edge_share"),
             holes = by_scene("hansen-claim-h2", "hole_share"),
             in_holes = by_scene("hansen-claim-h2", "mean_difference_in_holes"),
             elsewhere = by_scene("hansen-claim-h2", "mean_difference_elsewhere"),
             all = by_scene("hansen-claim-h2", "mean_difference_everywhere");
  ASSERT_EQ(all.size(), 5u);
  for (const auto& [scene, whole] : all) {
    const double hole = holes.at(scene);
    EXPECT_NEAR(hole * in_holes.at(scene) + (1 - hole) * elsewhere.at(scene), whole, 1e-6) << scene;
    EXPECT_GT(near.at(scene), 0) << scene;
    EXPECT_LT(near.at(scene), 1) << scene;
  }
}

TEST(DisplayItems, WhatHoldsByConstructionIsNoVerdict) {
  const ReproductionResult& result = result_of("hansen-claim-h5");
  ASSERT_EQ(result.ledger.size(), 1u);
  EXPECT_EQ(result.ledger[0].claim.id, "H-5b");
  EXPECT_NE(result.differs.find("by construction"), std::string::npos);
  for (const ResultRow& row : rows_of("hansen-claim-h5", "largest_offset")) EXPECT_LE(row.value, 0.5 + 1e-6);
}

TEST(DisplayItems, TheCausesOfDisplacedMatchesAddUp) {
  std::map<std::string, double> sums;
  for (const char* cause : {"outline", "background", "foreground"})
    for (const ResultRow& row : rows_of("hansen-claim-h5", std::string("share_of_displaced_") + cause))
      sums[column_text(row, "scene") + column_text(row, "method")] += row.value;
  EXPECT_EQ(sums.size(), 10u);
  for (const auto& [setting, sum] : sums) EXPECT_TRUE(std::abs(sum - 1) < 1e-9 || sum == 0) << setting << sum;
}

TEST(DisplayItems, WhatH7SaysOfScenesAndLinesFollowsFromItsRows) {
  std::map<std::string, std::map<long long, double>> shares;  // by scene and size
  for (const ResultRow& row : rows_of("hansen-claim-h7", "share_wrong"))
    for (const auto& [key, value] : row.columns)
      if (const auto* size = std::get_if<long long>(&value); size && key == "size_px")
        shares[column_text(row, "scene")][*size] = row.value;
  ASSERT_EQ(shares.size(), 5u);
  int falling = 0;
  double worst = 0;
  for (const auto& [scene, by_size] : shares) {
    ASSERT_EQ(by_size.size(), 2u) << scene;
    falling += by_size.rbegin()->second < by_size.begin()->second;
    worst = std::max(worst, by_size.rbegin()->second / by_size.begin()->second);
  }
  const ReproductionResult& result = result_of("hansen-claim-h7");
  EXPECT_NE(result.plots.front().plot.alt.find(fmt::format("{} of 5 fall at every step", falling)),
            std::string::npos);
  EXPECT_NE(result.differs.find(fmt::format("({:.3g} times as large a share)", worst)), std::string::npos)
      << result.differs;
  for (const ResultRow& row : rows_of("hansen-claim-h7", "share_holes")) {
    EXPECT_GE(row.value, 0);
    EXPECT_LT(row.value, 0.5);
  }
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

/// The verdict is on the geometric mean of one ratio a scene, over all five.
void expect_one_ratio_a_scene(const std::string& item, const Verdict& verdict, const std::string& above,
                              const std::string& below) {
  const auto numerators = by_scene(item, above), denominators = by_scene(item, below);
  ASSERT_EQ(numerators.size(), 5u) << item;
  EXPECT_EQ(verdict.scenes.size(), 5u) << item;
  double sum = 0;
  for (const auto& [scene, numerator] : numerators) sum += std::log(numerator / denominators.at(scene));
  EXPECT_NEAR(std::log(verdict.number), sum / 5, 1e-9) << item;
}

TEST(DisplayItems, ClaimsOnTimeAreDecidedByOneRatioASceneOverAllOfThem) {
  expect_one_ratio_a_scene("hansen-claim-h6", claim("hansen-claim-h6", "H-6").verdict, "seconds_reprojected",
                           "seconds_direct");
  expect_one_ratio_a_scene("hansen-claim-h12", claim("hansen-claim-h12", "H-12").verdict,
                           "seconds_supersampled", "seconds_plain");
}

TEST(DisplayItems, SixteenPathsAPixelCostMoreThanDirectLightInTheSameScene) {
  std::map<std::string, double> ns;
  for (const ResultRow& row : rows_of("hansen-claim-h6", "render_ns_per_pixel"))
    ns[column_text(row, "stimulus")] = row.value;
  int compared = 0;
  const std::string paths = ", 16 paths a pixel";
  for (const auto& [stimulus, traced] : ns)
    if (stimulus.ends_with(paths)) {
      EXPECT_GT(traced, ns.at(stimulus.substr(0, stimulus.size() - paths.size()))) << stimulus;
      ++compared;
    }
  EXPECT_EQ(compared, 1);
}

}  // namespace
}  // namespace plenolab
