#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/tonemap/settings.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

const std::vector<Setting>& some() {
  static const std::vector<Setting> table{
      {"b", 0.5, -1, 1, "", "a number"},
      {.name = "passes",
       .default_value = 4,
       .minimum = 0,
       .maximum = 10,
       .integer = true,
       .automatic = "as needed"},
      {.name = "mode", .default_value = 1, .minimum = 0, .maximum = 1, .choices = {"slow", "fast"}},
  };
  return table;
}

SettingValues parse(std::vector<std::string> texts) {
  return parse_settings("test", some(), texts);
}

TEST(Settings, DefaultsHoldForWhatIsNotGiven) {
  const SettingValues v = parse({"b=-0.25"});
  EXPECT_EQ(v.at("b"), (SettingValue{-0.25, false}));
  EXPECT_TRUE(v.at("passes").automatic);
  EXPECT_EQ(v.at("mode"), (SettingValue{1, false}));
}

TEST(Settings, NamesNumbersAndAutoAreReadAndWrittenAlike) {
  const SettingValues v = parse({"mode=slow", "passes=7", "b=1"});
  EXPECT_EQ(to_text(some()[2], v.at("mode")), "slow");
  EXPECT_EQ(to_text(some()[1], v.at("passes")), "7");
  EXPECT_EQ(to_text(some()[1], parse({"passes=auto"}).at("passes")), "auto");
}

TEST(Settings, ErrorsNameTheSettingTheValueAndWhatIsAllowed) {
  const auto message = [](const std::string& text) { return message_of([&] { parse({text}); }); };
  EXPECT_THAT(message("b=2"), testing::AllOf(testing::HasSubstr("b"), testing::HasSubstr("[-1, 1]"),
                                             testing::HasSubstr("\"2\"")));
  EXPECT_THAT(message("b=nan"), testing::HasSubstr("nan"));
  EXPECT_THAT(message("b=1x"), testing::HasSubstr("1x"));
  EXPECT_THAT(message("b=auto"), testing::HasSubstr("auto"));
  EXPECT_THAT(message("passes=2.5"), testing::HasSubstr("or auto"));
  EXPECT_THAT(message("mode=medium"), testing::HasSubstr("slow, fast"));
  EXPECT_THAT(message("c=1"), testing::HasSubstr("b, passes, mode"));
  EXPECT_THAT(message("b"), testing::HasSubstr("name=value"));
}

}  // namespace
}  // namespace plenolab
