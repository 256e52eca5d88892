#include "experiments/batch/study.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/batch/plan.h"
#include "tests/experiments/batch/tiny_batch.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

using Json = nlohmann::json;

std::string refusal(const Json& study) {
  return message_of([&] { parse_batch_study(study.dump(), "s.json"); });
}

TEST(BatchStudy, HasDefaultsForAllThatIsNotSaid) {
  const BatchStudy study = parse_batch_study(
      R"({"format": "plenolab-batch", "version": 1, "inputs": [{"scene": "desk"}, {"image": "a.exr"}],
          "operators": [{"name": "reinhard02"}]})",
      "s.json");
  EXPECT_EQ(study.inputs[0].preset, "quick");
  EXPECT_EQ(study.inputs[0].views, BatchViews{});
  EXPECT_EQ(study.inputs[1].preset, "");
  EXPECT_EQ(study.metrics, std::vector<std::string>{"all"});
  EXPECT_EQ(study.repeat, 3);
  EXPECT_FALSE(study.seed);
}

TEST(BatchStudy, ViewsOfTheStudyHoldForInputsThatHaveNoneOfTheirOwn) {
  Json json = tiny_batch();
  json["views"] = Json::parse("[[2, 1], [0, 0]]");
  json["inputs"].push_back({{"scene", "desk"}});
  const BatchStudy study = parse_batch_study(json.dump(), "s.json");
  EXPECT_EQ(study.inputs[0].views.which, BatchViews::Which::kAll);
  EXPECT_EQ(study.inputs[1].views.listed, (std::vector<BatchView>{{2, 1}, {0, 0}}));
}

TEST(BatchStudy, SettingsAreNumbersOrWords) {
  Json json = tiny_batch();
  json["operators"][0]["settings"] = {{"a", 0.5}, {"b", -2}, {"c", "auto"}};
  EXPECT_EQ(parse_batch_study(json.dump(), "s.json").operators[0].settings,
            (std::vector<std::string>{"a=0.5", "b=-2", "c=auto"}));
}

TEST(BatchStudy, EveryMistakeIsOneSentenceThatNamesFileAndKey) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"({"/format": "plenolab-study"})", R"("format" must be "plenolab-batch")"},
      {R"({"/version": 2})", R"("version" must be 1)"},
      {R"({"/operatr": []})", R"("operatr" is not a key)"},
      {R"({"/inputs": []})", R"("inputs" must hold at least one)"},
      {R"({"/inputs/0/scene": "desk"})", R"("inputs[0].light_field" and "scene" cannot both)"},
      {R"({"/inputs/0": {}})", R"("inputs[0].scene" is missing)"},
      {R"({"/inputs/0/preset": "tiny"})", R"("inputs[0].preset" is for scenes only)"},
      {R"({"/inputs/0": {"scene": "desk", "preset": "huge"}})", "tiny, quick or paper"},
      {R"({"/inputs/0": {"scene": "desk", "cd_m2_per_unit": 1}})", "cd/m² already"},
      {R"({"/inputs/0": {"scene": "all", "name": "x"}})", "for one input"},
      {R"({"/inputs/0": {"image": "a.exr", "views": "all"}})", "not for single images"},
      {R"({"/inputs/0/cd_m2_per_unit": 0})", "must be positive"},
      {R"({"/inputs/0/views": "keys"})", R"(must be "centre", "all")"},
      {R"({"/inputs/0/views": []})", R"(must be "centre", "all")"},
      {R"({"/inputs/0/views": [[1.5, 0]]})", "[column, row]"},
      {R"({"/inputs/0/views": [[1, -1]]})", "[column, row]"},
      {R"({"/inputs/0/views": [[1, 0], [1, 0]]})", "[1, 0] twice"},
      {R"({"/operators": []})", R"("operators" must hold at least one)"},
      {R"({"/operators/1/settings/contrast": true})", "must be a number or a text"},
      {R"({"/operators/1/settings": {"a=b": 1}})", "is no setting"},
      {R"({"/metrics": []})", R"("metrics" must name at least one)"},
      {R"({"/viewing": {"distance_m": 0}})", "distance_m is 0"},
      {R"({"/viewing": {"distance": 1}})", R"("viewing.distance" is not a key)"},
      {R"({"/repeat": 0})", R"("repeat" must lie in [1, 1000])"},
      {R"({"/seed": -1})", R"("seed" must lie in)"}};
  for (const auto& entry : cases) {
    Json study = tiny_batch();
    const Json change = Json::parse(entry.first);
    study[Json::json_pointer(change.begin().key())] = change.begin().value();
    const std::string message = refusal(study);
    EXPECT_TRUE(message.starts_with("s.json: ")) << message;
    EXPECT_NE(message.find(entry.second), std::string::npos) << message;
  }
  EXPECT_NE(message_of([] { parse_batch_study("{", "s.json"); }).find("not valid JSON"), std::string::npos);
  EXPECT_EQ(message_of([] { parse_batch_study(R"({"repeat": 1, "repeat": 7})", "s.json"); }),
            R"(s.json has the key "repeat" twice in one object)");
}

class BatchPlanTest : public testing::Test {
 protected:
  std::string refused(const Json& study) {
    return message_of([&] { plan_batch(write_tiny_batch(folder_.path(), study), 1); });
  }
  BatchPlan planned(const Json& study) { return plan_batch(write_tiny_batch(folder_.path(), study), 1); }

  TemporaryFolder folder_;
};

TEST_F(BatchPlanTest, HasAnItemForEachViewAndOperatorInputByInput) {
  const BatchPlan plan = planned(tiny_batch());
  ASSERT_EQ(plan.items.size(), 18u);
  EXPECT_EQ(plan.title(plan.items[0]), "field 0,0 reinhard02 naive");
  EXPECT_EQ(plan.title(plan.items[3]), "field 1,0 bilateral naive contrast=30");
}

TEST_F(BatchPlanTest, AllThatDecidesAResultDecidesItsKey) {
  const std::string key = planned(tiny_batch()).items[1].key;
  EXPECT_EQ(planned(tiny_batch()).items[1].key, key);
  for (const char* change :
       {R"({"/operators/1/settings/contrast": 31})", R"({"/operators/1/variant": "enhanced"})",
        R"({"/inputs/0/cd_m2_per_unit": 21})", R"({"/repeat": 2})", R"({"/inputs/0/views": [[1, 0]]})"}) {
    Json study = tiny_batch();
    const Json changed = Json::parse(change);
    study[Json::json_pointer(changed.begin().key())] = changed.begin().value();
    EXPECT_NE(planned(study).items[1].key, key) << change;
  }
  Json same = tiny_batch();
  same["title"] = "another title";
  same["inputs"][0]["name"] = "another name";
  EXPECT_EQ(planned(same).items[1].key, key) << "names decide nothing";
  const std::string metric = planned(same).metric_key(*planned(same).metrics.front());
  same["metrics"] = {"tmqi", "brisque"};
  EXPECT_EQ(planned(same).items[1].key, key) << "metrics have keys of their own";
  EXPECT_EQ(planned(same).metric_key(*planned(same).metrics.front()), metric);
  same["viewing"] = {{"distance_m", 1}};
  EXPECT_EQ(planned(same).items[1].key, key) << "nobody views what is only mapped";
  EXPECT_NE(planned(same).metric_key(*planned(same).metrics.front()), metric);
  std::filesystem::remove_all(folder_.path() / "field");
  written_plane(folder_.path() / "field", -1);
  EXPECT_NE(planned(tiny_batch()).items[1].key, key) << "another light field of the same name";
}

TEST_F(BatchPlanTest, NamesWhatThereIsNotWithTheNearestThatThereIs) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"({"/operators/0/name": "reinhard20"})", R"("operators[0]": )"},
      {R"({"/operators/0/variant": "joint2"})", R"("operators[0]": )"},
      {R"({"/operators/1/settings/contrast": "much"})", R"("operators[1]": setting contrast)"},
      {R"({"/operators/0/variant": "interpolate-statistics"})", "maps frames of a video"},
      {R"({"/operators/0": {"name": "bilateral", "settings": {"contrast": 30}}})", "there twice"},
      {R"({"/metrics": ["tmqj"]})", R"("metrics": there is no metric "tmqj")"},
      {R"({"/metrics": ["psnr"]})", "does not compare a tone mapped image"},
      {R"({"/inputs/0": {"scene": "celar"}})",
       R"(the scene "celar", which there is not; did you mean 'cellar')"},
      {R"({"/inputs/1": {"light_field": "field"}})", R"(holds "field" twice)"}};
  for (const auto& entry : cases) {
    Json study = tiny_batch();
    const Json change = Json::parse(entry.first);
    study[Json::json_pointer(change.begin().key())] = change.begin().value();
    const std::string message = refused(study);
    EXPECT_NE(message.find("study.json: "), std::string::npos) << message;
    EXPECT_NE(message.find(entry.second), std::string::npos) << message;
  }
}

TEST_F(BatchPlanTest, InputsThatCannotBeOpenedOrScaledBecomeItemsWithAProblem) {
  Json study = tiny_batch();
  study["metrics"] = {"drim"};
  study["inputs"] = Json::parse(R"([{"light_field": "nowhere"}, {"image": "nothing.exr"},
      {"light_field": "field"}, {"light_field": "field", "name": "far", "views": [[7, 0]]}])");
  const BatchPlan plan = planned(study);
  ASSERT_EQ(plan.items.size(), 8u);
  EXPECT_NE(plan.items[0].problem.find("nowhere does not exist"), std::string::npos) << plan.items[0].problem;
  EXPECT_NE(plan.items[2].problem.find("nothing.exr"), std::string::npos) << plan.items[2].problem;
  EXPECT_EQ(plan.items[4].problem, "") << "it can be mapped";
  EXPECT_NE(plan.problems_of(plan.items[4]).find("drim: it needs the luminance of a value of 1"),
            std::string::npos)
      << plan.problems_of(plan.items[4]);
  EXPECT_NE(plan.items[6].problem.find("no view [7, 0]"), std::string::npos) << plan.items[6].problem;
}

TEST_F(BatchPlanTest, MetricsOfAbsoluteLuminanceAreLeftOutOfAllWhereTheUnitIsUnknown) {
  Json study = tiny_batch();
  study["metrics"] = {"all"};
  study["inputs"][0].erase("cd_m2_per_unit");
  const BatchPlan plan = planned(study);
  EXPECT_EQ(plan.items[0].problem, "");
  for (const Metric* metric : plan.metrics_for(plan.inputs[0])) EXPECT_FALSE(metric->absolute_luminance);
  EXPECT_LT(plan.metrics_for(plan.inputs[0]).size(), plan.metrics.size());
}

TEST(BatchShards, ShareAllItemsOutOnceAndEvenly) {
  for (const std::size_t items : {0u, 1u, 7u, 100u})
    for (const int count : {1, 2, 3, 11}) {
      std::vector<std::size_t> all;
      for (int index = 1; index <= count; ++index) {
        const std::vector<std::size_t> own = items_of({index, count}, items);
        EXPECT_LE(own.size(), items / static_cast<std::size_t>(count) + 1);
        all.insert(all.end(), own.begin(), own.end());
      }
      ASSERT_EQ(all.size(), items);
      for (std::size_t i = 0; i < items; ++i) EXPECT_EQ(all[i], i);
    }
}

TEST(BatchShards, AreReadStrictly) {
  EXPECT_EQ(parse_shard("2/3").index, 2);
  for (const char* wrong : {"", "1", "0/2", "3/2", "1/2/3", "a/b", "1/", "-1/2", "1/99999", " 1/2"})
    EXPECT_THROW(parse_shard(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace plenolab
