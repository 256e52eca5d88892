#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/session/input.h"

namespace plenolab {

/// What is on the display during a trial. Left and right: the comparison on that trigger.
enum class Stimulus { kBlack, kReference, kLeft, kRight };

/// "black", "reference", "left", "right".
const char* name_of(Stimulus stimulus);

/// What came of a press. Everything but kAccepted leaves the trial as it was.
enum class PressOutcome {
  kAccepted,          ///< the image changes, or the choice is made
  kNotStarted,        ///< ignored: the trial begins with the reference
  kDuringBlank,       ///< ignored: the display is black between two images
  kTooSoon,           ///< ignored: the image has not been on for longer than the blank
  kSameImage,         ///< tone: that image is already on
  kRefusedReference,  ///< tone and vibration: the reference cannot be chosen
  kRefusedUnseen,     ///< tone and vibration: choose after both comparisons were seen
  kNoReturn,          ///< tone: the variant of appendix E has no way back to the reference
  kPaused,            ///< ignored: the session is paused
};

/// Stable names, e.g. "accepted", "ignored_during_blank", "refused_reference".
const char* name_of(PressOutcome outcome);

struct TrialOptions {
  std::int64_t blank_us = 250'000;
  bool return_to_reference = true;
};

/// How long an image or the black before it was on, from measured flips.
struct Onset {
  Stimulus stimulus = Stimulus::kBlack;
  std::int64_t since_us = 0;         ///< the first flip that had it
  std::int64_t black_before_us = 0;  ///< how long it was black before
  bool again = false;                ///< it was on when a pause came and returns: no new view
};

/// What the machine asks of its owner after an input.
struct TrialReaction {
  std::optional<Stimulus> show;       ///< draw this; report the flip that shows it
  std::optional<Onset> onset;         ///< this is on the display since then; to be stored
  std::optional<PressOutcome> press;  ///< what came of the press; to be stored
  bool tone = false, vibrate = false;
};

/// One trial of the delayed matching to sample with two intervals (section 4.1 of the thesis), as a machine
/// without clock, display or pad: it takes presses and flips with their times and says what to do.
///
///   black → reference (A, B, X, Y) → black → comparison (triggers) → black → … until both bumpers choose the
///   comparison that is on.
///
/// At every change the display is black for at least `blank_us`, counted in whole frames between measured
/// flips: the next image is asked for at the first flip by which the black has lasted that long, so it
/// appears one frame later. Presses during it, and before an image has been on for longer than the blank, are
/// ignored. A choice counts after both comparisons were seen. Everything can be revisited, the reference
/// unless the options forbid it.
class TrialMachine {
 public:
  /// The trial begins with a black display, which is to be shown and reported as a flip.
  explicit TrialMachine(TrialOptions options);

  /// The display has flipped at `t_us` with what was asked for last. To be called for every frame.
  TrialReaction flipped(std::int64_t t_us);
  /// A press that was made before or at `t_us`.
  TrialReaction pressed(Press press, std::int64_t t_us);
  /// Pause (pad unplugged, experimenter): black until resumed; then what was on returns after a blank.
  TrialReaction pause(std::int64_t t_us);
  TrialReaction resume();

  bool done() const { return choice_.has_value(); }
  bool paused() const { return paused_; }
  /// The comparison that was chosen: kLeft or kRight.
  Stimulus choice() const { return *choice_; }
  std::int64_t chosen_at_us() const { return chosen_at_us_; }
  /// The first flip of the trial.
  std::int64_t began_at_us() const { return began_at_us_; }
  /// For how long the trial was paused after its first flip, to the first flip of the image that was on and
  /// returns; of a blank that a pause interrupts, which is repeated whole, what had gone by counts as paused
  /// too. Not part of the response time, which is that of the trial without pauses.
  std::int64_t paused_us() const { return paused_us_; }

 private:
  PressOutcome judge(Press press, std::int64_t t_us) const;
  PressOutcome judge_choice() const;
  void go_black();
  std::int64_t blank_so_far_us(std::int64_t t_us) const;
  void end_pause(std::int64_t t_us);

  TrialOptions options_;
  Stimulus on_ = Stimulus::kBlack;           // what is, or is about to be, on the display
  Stimulus next_ = Stimulus::kBlack;         // what follows the black; kBlack: nothing yet, the trial waits
  std::optional<std::int64_t> on_since_us_;  // first flip with on_; empty until it is reported
  std::int64_t began_at_us_ = -1, chosen_at_us_ = 0, black_since_us_ = 0;
  std::optional<std::int64_t> pause_began_us_;  // until what was interrupted is there again
  std::int64_t paused_us_ = 0;
  bool again_ = false;  // next_ was on before the pause
  bool seen_left_ = false, seen_right_ = false, seen_comparison_ = false;
  bool paused_ = false;
  std::optional<Stimulus> choice_;
};

}  // namespace plenolab
