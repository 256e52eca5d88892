#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/session/input.h"

namespace plenolab {

/// One question on one page.
struct FormQuestion {
  enum class Kind {
    kMessage,  ///< only to be read and confirmed
    kChoice,   ///< one of `choices`
    kNumber,   ///< a whole number from `least` to `most`
    kText,     ///< typed
  };
  std::string id, text;
  Kind kind = Kind::kMessage;
  std::vector<std::string> choices;
  int least = 0, most = 0, start = 0;  ///< `start`: what up and down begin at
  bool may_be_empty = true;            ///< whether a number or text may be refused by leaving it empty
};

/// What a page shows, for whoever draws it.
struct FormPage {
  std::string text;
  std::vector<std::string> lines;  ///< choices, or the answer so far
  int selected = -1;               ///< line that is selected; −1: none
  std::string footer;              ///< how to answer
};

/// One question that is being answered by arrows and text: a pure machine.
class FormMachine {
 public:
  explicit FormMachine(FormQuestion question);

  void press(FormPress press);
  void type(const std::string& text);

  bool done() const { return done_; }
  /// The choice, number or text; empty for a message and for an answer that was refused.
  std::string answer() const;
  FormPage page() const;
  const FormQuestion& question() const { return question_; }

 private:
  void choose(FormPress press);
  void count(FormPress press);
  void erase();
  bool acceptable() const;

  FormQuestion question_;
  int selected_ = -1;  // nothing is selected at first: no answer by accident
  std::string text_;
  bool done_ = false;
};

}  // namespace plenolab
