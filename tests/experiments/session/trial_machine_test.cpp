#include "experiments/session/trial_machine.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/base/random.h"

namespace plenolab {
namespace {

constexpr std::int64_t kFrame_us = 16'667;
constexpr std::int64_t kBlank_us = 250'000;

/// A display of 60 Hz in front of a machine; remembers what was on it since when.
class Bench {
 public:
  explicit Bench(TrialOptions options = {}) : machine(options) {}

  void flip() {
    now_us += kFrame_us;
    take(machine.flipped(now_us));
  }
  void wait(std::int64_t us) {
    for (const std::int64_t end = now_us + us; now_us < end;) flip();
  }
  PressOutcome press(Press p) {
    const TrialReaction reaction = machine.pressed(p, now_us);
    take(reaction);
    tones += reaction.tone;
    vibrations += reaction.vibrate;
    return *reaction.press;
  }
  /// Presses and waits until the image has been on for longer than a blank.
  void visit(Press p) {
    EXPECT_EQ(press(p), PressOutcome::kAccepted);
    wait(2 * kBlank_us + 5 * kFrame_us);
  }
  void take(const TrialReaction& reaction) {
    if (reaction.onset) onsets.push_back(*reaction.onset);
  }

  TrialMachine machine;
  std::int64_t now_us = 0;
  std::vector<Onset> onsets;
  int tones = 0, vibrations = 0;
};

TEST(TrialMachine, ATrialGoesFromBlackOverReferenceAndBothComparisonsToTheChoice) {
  Bench bench;
  bench.wait(300'000);
  bench.visit(Press::kReference);
  bench.visit(Press::kLeft);
  bench.visit(Press::kRight);
  EXPECT_FALSE(bench.machine.done());
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kAccepted);
  ASSERT_TRUE(bench.machine.done());
  EXPECT_EQ(bench.machine.choice(), Stimulus::kRight);
  EXPECT_EQ(bench.machine.began_at_us(), kFrame_us);
  std::vector<Stimulus> seen;
  for (const Onset& shown : bench.onsets) seen.push_back(shown.stimulus);
  EXPECT_EQ(seen, (std::vector{Stimulus::kBlack, Stimulus::kReference, Stimulus::kBlack, Stimulus::kLeft,
                               Stimulus::kBlack, Stimulus::kRight}));
}

TEST(TrialMachine, EveryImageFollowsAtLeastABlankOfBlackAndAtMostTwoFramesMore) {
  for (const std::int64_t blank_us : {250'000, 300'001, 1'000'000}) {
    Bench bench({.blank_us = blank_us});
    bench.wait(2 * blank_us);
    for (const Press p : {Press::kReference, Press::kLeft, Press::kRight, Press::kLeft}) {
      ASSERT_EQ(bench.press(p), PressOutcome::kAccepted);
      bench.wait(2 * blank_us + 5 * kFrame_us);
    }
    for (const Onset& shown : bench.onsets) {
      if (shown.stimulus == Stimulus::kBlack || shown.stimulus == Stimulus::kReference) continue;
      EXPECT_GE(shown.black_before_us, blank_us);
      EXPECT_LE(shown.black_before_us, blank_us + 2 * kFrame_us);
    }
  }
}

TEST(TrialMachine, PressesWhileBlackAreIgnored) {
  Bench bench;
  bench.flip();
  EXPECT_EQ(bench.press(Press::kReference), PressOutcome::kDuringBlank);
  bench.wait(300'000);
  EXPECT_EQ(bench.press(Press::kLeft), PressOutcome::kNotStarted);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kNotStarted);
  bench.visit(Press::kReference);
  ASSERT_EQ(bench.press(Press::kLeft), PressOutcome::kAccepted);
  for (const Press p : {Press::kReference, Press::kLeft, Press::kRight, Press::kChoose})
    EXPECT_EQ(bench.press(p), PressOutcome::kDuringBlank);
  bench.wait(100'000);
  EXPECT_EQ(bench.press(Press::kRight), PressOutcome::kDuringBlank);
  EXPECT_EQ(bench.tones + bench.vibrations, 0);
  bench.wait(600'000);
  EXPECT_EQ(bench.onsets.back().stimulus, Stimulus::kLeft) << "ignored presses must not change what comes";
}

TEST(TrialMachine, AnImageStaysOnForLongerThanTheBlank) {
  Bench bench;
  bench.wait(300'000);
  ASSERT_EQ(bench.press(Press::kReference), PressOutcome::kAccepted);
  while (bench.onsets.back().stimulus != Stimulus::kReference) bench.flip();
  bench.wait(200'000);
  EXPECT_EQ(bench.press(Press::kLeft), PressOutcome::kTooSoon);
  bench.wait(kBlank_us);
  EXPECT_EQ(bench.press(Press::kLeft), PressOutcome::kAccepted);
}

TEST(TrialMachine, TheReferenceCannotBeChosenAndThePadSaysSo) {
  Bench bench;
  bench.wait(300'000);
  bench.visit(Press::kReference);
  bench.visit(Press::kLeft);
  bench.visit(Press::kRight);
  bench.visit(Press::kReference);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kRefusedReference);
  EXPECT_EQ(bench.tones, 1);
  EXPECT_EQ(bench.vibrations, 1);
  EXPECT_FALSE(bench.machine.done());
}

TEST(TrialMachine, AChoiceNeedsBothComparisonsToHaveBeenSeen) {
  Bench bench;
  bench.wait(300'000);
  bench.visit(Press::kReference);
  bench.visit(Press::kRight);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kRefusedUnseen);
  EXPECT_EQ(bench.vibrations, 1);
  bench.visit(Press::kLeft);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kAccepted);
}

TEST(TrialMachine, TheButtonOfTheImageThatIsOnGivesATone) {
  Bench bench;
  bench.wait(300'000);
  bench.visit(Press::kReference);
  EXPECT_EQ(bench.press(Press::kReference), PressOutcome::kSameImage);
  EXPECT_EQ(bench.tones, 1);
  EXPECT_EQ(bench.vibrations, 0);
}

TEST(TrialMachine, TheVariantOfAppendixEHasNoWayBackToTheReference) {
  Bench bench({.return_to_reference = false});
  bench.wait(300'000);
  bench.visit(Press::kReference);
  bench.visit(Press::kLeft);
  EXPECT_EQ(bench.press(Press::kReference), PressOutcome::kNoReturn);
  EXPECT_EQ(bench.tones, 1);
  bench.visit(Press::kRight);
  bench.visit(Press::kLeft);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kAccepted);
}

TEST(TrialMachine, APauseBringsTheSameImageBackAfterABlankAndIgnoresPresses) {
  Bench bench;
  bench.wait(300'000);
  bench.visit(Press::kReference);
  bench.visit(Press::kLeft);
  bench.take(bench.machine.pause(bench.now_us));
  bench.wait(3'000'000);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kPaused);
  const std::size_t before = bench.onsets.size();
  bench.take(bench.machine.resume());
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kDuringBlank) << "bumpers held while plugging in";
  bench.wait(1'000'000);
  ASSERT_EQ(bench.onsets.size(), before + 2);
  EXPECT_EQ(bench.onsets.back().stimulus, Stimulus::kLeft);
  EXPECT_GE(bench.onsets.back().black_before_us, kBlank_us);
}

TEST(TrialMachine, PausesAreTimedButNotThoseBeforeTheFirstFlip) {
  TrialMachine machine({});
  machine.pause(1'000);
  machine.resume();
  machine.flipped(2'100'000);
  EXPECT_EQ(machine.paused_us(), 0);
  machine.pause(3'000'000);
  machine.pause(3'500'000);  // Esc while unplugged
  machine.resume();
  machine.flipped(5'000'000);
  EXPECT_EQ(machine.paused_us(), 2'000'000);
}

/// Waits until this is on; for a second at most.
void wait_for(Bench& bench, Stimulus stimulus) {
  const auto is_on = [&] { return bench.onsets.back().stimulus == stimulus; };
  for (int frames = 0; frames < 60 && !is_on(); ++frames) bench.flip();
  ASSERT_TRUE(is_on());
}

/// Response time of a trial in which `pause` may happen at any point, after which each image is looked at for
/// more than a blank, before which presses are too soon.
std::int64_t response_us(const std::function<void(Bench&, const char* place)>& pause) {
  Bench bench;
  bench.wait(300'000);
  pause(bench, "waits");
  bench.visit(Press::kReference);
  pause(bench, "reference");
  bench.wait(300'000);
  EXPECT_EQ(bench.press(Press::kLeft), PressOutcome::kAccepted);
  pause(bench, "black asked for");
  bench.wait(100'000);
  pause(bench, "blank");
  wait_for(bench, Stimulus::kLeft);
  bench.wait(500'000);
  pause(bench, "left");
  bench.wait(300'000);
  bench.visit(Press::kRight);
  EXPECT_EQ(bench.press(Press::kChoose), PressOutcome::kAccepted);
  return bench.machine.chosen_at_us() - bench.machine.began_at_us() - bench.machine.paused_us();
}

TEST(TrialMachine, APauseAnywhereLeavesTheResponseTimeAsItIsWithoutOne) {
  const std::int64_t whole_us = response_us([](Bench&, const char*) {});
  for (const std::string where : {"reference", "black asked for", "blank", "left"}) {
    const std::int64_t paused_us = response_us([&](Bench& bench, const char* place) {
      if (place != where) return;
      const Stimulus on = bench.onsets.back().stimulus;
      bench.take(bench.machine.pause(bench.now_us));
      bench.wait(3'000'000);
      bench.take(bench.machine.resume());
      bench.flip();
      if (on == Stimulus::kBlack || where == "black asked for") return;
      wait_for(bench, on);
    });
    EXPECT_NEAR(static_cast<double>(paused_us), static_cast<double>(whole_us), kFrame_us) << where;
  }
}

TEST(TrialMachine, OnlyAnImageThatWasOnReturnsAndIsNoNewView) {
  Bench bench;
  const auto pause = [&] {
    bench.take(bench.machine.pause(bench.now_us));
    bench.wait(400'000);
    bench.take(bench.machine.resume());
    bench.wait(2 * kBlank_us + 5 * kFrame_us);
  };
  const auto last = [&] { return bench.onsets.back(); };
  bench.wait(300'000);
  pause();  // on the black before the reference
  bench.visit(Press::kReference);
  EXPECT_EQ(last().stimulus, Stimulus::kReference);
  EXPECT_FALSE(last().again);
  ASSERT_EQ(bench.press(Press::kLeft), PressOutcome::kAccepted);
  bench.wait(100'000);
  pause();  // during the blank before it
  EXPECT_EQ(last().stimulus, Stimulus::kLeft);
  EXPECT_FALSE(last().again);
  pause();
  EXPECT_EQ(last().stimulus, Stimulus::kLeft);
  EXPECT_TRUE(last().again);
  bench.visit(Press::kRight);
  EXPECT_FALSE(last().again);
  bench.take(bench.machine.pause(bench.now_us));
  bench.take(bench.machine.resume());
  bench.wait(100'000);
  pause();  // while it returns
  EXPECT_EQ(last().stimulus, Stimulus::kRight);
  EXPECT_TRUE(last().again);
}

TEST(TrialMachine, AnImageThatWasAskedForButNeverOnIsNewAfterAPause) {
  Bench bench;
  bench.wait(300'000);
  ASSERT_EQ(bench.press(Press::kReference), PressOutcome::kAccepted);
  bench.now_us += kFrame_us;
  ASSERT_EQ(bench.machine.flipped(bench.now_us).show, Stimulus::kReference);
  bench.machine.pause(bench.now_us);
  bench.machine.resume();
  bench.wait(500'000);
  EXPECT_EQ(bench.onsets.back().stimulus, Stimulus::kReference);
  EXPECT_FALSE(bench.onsets.back().again);
}

TEST(TrialMachine, APauseDuringABlankKeepsTheImageThatWasToCome) {
  Bench bench;
  bench.wait(300'000);
  bench.visit(Press::kReference);
  ASSERT_EQ(bench.press(Press::kRight), PressOutcome::kAccepted);
  bench.wait(100'000);
  bench.machine.pause(bench.now_us);
  bench.machine.pause(bench.now_us);  // Esc while unplugged
  bench.wait(500'000);
  bench.machine.resume();
  bench.wait(500'000);
  EXPECT_EQ(bench.onsets.back().stimulus, Stimulus::kRight);
}

TEST(TrialMachine, APauseBeforeTheTrialBeganLeavesItWaiting) {
  Bench bench;
  bench.wait(100'000);
  bench.machine.pause(bench.now_us);
  bench.machine.resume();
  bench.wait(1'000'000);
  EXPECT_EQ(bench.onsets.back().stimulus, Stimulus::kBlack);
  bench.visit(Press::kReference);
  EXPECT_EQ(bench.onsets.back().stimulus, Stimulus::kReference);
}

// Whatever is pressed whenever: no image without its black, no choice of the reference or of what was not
// seen.
TEST(TrialMachine, HoldsItsPromisesUnderAnyPresses) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream random(seed, 1, 0);
    Bench bench({.return_to_reference = seed % 2 == 0});
    for (int i = 0; i < 3000 && !bench.machine.done(); ++i) {
      bench.flip();
      const double what = random.next_double();
      if (what < 0.05) bench.press(static_cast<Press>(random.next_u64() % 4));
      if (what > 0.998) bench.machine.pause(bench.now_us);
      if (bench.machine.paused() && what > 0.5 && what < 0.6) bench.machine.resume();
    }
    bool left = false, right = false;
    for (const Onset& shown : bench.onsets) {
      left = left || shown.stimulus == Stimulus::kLeft;
      right = right || shown.stimulus == Stimulus::kRight;
      const bool image = shown.stimulus != Stimulus::kBlack;
      ASSERT_TRUE(!image || shown.black_before_us >= kBlank_us) << "seed " << seed;
    }
    for (std::size_t i = 1; i < bench.onsets.size(); ++i) {
      const Onset& now = bench.onsets[i];
      const Onset& before = bench.onsets[i - 1];
      ASSERT_TRUE(now.stimulus == Stimulus::kBlack || before.stimulus == Stimulus::kBlack);
    }
    if (!bench.machine.done()) continue;
    EXPECT_TRUE(left && right);
    EXPECT_EQ(bench.machine.choice(), bench.onsets.back().stimulus);
    EXPECT_NE(bench.machine.choice(), Stimulus::kReference);
  }
}

}  // namespace
}  // namespace plenolab
