#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/reproduce/lut/counting_steps.h"
#include "experiments/reproduce/lut/lut_tools.h"

namespace plenolab {
namespace {

Laboratory& laboratory() {
  static Laboratory tiny({.effort = Effort::kTiny, .cache = {}, .seed = 1, .threads = 2, .on_view = {}});
  return tiny;
}

/// An item on one small walk, run when it is first asked for: each test is a process of its own.
const ReproductionResult& result_of(const std::string& id) {
  static std::map<std::string, ReproductionResult> results;
  const auto found = results.find(id);
  if (found != results.end()) return found->second;
  return results.emplace(id, select_reproductions({id}).front()->run(laboratory())).first->second;
}

/// Of the chapter on look-up tables, and Z-7, which stands in another.
std::vector<std::string> item_ids() {
  std::vector<std::string> ids;
  for (const Reproduction& item : reproductions())
    if (item.chapter == Chapter::kLuts || std::string(item.id) == "zhao-claim-z7") ids.emplace_back(item.id);
  return ids;
}

/// Values of a quantity whose columns hold this text.
std::vector<double> values_of(const std::string& id, const std::string& quantity, const std::string& text) {
  std::vector<double> values;
  for (const ResultRow& row : result_of(id).rows.rows())
    if (row.quantity == quantity &&
        std::ranges::any_of(row.columns, [&](const auto& column) { return column.second == Cell(text); }))
      values.push_back(row.value);
  return values;
}

TEST(LutItems, AllSayWhatThePaperAndWeShowAndWhyTheyDiffer) {
  ASSERT_EQ(item_ids().size(), 10u);
  for (const std::string& id : item_ids()) {
    const ReproductionResult& result = result_of(id);
    for (const std::string* text : {&result.paper_shows, &result.ours_shows, &result.differs}) {
      EXPECT_TRUE(text->ends_with('.')) << id << ": " << *text;
      for (const char* bad : {" nan", " inf", "-nan"})
        EXPECT_EQ(text->find(bad), std::string::npos) << id << ": " << *text;
    }
    EXPECT_FALSE(result.rows.empty()) << id;
    for (const NamedPlot& plot : result.plots) EXPECT_NO_THROW(plot.plot.plot.validate()) << id;
  }
}

TEST(LutItems, EveryClaimHasAVerdictAndThatOnGpusNone) {
  std::vector<std::string> ids;
  for (const std::string& id : item_ids()) {
    if (id.find("claim") == std::string::npos) continue;
    for (const LedgerEntry& claim : result_of(id).ledger) {
      ids.push_back(claim.claim.id);
      EXPECT_FALSE(claim.verdict.explanation.empty()) << claim.claim.id;
    }
  }
  std::ranges::sort(ids);
  EXPECT_EQ(ids, (std::vector<std::string>{"Z-4a", "Z-4b", "Z-4c", "Z-5a", "Z-5b", "Z-6a", "Z-6b", "Z-6c",
                                           "Z-6d", "Z-7a", "Z-7b"}));
  EXPECT_EQ(result_of("zhao-claim-z5").ledger.back().verdict.outcome, Outcome::kUndecided);
}

TEST(LutItems, CodesInTheDarkAreThoseOfTheDefinitions) {
  // 10-bit codes from 0.1 to 1 cd/m²: 1023·(1^(1/2.4) − 0.1^(1/2.4))/peak^(1/2.4), and of PQ (ST 2084).
  const auto codes = [](const std::string& coding) {
    return values_of("zhao-claim-z7", "codes", coding).at(2);
  };
  const double gamma = 1023 * (1 - std::pow(0.1, 1 / 2.4));
  EXPECT_NEAR(codes("gamma 2.4, peak 100 cd/m²"), gamma / std::pow(100, 1 / 2.4), 1e-9);
  EXPECT_NEAR(codes("gamma 2.4, peak 10000 cd/m²"), gamma / std::pow(1e4, 1 / 2.4), 1e-9);
  EXPECT_NEAR(codes("PQ, peak 10000 cd/m²"), 89.6, 0.05);
  const auto& ledger = result_of("zhao-claim-z7").ledger;
  EXPECT_EQ(ledger.at(0).verdict.outcome, Outcome::kConfirmed);
  EXPECT_EQ(ledger.at(1).verdict.outcome, Outcome::kRefuted);
}

TEST(LutItems, WeightsOfEveryFrameSumToOneAndLinearOnesStandStillWhileTheWalkerTurns) {
  for (const char* method : {"linear", "pixel-based"}) {
    const std::vector<double> weights = values_of("zhao-fig-24", "blend_weight", method);
    ASSERT_EQ(weights.size() % 4, 0u);
    for (std::size_t i = 0; i < weights.size(); i += 4)
      EXPECT_NEAR(weights[i] + weights[i + 1] + weights[i + 2] + weights[i + 3], 1, 1e-9);
  }
  EXPECT_NEAR(values_of("zhao-fig-24", "weights_moved_while_turning", "linear").at(0), 0, 1e-9);
  EXPECT_GT(values_of("zhao-fig-24", "weights_moved_while_turning", "pixel-based").at(0), 0.3);
}

TEST(LutItems, AFrameThatShowsOneVolumeOnlyIsThatVolumesToThePixel) {
  WalkBench& bench = laboratory().walk_bench();
  for (std::size_t i = 0; i < bench.frames().size(); ++i) {
    const WalkBench::Score& score = bench.scores()[i];
    const auto most = std::ranges::max_element(score.pixel.volumes);
    if (*most < 1) continue;
    EXPECT_EQ(score.ahead, static_cast<int>(most - score.pixel.volumes.begin()));
    EXPECT_LT(score.of(BlendMethod::kPixel, GradeReference::kAhead), 1e-3);
    EXPECT_LT(score.of(BlendMethod::kPixel, GradeReference::kByPixel), 1e-2);
  }
}

TEST(LutItems, TheTableOfTimesBlendsSeveralTablesAndNamesItsSize) {
  const ReproductionResult& result = result_of("zhao-table-3");
  // A tiny run's frames have no printed times to be set beside.
  EXPECT_TRUE(values_of("zhao-table-3", "printed_over_ours", "480 × 270").empty());
  EXPECT_NE(result.ours_shows.find("480 × 270"), std::string::npos) << result.ours_shows;
  EXPECT_EQ(values_of("zhao-table-3", "largest_weight_error", "480 × 270").size(), 3u);
  WalkBench& bench = laboratory().walk_bench();
  const WalkFrame frame = timed_frame(bench, true);
  const VolumeWeights weights = pixel_weights(
      count_pixels(frame.depth_m, frame.pose.camera, bench.stage().volumes()), bench.stage().volumes());
  EXPECT_GE(std::ranges::count_if(weights.volumes, [](double w) { return w > 0; }), 2);
  const std::vector<FrameStep> steps = other_steps(bench, frame);
  EXPECT_TRUE(
      std::ranges::any_of(steps, [](const FrameStep& s) { return s.what.starts_with("of 3 tables"); }));
}

TEST(LutItems, CaptionsSayWhatThePicturesHold) {
  WalkBench& bench = laboratory().walk_bench();
  const auto comparisons_of = [](const std::string& id) {
    std::vector<ImageComparison> found;
    for (const ReportBlock& block : result_of(id).blocks)
      if (const auto* comparison = std::get_if<ImageComparison>(&block)) found.push_back(*comparison);
    return found;
  };
  const std::string frames = fmt::format("{} of {} frames", bench.frames().size(), bench.frames().size());
  ASSERT_EQ(comparisons_of("zhao-fig-24").size(), 1u);
  EXPECT_NE(comparisons_of("zhao-fig-24").front().caption.find(frames), std::string::npos)
      << "all of a tiny walk";
  const std::vector<ImageComparison> turns = comparisons_of("zhao-fig-25");
  ASSERT_EQ(turns.size(), 4u);
  EXPECT_EQ(turns.front().alt, "The three frames of a turn on the spot, graded in three ways.");
  for (const ImageComparison& turn : turns) {
    EXPECT_TRUE(turn.images.at(0).label.ends_with("inear")) << turn.images.at(0).label;
    EXPECT_TRUE(turn.images.at(1).label.ends_with("ixel-based"));
  }
  // The end of the first turn looks back through the door of the corridor.
  EXPECT_NE(turns.at(1).caption.find("the end of the turn, which looks into the corridor"), std::string::npos)
      << turns.at(1).caption;
}

TEST(LutItems, AboutAHundredTimesHasTwoEnds) {
  for (const LedgerEntry& entry : result_of("zhao-claim-z6").ledger) {
    const Verdict& verdict = entry.verdict;
    ASSERT_TRUE(verdict.interval.has_value());
    const bool inside = verdict.interval->low > 50 && verdict.interval->high < 200,
               outside = verdict.interval->high < 50 || verdict.interval->low > 200;
    EXPECT_EQ(verdict.outcome, inside    ? Outcome::kConfirmed
                               : outside ? Outcome::kRefuted
                                         : Outcome::kUndecided)
        << entry.claim.id;
  }
}

TEST(LutItems, ContactSheetsHoldAllPicturesInReadingOrder) {
  std::vector<DisplayImage> pictures;
  for (int i = 0; i < 5; ++i) {
    pictures.emplace_back(8, 4);
    std::ranges::fill(pictures.back().pixels(), Rgb{0.1f * static_cast<float>(i), 0, 0});
  }
  const DisplayImage sheet = contact_sheet(pictures, 3, 2);
  EXPECT_EQ(sheet.width(), 3 * 4 + 2 * 4);
  EXPECT_EQ(sheet.height(), 2 * 2 + 4);
  EXPECT_FLOAT_EQ(sheet.at(0, 0).r, 0);
  EXPECT_FLOAT_EQ(sheet.at(16, 1).r, 0.2f);
  EXPECT_FLOAT_EQ(sheet.at(8, 6).r, 0.4f);
  EXPECT_EQ(sheet.at(5, 0), (Rgb{1, 1, 1})) << "the gap";
  EXPECT_EQ(sheet.at(16, 7), (Rgb{1, 1, 1})) << "no sixth picture";
}

}  // namespace
}  // namespace plenolab
