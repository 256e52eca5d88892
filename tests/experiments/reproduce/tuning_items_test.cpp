#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "experiments/reproduce/optimisation/published_tuning.h"
#include "experiments/reproduce/optimisation/tuning_tools.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {
namespace {

/// Items whose views are path traced, which takes minutes under sanitizers; `reproduce --preset tiny` runs
/// them.
constexpr std::array kPathTraced{"zhao-fig-1", "zhao-fig-3", "zhao-fig-5", "zhao-claim-z1"};

bool is_path_traced(const std::string& id) {
  return std::find(kPathTraced.begin(), kPathTraced.end(), id) != kPathTraced.end();
}

Laboratory small_laboratory() {
  return Laboratory({.effort = Effort::kTiny, .cache = {}, .seed = 1, .threads = 2, .on_view = {}});
}

double value_of(const ReproductionResult& result, const std::string& quantity) {
  for (const ResultRow& row : result.rows.rows())
    if (row.quantity == quantity) return row.value;
  ADD_FAILURE() << "there is no " << quantity;
  return 0;
}

void expect_sound(const std::string& id, const ReproductionResult& result) {
  for (const std::string* text : {&result.paper_shows, &result.ours_shows, &result.differs}) {
    EXPECT_TRUE(text->ends_with('.')) << id << ": " << *text;
    for (const char* bad : {" nan", " inf", "-nan"})
      EXPECT_EQ(text->find(bad), std::string::npos) << id << ": " << *text;
  }
  EXPECT_FALSE(result.rows.empty()) << id;
  for (const NamedPlot& plot : result.plots) EXPECT_NO_THROW(plot.plot.plot.validate()) << id;
}

TEST(TuningItems, AllSayWhatThePaperAndWeShowAndEveryClaimHasAVerdict) {
  Laboratory laboratory = small_laboratory();
  std::vector<std::string> claims;
  int items = 0;
  for (const Reproduction& item : reproductions()) {
    if (item.chapter != Chapter::kOptimisation || is_path_traced(item.id)) continue;
    ++items;
    const ReproductionResult result = item.run(laboratory);
    expect_sound(item.id, result);
    for (const LedgerEntry& claim : result.ledger) {
      claims.push_back(claim.claim.id);
      EXPECT_FALSE(claim.verdict.explanation.empty()) << claim.claim.id;
    }
  }
  EXPECT_EQ(items, 10);
  EXPECT_EQ(claims, (std::vector<std::string>{"Z-2a", "Z-2b", "Z-2c", "Z-2d", "Z-2e", "Z-2f", "Z-2g", "Z-2h",
                                              "Z-3a", "Z-3b", "Z-3c"}));
}

TEST(TuningItems, MoreSkyInTheFrameChangesHowASurfaceIsShown) {
  Laboratory laboratory = small_laboratory();
  const ReproductionResult flicker = select_reproductions({"zhao-fig-9"}).front()->run(laboratory);
  std::vector<double> sky, average, luma;
  for (const ResultRow& row : flicker.rows.rows()) {
    if (row.quantity == "sky_share") sky.push_back(row.value);
    if (row.quantity == "log_average_cd_m2") average.push_back(row.value);
    if (row.quantity == "surface_luma") luma.push_back(row.value);
  }
  ASSERT_EQ(sky.size(), 9u);
  for (std::size_t f = 1; f < sky.size(); ++f) {
    EXPECT_GE(sky[f], sky[f - 1]) << "the camera tilts up";
    // The photographic operator: a larger average shows the same luminance darker.
    EXPECT_EQ(average[f] > average[f - 1], luma[f] < luma[f - 1]) << f;
  }
  EXPECT_GT(value_of(flicker, "largest_step_luma"), 0);
}

TEST(TuningItems, TheAuditFindsTheSlipsOfThePrintedTable) {
  Laboratory laboratory = small_laboratory();
  const ReproductionResult audit = select_reproductions({"zhao-audit-table-2"}).front()->run(laboratory);
  EXPECT_EQ(value_of(audit, "sequences"), 10);
  EXPECT_EQ(value_of(audit, "wrong_sums"), 1) << "Effects Cave 2, content adaptive: 40.1 against 40.4";
  EXPECT_EQ(value_of(audit, "lowest_total"), 10);
  EXPECT_EQ(value_of(audit, "table_against_text"), 2) << "Vehicle Game and Living Room";
  EXPECT_EQ(value_of(audit, "figure_against_text"), 1) << "DRIM of Living Room favours the thesis' method";
  EXPECT_EQ(value_of(audit, "figure_brisque_not_lowest"), 1) << "Realistic Reflections favours Gao";
  EXPECT_EQ(value_of(audit, "repeated_cells"), 4) << "three reversals and a loss";
  EXPECT_EQ(value_of(audit, "other_spellings"), 1) << "Effect Cave";
}

TEST(TuningItems, EverySequenceHasItsOwnNamesakeInTheThesis) {
  std::vector<std::string> names;
  for (const GameSequence& sequence : game_sequences()) {
    EXPECT_EQ("after " + std::string(printed_namesake(sequence).name), sequence.title);
    names.emplace_back(printed_scene_namesake(sequence).name);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  EXPECT_EQ(names.size(), printed_figure_15().size());
}

TEST(TuningItems, TheLowestOfEqualsIsTheFirst) {
  EXPECT_EQ(lowest_of({1, 1, 2}), TuningMethod::kContentAdaptive);
  EXPECT_EQ(lowest_of({3, 2, 1}), TuningMethod::kZhao);
}

TEST(TuningItems, DifferencesAreOfMeansOfSequencesInTheLightsAskedFor) {
  std::vector<TunedSequence> tuned(2);
  tuned[0].sequence = &game_sequences().front();  // dark
  tuned[1].sequence = &game_sequences().back();   // bright, low contrast
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t m = 0; m < 3; ++m)
      for (const double part : {1.0, 3.0}) {
        TunedFrame frame;
        frame.loss = part * static_cast<double>(m + 1) * static_cast<double>(s + 1);
        tuned[s].by_method[m].push_back(frame);
      }
  const FrameValue total = [](const TunedFrame& f) { return f.total(); };
  EXPECT_EQ(sequence_differences(tuned, TuningMethod::kZhao, TuningMethod::kGao, total),
            (std::vector<double>{2, 4}));
  EXPECT_EQ(sequence_differences(tuned, TuningMethod::kZhao, TuningMethod::kContentAdaptive, total,
                                 {GameLight::kBrightLowContrast}),
            (std::vector<double>{8}));
}

}  // namespace
}  // namespace plenolab
