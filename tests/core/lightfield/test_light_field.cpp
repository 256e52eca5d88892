#include "core/lightfield/light_field.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/lightfield/synthetic.h"

namespace plenolab {
namespace {

constexpr ViewGrid kGrid{.columns = 4, .rows = 2, .width = 8, .height = 4};
constexpr std::size_t kViewBytes = 8 * 4 * 16;

KeyView<SceneReferred> plain_view(float disparity) {
  return {SceneImage(8, 4), DisparityMap(8, 4, disparity)};
}

TEST(LightField, LoadsEveryViewOnceWhileMemorySuffices) {
  std::atomic<int> loads{0};
  const LightField lf(kGrid, RadianceUnit::kCdM2, "x", [&](int c, int r) {
    ++loads;
    return plain_view(static_cast<float>(c + r));
  });
  EXPECT_EQ(loads, 0);
  parallel_for(400, 1, 4, [&](int begin, int) {
    EXPECT_EQ(lf.view(begin % 4, begin / 4 % 2)->disparity.at(0, 0), begin % 4 + begin / 4 % 2);
  });
  EXPECT_EQ(loads, 8);
  EXPECT_EQ(lf.max_disparity_px(), 4);
  EXPECT_EQ(loads, 8);
}

TEST(LightField, DropsTheLeastRecentlyUsedViewsBeyondTheBound) {
  std::vector<int> loads(8, 0);
  const LightField lf(
      kGrid, RadianceUnit::kCdM2, "x",
      [&](int c, int r) {
        ++loads[static_cast<std::size_t>(r * 4 + c)];
        return plain_view(1);
      },
      2 * kViewBytes);
  const auto held = lf.view(0, 0);
  lf.view(1, 0);
  lf.view(0, 0);
  lf.view(2, 0);  // drops (1, 0)
  lf.view(0, 0);
  EXPECT_EQ(loads[0], 1);
  lf.view(1, 0);
  EXPECT_EQ(loads[1], 2);
  lf.view(3, 1);
  lf.view(2, 1);
  EXPECT_EQ(held->disparity.at(7, 3), 1);
}

TEST(LightField, ABoundBelowOneViewStillWorks) {
  const LightField lf(
      kGrid, RadianceUnit::kCdM2, "x", [](int c, int) { return plain_view(static_cast<float>(c)); }, 0);
  EXPECT_EQ(lf.max_disparity_px(), 3);
}

TEST(LightField, ConcurrentUsersOfOneViewShareOneLoad) {
  std::atomic<int> loads{0};
  const LightField lf(kGrid, RadianceUnit::kCdM2, "x", [&](int, int) {
    ++loads;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return plain_view(1);
  });
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) threads.emplace_back([&] { lf.view(1, 1); });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(loads, 1);
}

TEST(LightField, AFailedLoadIsReportedAndTriedAgain) {
  int calls = 0;
  const LightField lf(kGrid, RadianceUnit::kCdM2, "x", [&](int, int) {
    if (++calls == 1) throw InputError("disk on fire");
    return plain_view(2);
  });
  EXPECT_THROW(lf.view(0, 0), InputError);
  EXPECT_EQ(lf.view(0, 0)->disparity.at(0, 0), 2);
}

TEST(LightField, ViewsOfAnotherSizeAndWrongCountsAreRefused) {
  const LightField lf(kGrid, RadianceUnit::kCdM2, "night", [](int, int) {
    return KeyView<SceneReferred>{SceneImage(8, 5), DisparityMap(8, 4)};
  });
  EXPECT_THROW(lf.view(0, 0), InputError);
  EXPECT_THROW(LightField::from_views(kGrid, RadianceUnit::kCdM2, "x", {plain_view(1)}), InputError);
  EXPECT_THROW(lf.view(4, 0), std::logic_error);
}

TEST(ViewGrid, DisparityAndDepthAreInverse) {
  const ViewGrid grid{.columns = 3, .spacing_x_m = 0.1, .width = 1000, .height = 500, .fov_h_deg = 90};
  EXPECT_NEAR(grid.disparity_px(5), 1000 * 0.1 / (2 * 5), 1e-12);  // tan 45° = 1
  EXPECT_EQ(grid.disparity_px(INFINITY), 0);
  EXPECT_TRUE(std::isinf(grid.depth_m(0)));
  for (const double z : {1e-6, 0.3, 7.0, 1e8}) EXPECT_NEAR(grid.depth_m(grid.disparity_px(z)) / z, 1, 1e-12);
}

TEST(ViewGrid, ValuesOutOfRangeAreNamed) {
  const std::pair<ViewGrid, const char*> cases[] = {
      {{.columns = 0}, "0 × 1"}, {{.spacing_x_m = -1}, "-1"}, {{.spacing_y_m = INFINITY}, "inf"},
      {{.height = 0}, "1 × 0"},  {{.fov_h_deg = 180}, "180"}, {{.fov_h_deg = std::nan("")}, "nan"}};
  for (const auto& [grid, word] : cases) {
    try {
      grid.validate();
      ADD_FAILURE() << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace plenolab
