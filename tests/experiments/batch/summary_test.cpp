#include "experiments/batch/summary.h"

#include <gtest/gtest.h>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/batch/report.h"
#include "tests/experiments/batch/batch_command.h"

namespace plenolab {
namespace {
using Json = nlohmann::json;

/// Nine views by two operators; values of tmqi as given, none for 0.
struct Stored {
  explicit Stored(const std::filesystem::path& folder) : plan(plan_batch(write_tiny_batch(folder), 1)) {
    for (std::size_t i = 0; i < plan.items.size(); ++i) set(i, 1.0);
  }
  void set(std::size_t index, double tmqi, double statistics_s = 0) {
    if (items.size() <= index) items.resize(index + 1);
    ItemResult& result = items[index].result;
    items[index].state = ItemState::kDone;
    result.values = {{"mean_luma", 0.5, "luma"}};
    if (tmqi != 0) result.values.push_back({"tmqi", tmqi, "1"});
    result.timings = {{"seconds_fit", 9e-6, "s"},
                      {"seconds_map", 1e-6, "s"},
                      {"fit_views", 9, "views"},
                      {"seconds_statistics", statistics_s, "s"}};
    result.width = 10, result.height = 10;
  }
  void fail(std::size_t index) { items[index] = {ItemState::kFailed, {.failure = "for a reason"}}; }

  BatchPlan plan;
  std::vector<StoredItem> items;
};

double value_in(const ResultTable& rows, const std::string& quantity, const std::string& op) {
  for (const ResultRow& row : rows.rows())
    if (row.quantity == quantity && std::get<std::string>(row.columns.front().second).starts_with(op))
      return row.value;
  return -1;
}

class BatchSummary : public testing::Test {
 protected:
  TemporaryFolder folder_;
  Stored batch_{folder_.path()};
};

TEST_F(BatchSummary, MeansAreOverAllViewsWhereNothingIsMissing) {
  batch_.set(0, 10);
  const ResultTable rows = operator_rows(batch_.plan, batch_.items);
  EXPECT_DOUBLE_EQ(value_in(rows, "tmqi", "reinhard02"), 2);
  EXPECT_DOUBLE_EQ(value_in(rows, "tmqi", "bilateral"), 1);
  EXPECT_TRUE(comparison_notes(batch_.plan, batch_.items).empty());
}

TEST_F(BatchSummary, ALightFieldOfManyViewsCountsAsMuchAsAPhotograph) {
  ComparedItems compared;
  compared.inputs = {0, 0, 0, 2};
  EXPECT_EQ(means_of_inputs(compared, {1, 2, 3, 10}), (std::vector<double>{2, 10}));
  Stored two(folder_.path());
  for (std::size_t i = 16; i < 18; ++i)
    two.plan.items[i].input = 1;  // as if the last view were of another input
  two.set(16, 9);
  EXPECT_DOUBLE_EQ(value_in(operator_rows(two.plan, two.items), "tmqi", "reinhard02"), (1.0 + 9.0) / 2);
}

TEST_F(BatchSummary, AnOperatorThatFailsOnAHardViewDoesNotLookBetterForIt) {
  batch_.set(0, 0.1);  // a hard view: the other operator fails there
  batch_.fail(1);
  const ResultTable rows = operator_rows(batch_.plan, batch_.items);
  EXPECT_DOUBLE_EQ(value_in(rows, "tmqi", "reinhard02"), 1) << "without the view that the other has not";
  EXPECT_DOUBLE_EQ(value_in(rows, "tmqi", "bilateral"), 1);
  EXPECT_EQ(value_in(rows, "items", "reinhard02"), 9) << "done";
  EXPECT_EQ(value_in(rows, "items", "bilateral"), 8);
  EXPECT_EQ(
      comparison_notes(batch_.plan, batch_.items),
      std::vector<std::string>{"Over 8 of 9 views, those that all operators have: tmqi, ms/megapixel."});
}

TEST_F(BatchSummary, AValueThatOneOperatorLacksIsComparedOnTheOtherViews) {
  batch_.set(4, 100), batch_.set(5, 0);
  const ComparedItems compared = compared_items(batch_.plan, batch_.items, "tmqi");
  EXPECT_EQ(compared.views, 8u);
  EXPECT_EQ(compared.results[0].size(), 8u);
  EXPECT_EQ(compared_items(batch_.plan, batch_.items, "").views, 9u) << "times are there";
  EXPECT_DOUBLE_EQ(value_in(operator_rows(batch_.plan, batch_.items), "tmqi", "reinhard02"), 1);
}

TEST_F(BatchSummary, AnOperatorWithoutAnyValueTakesNothingFromTheOthers) {
  for (std::size_t i = 1; i < 18; i += 2) batch_.fail(i);
  const ResultTable rows = operator_rows(batch_.plan, batch_.items);
  EXPECT_DOUBLE_EQ(value_in(rows, "tmqi", "reinhard02"), 1);
  EXPECT_EQ(value_in(rows, "tmqi", "bilateral"), -1);
  EXPECT_EQ(value_in(rows, "items", "bilateral"), 0);
}

TEST_F(BatchSummary, OperatorsWithoutACommonViewHaveNoMeans) {
  for (std::size_t view = 0; view < 9; ++view) batch_.fail(2 * view + (view < 4 ? 0 : 1));
  EXPECT_EQ(value_in(operator_rows(batch_.plan, batch_.items), "tmqi", "reinhard02"), -1);
  EXPECT_EQ(comparison_notes(batch_.plan, batch_.items),
            std::vector<std::string>{
                "No view has a value from all operators, so there is no mean: tmqi, ms/megapixel."});
}

TEST_F(BatchSummary, TimesHoldTheStatisticsAndTheViewsShareOfAFit) {
  for (std::size_t i = 0; i < 18; i += 2) batch_.set(i, 1, 3e-6);
  const ResultTable rows = operator_rows(batch_.plan, batch_.items);
  EXPECT_NEAR(value_in(rows, "ms_per_megapixel", "reinhard02"), (3e-6 + 1e-6 + 1e-6) * 1e9 / 100, 1e-9);
  EXPECT_NEAR(value_in(rows, "ms_per_megapixel", "bilateral"), (1e-6 + 1e-6) * 1e9 / 100, 1e-9);
}

TEST_F(BatchSummary, TheReportComparesEachInputOverTheViewsThatAllOperatorsHave) {
  batch_.set(0, 0.1);
  batch_.fail(1);
  const BatchReport report = batch_report(batch_.plan, batch_.items, folder_.path(), {});
  bool seen = false;
  for (const ReportSection& section : report.page.sections)
    for (const auto& block : section.blocks)
      if (const auto* table = std::get_if<ReportTable>(&block); table && table->headings.front() == "input") {
        seen = true;
        EXPECT_EQ(std::get<std::string>(table->rows.at(0).at(0)), "field (8 of 9 views)");
        EXPECT_DOUBLE_EQ(std::get<double>(table->rows.at(0).at(1)), 1);
      }
  EXPECT_TRUE(seen);
}

class BatchNotes : public BatchCommand {};

TEST_F(BatchNotes, TheTerminalSaysWhyAMetricIsLeftOutOfSomeInputs) {
  write_scene_image(parent_.path() / "relative.hdr", SceneImage(64, 48, {1, 1, 1}));
  Json study = tiny_batch();
  study["metrics"] = {"all"};
  study["inputs"][0]["views"] = "centre";
  study["inputs"].push_back(Json::object({{"image", "relative.hdr"}}));
  write_tiny_batch(parent_.path(), study);
  const std::string out = run("out").out;
  EXPECT_NE(out.find("Over 1 of 2 views, those that all operators have: drim_share_any, "), std::string::npos)
      << out;
  EXPECT_NE(out.find("Left out: drim and feature_content_adaptive for relative.hdr, whose unit is not known"),
            std::string::npos)
      << out;
}

}  // namespace
}  // namespace plenolab
