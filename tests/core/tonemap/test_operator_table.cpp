#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/tonemap/colour_ratio.h"
#include "core/tonemap/histogram_adjustment.h"
#include "core/tonemap/operator.h"
#include "tests/core/tonemap/tone_images.h"

namespace plenolab {
namespace {

struct Case {
  const OperatorInfo* info;
  const OperatorVariant* variant;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const OperatorVariant& variant : info.variants) cases.push_back({&info, &variant});
  return cases;
}

class EveryOperator : public testing::TestWithParam<Case> {
 protected:
  const OperatorInfo& info() const { return *GetParam().info; }
  const OperatorVariant& variant() const { return *GetParam().variant; }

  /// The image mapped by the variant: alone, or as the first frame of a video whose key views are the image.
  ToneMapped map(const SceneImage& image, int threads = 1, const SettingValues& values = {}) const {
    if (variant().scope == OperatorScope::kFrame) return first_frame(image, threads, values).mapped;
    return tone_map(info(), variant().id, values, view_of(image), threads);
  }

  MappedFrame first_frame(const SceneImage& image, int threads, const SettingValues& values) const {
    const ViewStatistics s = measure_view(image);
    FrameInput frame;
    frame.view = &image;
    frame.key_views.assign(2, evaluate(s, log_floor(s)));
    frame.weights = {0.25, 0.75};
    frame.threads = threads;
    return info().map_frame(variant().id, values, frame, std::nullopt);
  }

  static OperatorView view_of(const SceneImage& image) {
    auto disparity = std::make_shared<DisparityMap>(image.width(), image.height(), 1.0f);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width() / 2; ++x) disparity->at(x, y) = 9;
    return {std::make_shared<SceneImage>(image), disparity};
  }
};

void expect_displayable(const ToneMapped& mapped, const std::string& name) {
  for (const Rgb& c : mapped.image.pixels())
    for (const float v : {c.r, c.g, c.b})
      ASSERT_TRUE(v >= 0 && v <= 1) << name << " gives " << v;  // false for NaN
}

TEST_P(EveryOperator, GivesFiniteValuesInRangeOnExtremeImages) {
  for (const NamedImage& extreme : extreme_images()) {
    const ToneMapped mapped = map(extreme.image);
    ASSERT_EQ(mapped.image.width(), extreme.image.width());
    ASSERT_EQ(mapped.image.height(), extreme.image.height());
    expect_displayable(mapped, extreme.name);
  }
}

TEST_P(EveryOperator, RepeatsItselfAndDoesNotDependOnThreads) {
  for (const NamedImage& extreme : extreme_images()) {
    const ToneMapped once = map(extreme.image, 1);
    for (const int threads : {1, 2, 5}) {
      const ToneMapped again = map(extreme.image, threads);
      EXPECT_EQ(once.image, again.image) << extreme.name << ", " << threads << " threads";
      EXPECT_EQ(once.counts, again.counts) << extreme.name;
    }
  }
}

TEST_P(EveryOperator, CountsEveryRepairedValueAndMapsTheRepairedImageAlike) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  SceneImage image = random_scene(17, 11);
  image.at(1, 1) = {nan, 1, nan};
  image.at(2, 2) = {inf, inf, inf};
  image.at(3, 3) = {-1, 2, -inf};
  const ToneMapped mapped = map(image);
  EXPECT_EQ(mapped.counts.repairs, (PixelRepairs{.nan = 2, .positive_infinity = 3, .negative = 2}));
  repair(image);
  EXPECT_EQ(map(image).image, mapped.image);
  EXPECT_EQ(map(image).counts.repairs, PixelRepairs{});
}

TEST_P(EveryOperator, KeepsABlackImageBlack) {
  for (const SceneImage& black : {SceneImage(9, 7), grey_image(1, 1, [](int, int) { return -1.0f; })})
    EXPECT_EQ(map(black).image, DisplayImage(black.width(), black.height()));
}

TEST_P(EveryOperator, KeepsColourlessImagesColourless) {
  const SceneImage grey =
      grey_image(31, 7, [](int x, int y) { return std::pow(10.0f, 0.1f * static_cast<float>(x - y)); });
  const DisplayImage image = map(grey).image;
  for (const Rgb& c : image.pixels()) {
    ASSERT_EQ(c.r, c.g);
    ASSERT_EQ(c.g, c.b);
  }
}

TEST_P(EveryOperator, AcceptsBothEndsOfEverySetting) {
  const SceneImage image = random_scene(17, 11);
  for (const Setting& s : info().settings)
    for (const double value : {s.minimum, s.maximum}) {
      SettingValues values = default_values(info().settings);
      if (s.name == "filter" || s.name == "limits") continue;                       // choices, covered below
      if (s.name.starts_with("display_") || s.name.starts_with("luma_")) continue;  // must keep their order
      values[s.name] = {value, false};
      expect_displayable(map(image, 1, values), s.name + "=" + std::to_string(value));
    }
}

TEST_P(EveryOperator, AcceptsEveryChoiceOfEverySetting) {
  const SceneImage image = random_scene(17, 11);
  for (const Setting& s : info().settings)
    for (const std::string& choice : s.choices)
      expect_displayable(
          map(image, 1, parse_settings(info().id, info().settings, std::vector{s.name + "=" + choice})),
          choice);
}

INSTANTIATE_TEST_SUITE_P(Table, EveryOperator, testing::ValuesIn(all_cases()), [](const auto& test) {
  std::string name = test.param.info->id + "_" + test.param.variant->id;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST(OperatorTable, EntriesAreCompleteAndIdsUnique) {
  std::set<std::string> ids;
  for (const OperatorInfo& info : tone_mapping_operators()) {
    EXPECT_TRUE(ids.insert(info.id).second) << info.id;
    EXPECT_FALSE(info.title.empty() || info.description.empty() || info.source.empty() ||
                 info.input_unit.empty());
    ASSERT_FALSE(info.variants.empty());
    for (const OperatorVariant& v : info.variants) {
      EXPECT_FALSE(v.description.empty()) << info.id << " " << v.id;
      EXPECT_TRUE(v.scope == OperatorScope::kFrame ? info.map_frame != nullptr : info.fit != nullptr);
    }
    for (const Setting& s : info.settings) {
      EXPECT_FALSE(s.help.empty()) << info.id << " " << s.name;
      EXPECT_LT(s.minimum, s.maximum) << s.name;
      EXPECT_TRUE(s.default_value >= s.minimum && s.default_value <= s.maximum) << info.id << " " << s.name;
      if (s.choices.empty()) continue;
      EXPECT_EQ(s.maximum, static_cast<double>(s.choices.size()) - 1) << s.name;
    }
  }
}

TEST(OperatorTable, DefaultsOfTheTableAreThoseOfTheOperators) {
  const SceneImage image = random_scene(24, 16);
  for (const OperatorInfo& info : tone_mapping_operators()) {
    const auto map = [&](const SettingValues& values) {
      return tone_map(info, info.variants[0].id, values, {std::make_shared<SceneImage>(image), nullptr}, 1)
          .image;
    };
    EXPECT_EQ(map({}), map(default_values(info.settings))) << info.id;
  }
}

TEST(OperatorTable, UnknownNamesAndVideoVariantsOnImagesAreErrors) {
  EXPECT_THROW(find_operator("nonsense"), InputError);
  const OperatorInfo& devlin = find_operator("reinhard05");
  EXPECT_THROW(find_variant(devlin, "nonsense"), InputError);
  const OperatorView view{std::make_shared<SceneImage>(2, 2), nullptr};
  EXPECT_THROW(tone_map(devlin, "interpolate-statistics", {}, view), InputError);
}

/// Two views of which one sees a light.
struct TwoViews {
  SceneImage dark = random_scene(24, 16, 2, 10), bright = dark;
  ViewStatistics statistics[2];
  double floor;
  TwoViews() {
    for (int x = 0; x < 8; ++x) bright.at(x, 2) = {1e5f, 1e5f, 1e5f};
    statistics[0] = measure_view(dark);
    statistics[1] = measure_view(bright);
    floor = log_floor(merge(statistics[0], statistics[1]));
  }
  FitScope scope() const {
    return {2,
            [this](int i) {
              return OperatorView{std::make_shared<SceneImage>(i == 0 ? dark : bright), nullptr};
            },
            evaluate(merge(statistics[0], statistics[1]), floor), floor, 1};
  }
};

TEST(OperatorTable, JointFitsMapTheSamePixelAlikeInEveryViewAndNaiveOnesDoNot) {
  const TwoViews views;
  for (const char* id : {"reinhard05", "histogram", "reinhard02", "robust"}) {
    const OperatorInfo& info = find_operator(id);
    const FittedOperator joint = info.fit("joint", {}, views.scope());
    const auto pixel = [](const FittedOperator& f, const SceneImage& view) {
      return f.apply({std::make_shared<SceneImage>(view), nullptr}, 1).image.at(20, 12);
    };
    EXPECT_EQ(pixel(joint, views.dark), pixel(joint, views.bright)) << id;
    const auto alone = [&](const SceneImage& view) {
      return tone_map(info, "naive", {}, {std::make_shared<SceneImage>(view), nullptr}).image.at(20, 12);
    };
    EXPECT_NE(alone(views.dark), alone(views.bright)) << id;
  }
}

TEST(OperatorTable, FramesWithStatisticsOfOneKeyViewEqualMappingThatViewByItself) {
  const TwoViews views;
  for (const char* id : {"reinhard05", "reinhard02", "robust"}) {
    const OperatorInfo& info = find_operator(id);
    FrameInput frame{
        .view = &views.bright,
        .key_views = {evaluate(views.statistics[0], views.floor), evaluate(views.statistics[1], views.floor)},
        .weights = {0, 1}};
    const MappedFrame mapped = info.map_frame("interpolate-statistics", {}, frame, std::nullopt);
    const FittedOperator own =
        info.fit("naive", {},
                 {1,
                  [&](int) {
                    return OperatorView{std::make_shared<SceneImage>(views.bright), nullptr};
                  },
                  frame.key_views[1], views.floor, 1});
    EXPECT_EQ(mapped.mapped.image, own.apply({std::make_shared<SceneImage>(views.bright), nullptr}, 1).image)
        << id;
  }
}

TEST(OperatorTable, FramesAdaptInTimeAndForgetAtACut) {
  const TwoViews views;
  for (const char* id : {"reinhard05", "reinhard02", "robust"}) {
    const OperatorInfo& info = find_operator(id);
    FrameInput frame{.view = &views.dark,
                     .key_views = {evaluate(views.statistics[0], views.floor)},
                     .weights = {1},
                     .step_s = 0.02};
    const MappedFrame dark = info.map_frame("interpolate-statistics", {}, frame, std::nullopt);
    frame.view = &views.bright;
    frame.key_views = {evaluate(views.statistics[1], views.floor)};
    const MappedFrame next = info.map_frame("interpolate-statistics", {}, frame, dark.state);
    const MappedFrame cut = info.map_frame("interpolate-statistics", {}, frame, std::nullopt);
    frame.step_s = 1e4;
    const MappedFrame settled = info.map_frame("interpolate-statistics", {}, frame, dark.state);
    EXPECT_EQ(settled.mapped.image, cut.mapped.image) << id;
    const auto grey = [](const MappedFrame& f) {
      return static_cast<double>(luminance(f.mapped.image.at(20, 12)));
    };
    EXPECT_LT(std::abs(grey(next) - grey(dark)), std::abs(grey(cut) - grey(dark))) << id;
  }
}

TEST(OperatorTable, TheUnitOfRelativeRadianceDoesNotMatterAndThatOfDeclaredRadianceDoes) {
  const SceneImage image = random_scene(48, 32, 5);
  SceneImage brighter = image;
  for (Rgb& c : brighter.pixels()) c = 1024.0f * c;
  const auto map = [](const OperatorInfo& info, const SceneImage& view, std::optional<double> unit) {
    const OperatorView shown{std::make_shared<SceneImage>(view), nullptr};
    return info.fit(info.variants.front().id, {}, scope_of_image(shown, 1, unit)).apply(shown, 1).image;
  };
  const auto largest_difference = [](const DisplayImage& a, const DisplayImage& b) {
    float most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      most = std::max(most, std::abs(luminance(a.pixels()[i]) - luminance(b.pixels()[i])));
    return most;
  };
  for (const char* id : {"histogram", "reinhard05", "pq", "content-adaptive"}) {
    const OperatorInfo& info = find_operator(id);
    for (const float scale : {1e-9f, 1e9f}) {  // rounding moves pixels at the ends of histogram bins
      SceneImage scaled = image;
      for (Rgb& c : scaled.pixels()) c = scale * c;
      EXPECT_LT(largest_difference(map(info, image, std::nullopt), map(info, scaled, std::nullopt)), 0.01f)
          << id << " × " << scale;
    }
    EXPECT_LT(largest_difference(map(info, image, std::nullopt), map(info, brighter, std::nullopt)), 0.002f)
        << id;
    EXPECT_GT(largest_difference(map(info, image, 1.0), map(info, brighter, 1.0)), 0.05f) << id;
    EXPECT_LT(largest_difference(map(info, image, 1024.0), map(info, brighter, 1.0)), 0.002f) << id;
  }
}

TEST(OperatorTable, AUnitThatIsSetIsTakenWhateverIsDeclared) {
  const SceneImage image = random_scene(24, 16, 5);
  const OperatorView view{std::make_shared<SceneImage>(image), nullptr};
  for (const auto& [id, name] : {std::pair{"histogram", "unit"}, std::pair{"reinhard05", "exposure"}}) {
    const OperatorInfo& info = find_operator(id);
    const SettingValues set{{name, {.number = 3}}};
    const auto map = [&](const SettingValues& values, std::optional<double> unit) {
      return info.fit("naive", values, scope_of_image(view, 1, unit)).apply(view, 1).image;
    };
    EXPECT_EQ(map(set, std::nullopt), map(set, 1.0)) << id;
    EXPECT_EQ(map(set, std::nullopt), map({}, 3.0)) << id;
  }
}

TEST(OperatorTable, ARangeThatFitsTheDisplayIsMappedWithoutReadingViewsForTheHistogram) {
  const SceneImage image = random_scene(48, 32, 2);
  const OperatorView view{std::make_shared<SceneImage>(image), nullptr};
  FitScope scope = scope_of_image(view, 1);
  const HistogramOptions options;
  const LogHistogram histogram =
      measure_histogram(image, scope.floor, scope.statistics.log_min, scope.statistics.log_max, options.bins);
  const DisplayImage full = apply(fit(options, histogram, scope.floor), image).image;
  scope.load = [](int) -> OperatorView {
    ADD_FAILURE() << "a view was read";
    return {};
  };
  EXPECT_EQ(find_operator("histogram").fit("naive", {}, scope).apply(view, 1).image, full);
}

TEST(ColourRatio, RunsOfColourlessPixelsGiveTheSameBitsAndCountsAsThreeChannels) {
  for (const int colourless : {0, 5, 16, 40, 67}) {
    const SceneImage image = random_scene(67, 1);
    std::vector<Rgb> scene(image.pixels().begin(), image.pixels().end());
    for (int x = 0; x < colourless; ++x) {
      const float level = x % 7 == 0 ? 0.0f : scene[static_cast<std::size_t>(x)].g;
      scene[static_cast<std::size_t>(x)] = {level, level, level};
    }
    std::vector<float> luma(scene.size());
    for (std::size_t i = 0; i < luma.size(); ++i) luma[i] = 0.02f * static_cast<float>(i);
    std::vector<Rgb> pruned(scene.size()), full(scene.size());
    EXPECT_EQ(apply_colour_ratio(scene, luma, 0.7, pruned, true),
              apply_colour_ratio(scene, luma, 0.7, full, false));
    EXPECT_EQ(pruned, full) << colourless;
  }
}

}  // namespace
}  // namespace plenolab
