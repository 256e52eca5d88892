#include "core/io/json_reader.h"

#include <gtest/gtest.h>

#include "tests/support/message_of.h"

namespace plenolab {
namespace {

TEST(JsonReader, RefusesAKeyThatAnObjectHasTwice) {
  const auto refusal = [](const char* text) {
    return message_of([&] { parse_json(text, "study.json", 6); });
  };
  EXPECT_EQ(refusal(R"({"repeat": 1, "repeat": 7})"),
            R"(study.json has the key "repeat" twice in one object)");
  EXPECT_EQ(refusal(R"({"a": [{"b": {}, "c": 1, "b": 2}]})"),
            R"(study.json has the key "b" twice in one object)");
  EXPECT_EQ(refusal(R"({"a": {"b": 1}, "\u0061": 2})"), R"(study.json has the key "a" twice in one object)");
  EXPECT_EQ(refusal(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}], "c": {"a": 3}})"), "");
}

TEST(JsonReader, RefusesWhatIsNestedTooDeeply) {
  EXPECT_NO_THROW(parse_json(R"({"a": [1]})", "f", 2));
  EXPECT_THROW(parse_json(R"({"a": [[[1]]]})", "f", 2), InputError);
}

}  // namespace
}  // namespace plenolab
