#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/synthesis/synthesizer.h"
#include "test_fields.h"

namespace plenolab {
namespace {

using namespace testing_support;

constexpr double kFront = 13.37, kBack = 2;  ///< the key views sample the bar at different phases

/// A red vertical bar [left, left + width) at disparity 13.37 before a green background at disparity 2,
/// sampled at pixel centres.
LightField bar_field(double left, double width) {
  return field_of(grid_of(2, 2, 120, 16), [=](int c, int, int x, int) {
    const double u = x + 0.5 + c * kFront;
    const bool front = u >= left && u < left + width;
    return std::pair(front ? Rgb{1, 0, 0} : Rgb{0, 1, 0}, static_cast<float>(front ? kFront : kBack));
  });
}

/// Mean width of the bar in the novel view (pixels of row 8 that are mostly red), over sub-pixel places.
double seen_width(double width, bool keep_thin) {
  SynthesisOptions options;
  options.keep_thin = keep_thin;
  double sum = 0;
  constexpr int kPlaces = 20;
  for (int n = 0; n < kPlaces; ++n) {
    const auto view = synthesize(bar_field(60 + n * 0.37, width), {0.4 + n * 0.0077, 0.5}, options);
    for (int x = 0; x < 120; ++x) sum += view.image.at(x, 8).r > view.image.at(x, 8).g ? 1 : 0;
  }
  return sum / kPlaces;
}

TEST(ThinStructures, VanishWithTheStandardRules) {
  EXPECT_LT(seen_width(1, false), 0.3);
  EXPECT_LT(seen_width(2, false), 1.5);
  EXPECT_NEAR(seen_width(3, false), 2, 0.6);
  EXPECT_NEAR(seen_width(4, false), 3, 0.6);
  EXPECT_NEAR(seen_width(6, false), 5, 0.6);
}

TEST(ThinStructures, StayWithKeepThin) {
  for (double width : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
    const double standard = seen_width(width, false), kept = seen_width(width, true);
    RecordProperty("standard_" + std::to_string(width), std::to_string(standard));
    RecordProperty("kept_" + std::to_string(width), std::to_string(kept));
    EXPECT_GT(kept, standard) << width;
    EXPECT_NEAR(kept, width, 1) << width;
  }
}

TEST(ThinStructures, KeepThinChangesOnlyTheOutlineOfLargeOccludersAndBringsItNearerToTheTruth) {
  const CameraPosition at{0.4, 0.6};
  const auto field = field_of(grid_of(2, 2, 100, 60), [](int c, int r, int x, int y) {
    const bool front = x + c * 10 >= 40 && x + c * 10 < 70 && y + r * 10 >= 20 && y + r * 10 < 45;
    return std::pair(front ? Rgb{1, 0, 0} : Rgb{0, 1, 0}, front ? 10.0f : 1.0f);
  });
  SynthesisOptions standard, thin;
  thin.keep_thin = true;
  const auto a = synthesize(field, at, standard), b = synthesize(field, at, thin);
  int wrong_before = 0, wrong_after = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) {
      const int u = x + 4, v = y + 6;  // 10 px of disparity at (0.4, 0.6)
      const bool front = u >= 40 && u < 70 && v >= 20 && v < 45;
      const bool near_outline =
          u >= 38 && u < 72 && v >= 18 && v < 47 && !(u >= 42 && u < 68 && v >= 22 && v < 43);
      if (!near_outline) {
        EXPECT_EQ(a.image.at(x, y), b.image.at(x, y)) << x << ", " << y;
      }
      wrong_before += (a.image.at(x, y).r > a.image.at(x, y).g) != front ? 1 : 0;
      wrong_after += (b.image.at(x, y).r > b.image.at(x, y).g) != front ? 1 : 0;
    }
  EXPECT_LE(wrong_after, wrong_before);
}

TEST(ThinStructures, WrongDisparitiesOfASingleViewAreNotKept) {
  const auto field = field_of(grid_of(2, 2, 60, 40), [](int c, int r, int x, int y) {
    const bool wrong = c == 0 && r == 0 && x == 30 && y == 20;
    return std::pair(Rgb{0.5f, 0.5f, wrong ? 9.0f : 0.5f}, wrong ? 11.0f : 3.0f);
  });
  SynthesisOptions thin;
  thin.keep_thin = true;
  EXPECT_EQ(synthesize(field, {0.5, 0.5}, thin).statistics.thin, 0u);
}

}  // namespace
}  // namespace plenolab
