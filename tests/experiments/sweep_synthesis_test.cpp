#include "experiments/sweep_synthesis.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/error.h"

namespace plenolab {
namespace {

constexpr int kSide = 512;

/// Four views of a plane at disparity 4.
SweepStimulus plane_stimulus() {
  const ViewGrid grid{.columns = 2, .rows = 2, .width = kSide, .height = kSide};
  std::vector<KeyView<SceneReferred>> views;
  for (int v = 0; v < 4; ++v)
    views.push_back({SceneImage(kSide, kSide, Rgb{1, 1, 1}), DisparityMap(kSide, kSide, 4)});
  return {"plane",
          LightField::from_views(grid, RadianceUnit::kRelative, "plane", std::move(views)),
          {{0.5, 0.5}},
          [](CameraPosition) {
            return SceneImage(kSide, kSide, Rgb{1, 1, 0.5f});
          }};
}

std::map<std::string, double> sweep_one(const SynthesisSetting& setting) {
  SynthesisSweepOptions options;
  options.settings = {setting};
  options.runs = 1;
  options.threads = 1;
  std::map<std::string, double> values;
  const ResultTable rows = sweep_synthesis({plane_stimulus()}, options);
  for (const ResultRow& row : rows.rows()) values[row.quantity] = row.value;
  return values;
}

TEST(SynthesisSweep, TellsMemoryHeldFromTheMeasuredPeak) {
  const auto four = sweep_one({.key_views = 4}), one = sweep_one({.key_views = 1});
  constexpr double kResult_mib = kSide * kSide * 12 / 0x1p20;
  EXPECT_GT(four.at("memory_held_mib"), 5 * kResult_mib);  // four key views with disparity, and the result
  EXPECT_LT(one.at("memory_held_mib"), four.at("memory_held_mib"));
  if (!four.contains("memory_peak_mib")) GTEST_SKIP() << "the system does not reset the peak";
  // Key views are loaded before: the peak holds their prepared form and the result, and working space.
  EXPECT_GT(four.at("memory_peak_mib"), 2 * kResult_mib);
  EXPECT_LT(four.at("memory_peak_mib"), 20 * kResult_mib);
  EXPECT_LT(one.at("memory_peak_mib"), four.at("memory_peak_mib"));
}

TEST(SynthesisSweep, RefusesNoSettingsAndNoRuns) {
  SynthesisSweepOptions options;
  options.runs = 0;
  EXPECT_THROW(options.validate(), InputError);
  options.runs = 1;
  options.settings.clear();
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace plenolab
