#include "experiments/session/trial_machine.h"

#include <algorithm>
#include <array>

namespace plenolab {

namespace {

Stimulus stimulus_of(Press press) {
  return press == Press::kReference ? Stimulus::kReference
         : press == Press::kLeft    ? Stimulus::kLeft
                                    : Stimulus::kRight;
}

bool refused(PressOutcome outcome) {
  return outcome == PressOutcome::kRefusedReference || outcome == PressOutcome::kRefusedUnseen;
}

}  // namespace

const char* name_of(Stimulus stimulus) {
  static constexpr std::array kNames{"black", "reference", "left", "right"};
  return kNames[static_cast<std::size_t>(stimulus)];
}

const char* name_of(PressOutcome outcome) {
  static constexpr std::array kNames{"accepted",         "ignored_not_started", "ignored_during_blank",
                                     "ignored_too_soon", "same_image",          "refused_reference",
                                     "refused_unseen",   "no_return",           "ignored_paused"};
  return kNames[static_cast<std::size_t>(outcome)];
}

TrialMachine::TrialMachine(TrialOptions options) : options_(options) {}

TrialReaction TrialMachine::flipped(std::int64_t t_us) {
  TrialReaction reaction;
  if (paused_ || done()) return reaction;
  if (!on_since_us_) {
    on_since_us_ = t_us;
    end_pause(t_us);
    if (began_at_us_ < 0) began_at_us_ = t_us;
    const std::int64_t black_us = on_ == Stimulus::kBlack ? 0 : t_us - black_since_us_;
    reaction.onset = Onset{on_, t_us, black_us, again_ && on_ != Stimulus::kBlack};
    if (on_ == Stimulus::kBlack)
      black_since_us_ = t_us;
    else
      again_ = false;
    seen_left_ = seen_left_ || on_ == Stimulus::kLeft;
    seen_right_ = seen_right_ || on_ == Stimulus::kRight;
    seen_comparison_ = seen_left_ || seen_right_;
  }
  if (on_ == Stimulus::kBlack && next_ != Stimulus::kBlack && t_us - *on_since_us_ >= options_.blank_us) {
    on_ = next_;
    next_ = Stimulus::kBlack;
    on_since_us_.reset();
    reaction.show = on_;
  }
  return reaction;
}

PressOutcome TrialMachine::judge_choice() const {
  if (on_ == Stimulus::kReference) return PressOutcome::kRefusedReference;
  return seen_left_ && seen_right_ ? PressOutcome::kAccepted : PressOutcome::kRefusedUnseen;
}

PressOutcome TrialMachine::judge(Press press, std::int64_t t_us) const {
  if (paused_) return PressOutcome::kPaused;
  if (!on_since_us_ || next_ != Stimulus::kBlack) return PressOutcome::kDuringBlank;
  if (t_us - *on_since_us_ <= options_.blank_us)
    return on_ == Stimulus::kBlack ? PressOutcome::kDuringBlank : PressOutcome::kTooSoon;
  if (on_ == Stimulus::kBlack)  // waiting for the trial to begin
    return press == Press::kReference ? PressOutcome::kAccepted : PressOutcome::kNotStarted;
  if (press == Press::kChoose) return judge_choice();
  if (stimulus_of(press) == on_) return PressOutcome::kSameImage;
  if (press == Press::kReference && !options_.return_to_reference && seen_comparison_)
    return PressOutcome::kNoReturn;
  return PressOutcome::kAccepted;
}

TrialReaction TrialMachine::pressed(Press press, std::int64_t t_us) {
  TrialReaction reaction;
  if (done()) return reaction;
  const PressOutcome outcome = judge(press, t_us);
  reaction.press = outcome;
  reaction.vibrate = refused(outcome);
  reaction.tone =
      refused(outcome) || outcome == PressOutcome::kSameImage || outcome == PressOutcome::kNoReturn;
  if (outcome != PressOutcome::kAccepted) return reaction;
  if (press == Press::kChoose) {
    choice_ = on_;
    chosen_at_us_ = t_us;
    return reaction;
  }
  next_ = stimulus_of(press);
  // The black before the first image of a trial is on already, and has been for longer than a blank.
  if (on_ == Stimulus::kBlack) return reaction;
  go_black();
  reaction.show = Stimulus::kBlack;
  return reaction;
}

void TrialMachine::go_black() {
  on_ = Stimulus::kBlack;
  on_since_us_.reset();
}

/// How much has gone by of the blank before an image that is to come; 0 if none is to come.
std::int64_t TrialMachine::blank_so_far_us(std::int64_t t_us) const {
  const bool image_comes =
      on_ == Stimulus::kBlack ? on_since_us_ && next_ != Stimulus::kBlack : !on_since_us_;
  return image_comes ? std::min(t_us - black_since_us_, options_.blank_us) : 0;
}

TrialReaction TrialMachine::pause(std::int64_t t_us) {
  if (!pause_began_us_) pause_began_us_ = t_us - blank_so_far_us(t_us);
  paused_ = true;
  again_ = again_ || (on_ != Stimulus::kBlack && on_since_us_);
  if (next_ == Stimulus::kBlack) next_ = on_;
  go_black();
  return {.show = Stimulus::kBlack};
}

TrialReaction TrialMachine::resume() {
  paused_ = false;
  return {.show = Stimulus::kBlack};
}

/// At a flip after a pause that shows something new: an image that was on has to be there again.
void TrialMachine::end_pause(std::int64_t t_us) {
  if (!pause_began_us_ || (again_ && on_ == Stimulus::kBlack)) return;
  if (began_at_us_ >= 0) paused_us_ += t_us - *pause_began_us_;
  pause_began_us_.reset();
}

}  // namespace plenolab
