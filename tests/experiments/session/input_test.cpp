#include "experiments/session/input.h"

#include <gtest/gtest.h>

#include "experiments/session/form.h"

namespace plenolab {
namespace {

RawInput button(const std::string& name, bool down) {
  return {.kind = RawInput::Kind::kPadButton, .name = name, .down = down};
}
RawInput trigger(const std::string& name, int value) {
  return {.kind = RawInput::Kind::kTrigger, .name = name, .value = value};
}
RawInput key(const std::string& name, bool down = true) {
  return {.kind = RawInput::Kind::kKey, .name = name, .down = down};
}

TEST(PressDecoder, FaceButtonsShowTheReferenceWhenPressed) {
  PressDecoder decoder;
  for (const char* name : {"a", "b", "x", "y"}) {
    EXPECT_EQ(decoder.decode(button(name, true)), Press::kReference);
    EXPECT_EQ(decoder.decode(button(name, false)), std::nullopt);
  }
  EXPECT_EQ(decoder.decode(button("start", true)), std::nullopt);
}

TEST(PressDecoder, ATriggerFiresOnceFromThreeQuartersAndIsReadyBelowAQuarter) {
  PressDecoder decoder;
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 16383)), std::nullopt)
      << "never moved: SDL says half pressed";
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 24574)), std::nullopt);
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 24575)), Press::kLeft);
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 32767)), std::nullopt);
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 9000)), std::nullopt);
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 32767)), std::nullopt) << "not let go in between";
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 8000)), std::nullopt);
  EXPECT_EQ(decoder.decode(trigger("lefttrigger", 32767)), Press::kLeft);
  EXPECT_EQ(decoder.decode(trigger("righttrigger", 32767)), Press::kRight);
}

TEST(PressDecoder, BumpersFireOnceWhenBothAreDownAndAgainAfterBothWereUp) {
  PressDecoder decoder;
  EXPECT_EQ(decoder.decode(button("leftshoulder", true)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("rightshoulder", true)), Press::kChoose);
  EXPECT_EQ(decoder.decode(button("rightshoulder", false)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("rightshoulder", true)), std::nullopt) << "the left one was never up";
  EXPECT_EQ(decoder.decode(button("leftshoulder", false)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("rightshoulder", false)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("rightshoulder", true)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("leftshoulder", true)), Press::kChoose);
}

TEST(PressDecoder, ReleasesThatUnpluggingBringsAboutChooseNothing) {
  PressDecoder decoder;
  decoder.decode(button("leftshoulder", true));
  decoder.decode(button("rightshoulder", true));
  EXPECT_EQ(decoder.decode(button("leftshoulder", false)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("rightshoulder", false)), std::nullopt);
  EXPECT_EQ(decoder.decode({.kind = RawInput::Kind::kDisconnected}), std::nullopt);
  EXPECT_EQ(decoder.decode({.kind = RawInput::Kind::kConnected}), std::nullopt);
  EXPECT_EQ(decoder.decode(button("leftshoulder", true)), std::nullopt);
  EXPECT_EQ(decoder.decode(button("rightshoulder", true)), Press::kChoose);
}

TEST(PressDecoder, TheKeyboardStandsInForThePad) {
  PressDecoder decoder;
  EXPECT_EQ(decoder.decode(key("Space")), Press::kReference);
  EXPECT_EQ(decoder.decode(key("Left")), Press::kLeft);
  EXPECT_EQ(decoder.decode(key("Right")), Press::kRight);
  EXPECT_EQ(decoder.decode(key("Return")), Press::kChoose);
  EXPECT_EQ(decoder.decode(key("Return", false)), std::nullopt);
  EXPECT_EQ(decoder.decode(key("Q")), std::nullopt);
}

TEST(Form, AChoiceIsNeverMadeByAccident) {
  FormMachine form({.id = "q", .text = "?", .kind = FormQuestion::Kind::kChoice, .choices = {"one", "two"}});
  form.press(FormPress::kConfirm);
  EXPECT_FALSE(form.done());
  EXPECT_EQ(form.page().selected, -1);
  for (int i = 0; i < 5; ++i) form.press(FormPress::kDown);
  form.press(FormPress::kUp);
  form.press(FormPress::kConfirm);
  EXPECT_TRUE(form.done());
  EXPECT_EQ(form.answer(), "one");
}

TEST(Form, ANumberIsTypedOrCountedStaysInItsRangeAndMayBeRefused) {
  const FormQuestion age{
      .id = "age", .kind = FormQuestion::Kind::kNumber, .least = 3, .most = 120, .start = 25};
  FormMachine counted(age);
  counted.press(FormPress::kUp);
  EXPECT_EQ(counted.answer(), "25");
  for (int i = 0; i < 20; ++i) counted.press(FormPress::kRight);
  EXPECT_EQ(counted.answer(), "120");
  FormMachine typed(age);
  for (const char* text : {"x", "-", "1", "2", "1"}) typed.type(text);
  typed.press(FormPress::kConfirm);
  EXPECT_FALSE(typed.done()) << "121";
  typed.press(FormPress::kErase);
  typed.press(FormPress::kConfirm);
  EXPECT_TRUE(typed.done());
  EXPECT_EQ(typed.answer(), "12");
  FormMachine refused(age);
  refused.press(FormPress::kConfirm);
  EXPECT_TRUE(refused.done());
  EXPECT_EQ(refused.answer(), "");
}

TEST(Form, ErasingTakesWholeCharacters) {
  FormMachine form({.id = "name", .kind = FormQuestion::Kind::kText, .may_be_empty = false});
  form.press(FormPress::kConfirm);
  EXPECT_FALSE(form.done());
  form.type("aö");
  form.press(FormPress::kErase);
  EXPECT_EQ(form.answer(), "a");
  form.type(std::string(10'000, 'x'));
  EXPECT_EQ(form.answer(), "a") << "an answer has a bound";
}

}  // namespace
}  // namespace plenolab
