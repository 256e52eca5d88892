#include "experiments/session/questions.h"

#include <fmt/format.h>

namespace plenolab {

namespace {

constexpr const char* kAgree = "I agree";
constexpr const char* kFarSighted = "Far-sighted: near things are blurred for me";

FormQuestion choice(const std::string& id, const std::string& text, std::vector<std::string> choices) {
  return {.id = id, .text = text, .kind = FormQuestion::Kind::kChoice, .choices = std::move(choices)};
}

std::string minor_choice(const ConsentText& consent) {
  return fmt::format("Younger than {}", consent.adult_age);
}

constexpr const char* kInstructions =
    "You will see a reference image and then two other images. One of the two is equal to the reference: "
    "find it.\n\n"
    "A, B, X or Y: reference     (space bar)\n"
    "Left or right trigger: one of the two     (left or right arrow)\n"
    "Both bumpers: choose the image you see     (Return)\n\n"
    "Look at all of them as often as you like. The display is black when a trial begins, and for a moment at "
    "every change. The reference itself cannot be chosen.";

constexpr const char* kInstructionsWithoutReturn =
    "You will see a reference image and then two other images. One of the two is equal to the reference: "
    "find it.\n\n"
    "A, B, X or Y: reference     (space bar)\n"
    "Left or right trigger: one of the two     (left or right arrow)\n"
    "Both bumpers: choose the image you see     (Return)\n\n"
    "Look well at the reference: it does not come back once you have seen one of the two images.";

}  // namespace

FormQuestion message(const std::string& id, const std::string& text) {
  return {.id = id, .text = text, .kind = FormQuestion::Kind::kMessage};
}

FormQuestion adult_question(const ConsentText& consent) {
  return choice("adult", "How old are you?",
                {fmt::format("{} or older", consent.adult_age), minor_choice(consent)});
}

bool answers_minor(const ConsentText& consent, const std::string& answer) {
  return answer == minor_choice(consent);
}

FormQuestion consent_question(const std::string& id, const std::string& text) {
  return choice(id, text, {kAgree, "I do not agree"});
}

bool answers_agreed(const std::string& answer) {
  return answer == kAgree;
}

FormQuestion signature_question(const std::string& id, const std::string& whose) {
  return {.id = id,
          .text = fmt::format("Name of the {} (kept apart from all answers)", whose),
          .kind = FormQuestion::Kind::kText,
          .may_be_empty = false};
}

std::vector<FormQuestion> person_questions(const Demographics& asked) {
  std::vector<FormQuestion> questions;
  if (asked.age)
    questions.push_back({.id = "age",
                         .text = "Your age in years (you need not say)",
                         .kind = FormQuestion::Kind::kNumber,
                         .least = 3,
                         .most = 120,
                         .start = 25});
  if (asked.sex)
    questions.push_back(choice("sex", "Your sex", {"female", "male", "other", "I do not wish to say"}));
  if (asked.vision)
    questions.push_back(choice("vision", "How do you see, as you are now?",
                               {"Normal", "Corrected to normal by glasses or contact lenses",
                                "Near-sighted, not corrected", kFarSighted}));
  return questions;
}

bool answers_far_sighted(const std::string& answer) {
  return answer == kFarSighted;
}

FormQuestion instruction_page(const StudyDefinition& study) {
  std::string text;
  for (const std::string& paragraph : study.instructions) text += (text.empty() ? "" : "\n\n") + paragraph;
  if (text.empty()) text = study.return_to_reference ? kInstructions : kInstructionsWithoutReturn;
  return message("instructions", text);
}

FormQuestion block_page(const StudyDefinition& study, const StudyBlock& block, int position, int count) {
  const bool worn = block.display == DisplayKind::kLightField;
  std::string text = fmt::format("Part {} of {}: {}, {} trials.", position, count,
                                 worn ? "the light-field display" : "the monitor", block.images.size());
  if (worn) text += "\n\nGo on, then put the display on.";
  text += " It is black when a trial begins: A, B, X or Y (space bar) shows the reference.";
  if (!study.return_to_reference) text += " It does not come back later.";
  return message("block_" + block.id, text);
}

std::vector<FormQuestion> closing_questions(const StudyDefinition& study) {
  std::vector<FormQuestion> questions;
  for (const StudyQuestion& question : study.questionnaire) {
    if (question.choices.empty())
      questions.push_back({.id = question.id, .text = question.text, .kind = FormQuestion::Kind::kText});
    else
      questions.push_back(choice(question.id, question.text, question.choices));
  }
  return questions;
}

}  // namespace plenolab
