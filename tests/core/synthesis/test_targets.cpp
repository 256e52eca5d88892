#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cstdint>
#include <vector>

#include "core/synthesis/synthesizer.h"
#include "test_fields.h"

namespace plenolab {
namespace {

using namespace testing_support;

/// Lets vector code run on one instruction set only, for as long as it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnlyTarget() { hwy::SetSupportedTargetsForTest(0); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
};

TEST(Synthesis, IsTheSameBitByBitOnEveryInstructionSetOfThisMachine) {
  const LightField field = stepped_field(grid_of(2, 2, 90, 50), 18, 0.02f, 51);
  const auto expected = synthesize(field, {0.3, 0.6});
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const OnlyTarget only(target);
    const auto view = synthesize(field, {0.3, 0.6});
    EXPECT_TRUE(view.image == expected.image) << hwy::TargetName(target);
    EXPECT_TRUE(view.visible_views == expected.visible_views) << hwy::TargetName(target);
    EXPECT_EQ(view.statistics.search_samples, expected.statistics.search_samples) << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace plenolab
