#include <gtest/gtest.h>

#include <regex>

#include "core/synthesis/synthesizer.h"

namespace plenolab {
namespace {

TEST(PruningReasons, HoldNumbersForPeople) {
  const ViewGrid grid{.columns = 2, .rows = 2, .width = 24, .height = 16};
  std::vector<KeyView<SceneReferred>> views;
  for (int v = 0; v < 4; ++v) {
    KeyView<SceneReferred> view{SceneImage(24, 16, Rgb{1, 1, 1}), DisparityMap(24, 16, 0.5f)};
    view.disparity.at(3, 3) = 0.5f + 1.0f / 3 / 10;
    views.push_back(std::move(view));
  }
  const auto field = LightField::from_views(grid, RadianceUnit::kRelative, "plane", std::move(views));
  const auto view = synthesize(field, {0.4, 0.3});
  ASSERT_GE(view.pruned.size(), 3u);
  const std::regex raw_digits("\\.0*[1-9][0-9]{3,}");  // more than three that count
  for (const PrunedStage& stage : view.pruned)
    EXPECT_FALSE(std::regex_search(stage.reason, raw_digits)) << stage.reason;
}

}  // namespace
}  // namespace plenolab
