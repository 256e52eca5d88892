#include "experiments/session/form.h"

#include <algorithm>
#include <charconv>

namespace plenolab {

namespace {

constexpr std::size_t kLongestAnswer = 500;
constexpr int kLeap = 10;

std::optional<int> number_in(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

FormMachine::FormMachine(FormQuestion question) : question_(std::move(question)) {}

void FormMachine::choose(FormPress press) {
  const int last = static_cast<int>(question_.choices.size()) - 1;
  if (press == FormPress::kDown) selected_ = std::min(selected_ + 1, last);
  if (press == FormPress::kUp) selected_ = selected_ < 0 ? last : std::max(selected_ - 1, 0);
}

void FormMachine::count(FormPress press) {
  const int step = press == FormPress::kUp      ? 1
                   : press == FormPress::kDown  ? -1
                   : press == FormPress::kRight ? kLeap
                   : press == FormPress::kLeft  ? -kLeap
                                                : 0;
  if (step == 0) return;
  const auto present = number_in(text_);
  text_ = std::to_string(present ? std::clamp(*present + step, question_.least, question_.most)
                                 : question_.start);
}

void FormMachine::erase() {
  // A character of UTF-8 ends with its first byte when read backwards.
  while (!text_.empty() && (static_cast<unsigned char>(text_.back()) & 0xC0) == 0x80) text_.pop_back();
  if (!text_.empty()) text_.pop_back();
}

bool FormMachine::acceptable() const {
  switch (question_.kind) {
    case FormQuestion::Kind::kMessage:
      return true;
    case FormQuestion::Kind::kChoice:
      return selected_ >= 0;
    case FormQuestion::Kind::kText:
      return question_.may_be_empty || !text_.empty();
    default: {
      const auto number = number_in(text_);
      return text_.empty() ? question_.may_be_empty
                           : number && *number >= question_.least && *number <= question_.most;
    }
  }
}

void FormMachine::press(FormPress press) {
  if (done_) return;
  if (press == FormPress::kConfirm) {
    done_ = acceptable();
  } else if (question_.kind == FormQuestion::Kind::kChoice) {
    choose(press);
  } else if (press == FormPress::kErase) {
    erase();
  } else if (question_.kind == FormQuestion::Kind::kNumber) {
    count(press);
  }
}

void FormMachine::type(const std::string& text) {
  if (done_ || text_.size() + text.size() > kLongestAnswer) return;
  if (question_.kind == FormQuestion::Kind::kText) text_ += text;
  const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (question_.kind == FormQuestion::Kind::kNumber && digits && text_.size() + text.size() <= 4)
    text_ += text;
}

std::string FormMachine::answer() const {
  if (question_.kind != FormQuestion::Kind::kChoice) return text_;
  return selected_ < 0 ? "" : question_.choices[static_cast<std::size_t>(selected_)];
}

FormPage FormMachine::page() const {
  FormPage page{question_.text, {}, -1, ""};
  switch (question_.kind) {
    case FormQuestion::Kind::kMessage:
      page.footer = "A or Return: go on";
      break;
    case FormQuestion::Kind::kChoice:
      page.lines = question_.choices;
      page.selected = selected_;
      page.footer = "Up and down: choose     A or Return: go on";
      break;
    case FormQuestion::Kind::kNumber:
      page.lines = {text_ + "_"};
      page.footer = "Type, or up and down by 1, left and right by 10     A or Return: go on";
      break;
    case FormQuestion::Kind::kText:
      page.lines = {text_ + "_"};
      page.footer = "Type on the keyboard     A or Return: go on";
      break;
  }
  const bool answer_wanted =
      question_.kind == FormQuestion::Kind::kNumber || question_.kind == FormQuestion::Kind::kText;
  if (answer_wanted && question_.may_be_empty) page.footer += "     empty: no answer";
  return page;
}

}  // namespace plenolab
