#include "experiments/session/runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "experiments/session/consent.h"
#include "experiments/session/same_study.h"
#include "tests/experiments/session/tiny_study.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

/// A stage whose participant answers pages by `answer` (keys to press for a question's id) and does the
/// trials right; presses Escape and Return when the trial number `stop_at` begins.
class ScriptedStage final : public Stage {
 public:
  DisplayReport open_display(int screen) override {
    return {screen, "scripted", 1000, 800, stated_hz, vsync, 10};
  }
  void load(const std::vector<Picture>&) override {}
  void draw(const Picture& picture) override {
    picture_ = picture;
    waited_ = 0;
    if (picture.kind == Picture::Kind::kPage) pages.push_back(picture.question);
    if (!picture.banner.empty()) banner = picture.banner;
  }
  std::int64_t flip() override { return now_us_ += 10'000; }
  std::vector<RawInput> poll() override {
    if (++waited_ < 60) return {};
    waited_ = 0;
    std::vector<RawInput> inputs = pad_inputs();
    if (!inputs.empty()) return inputs;
    for (const std::string& key : keys())
      inputs.push_back(
          {.kind = RawInput::Kind::kKey, .name = key, .down = true, .t_low_us = now_us_, .t_us = now_us_});
    return inputs;
  }
  StageEquipment equipment() override { return {"", audio}; }
  bool tone() override { return audio; }
  bool vibrate() override { return false; }
  bool audio = true;

  std::map<std::string, std::vector<std::string>>
      answers;  // keys by id of the question; else the first choice
  int stop_at = -1;
  double stated_hz = 100;
  bool vsync = true;
  std::vector<std::string> pages;
  std::string banner;
  /// Takes the place of the keys for this picture, if it gives anything.
  std::function<std::vector<RawInput>(const Picture&)> pad;
  std::int64_t now_us() const { return now_us_; }

 private:
  std::vector<RawInput> pad_inputs() {
    std::vector<RawInput> inputs = pad ? pad(picture_) : std::vector<RawInput>{};
    for (RawInput& input : inputs) input.t_low_us = input.t_us = now_us_;
    return inputs;
  }
  std::vector<std::string> keys() {
    if (picture_.kind == Picture::Kind::kPage) {
      if (picture_.question.empty()) return {"Return"};  // whether to stop
      const auto found = answers.find(picture_.question);
      return found != answers.end() ? found->second : std::vector<std::string>{"Down", "Return"};
    }
    if (picture_.kind == Picture::Kind::kBlack) {
      if (picture_.image != image_ || picture_.block != block_) ++trial_, seen_left_ = seen_right_ = false;
      image_ = picture_.image;
      block_ = picture_.block;
      return {trial_ == stop_at ? "Escape" : "Space"};
    }
    seen_left_ = seen_left_ || picture_.stimulus == Stimulus::kLeft;
    seen_right_ = seen_right_ || picture_.stimulus == Stimulus::kRight;
    if (!seen_left_) return {"Left"};
    if (!seen_right_) return {"Right"};
    if (picture_.shows_test) return {picture_.stimulus == Stimulus::kLeft ? "Right" : "Left"};
    return {"Return"};
  }

  Picture picture_;
  std::string image_, block_;
  bool seen_left_ = false, seen_right_ = false;
  int waited_ = 0, trial_ = 0;
  std::int64_t now_us_ = 0;
};

struct Fixture {
  explicit Fixture(SessionMode mode = SessionMode::kReal)
      : study(write_tiny_study(folder.path() / "study", mode)),
        store(SessionStore::create(folder.path() / "sessions", new_identity(study, mode, 1),
                                   Durability::kProcessEnd)) {}

  SessionState run(ScriptedStage& stage) {
    return run_session(store, stage, {.images = folder.path() / "study"});
  }
  SessionSummary summary() { return summarise(store.identity(), study, store.events()); }
  fs::path sessions() const { return folder.path() / "sessions"; }
  bool consented() { return consent_exists(sessions(), store.identity(), study.consent); }
  int count(const std::string& kind) {
    const auto events = store.events();
    return static_cast<int>(
        std::count_if(events.begin(), events.end(), [&](const SessionEvent& e) { return e.kind == kind; }));
  }

  TemporaryFolder folder;
  StudyDefinition study;
  SessionStore store;
};

TEST(Runner, ASessionGoesFromConsentToItsEnd) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  EXPECT_EQ(stage.pages.front(), "adult");
  EXPECT_EQ(stage.pages.back(), "end");
  EXPECT_EQ(stage.banner, "");
  const SessionSummary summary = fixture.summary();
  EXPECT_EQ(summary.state, SessionState::kDone);
  ASSERT_EQ(summary.trials.size(), 6u);
  for (const TrialRecord& trial : summary.trials) {
    EXPECT_FALSE(trial.chose_test) << trial.block << " " << trial.image;
    EXPECT_GE(trial.views_a, 1);
    EXPECT_GE(trial.views_b, 1);
    EXPECT_EQ(trial.catch_trial, trial.image == "odd");
  }
  EXPECT_EQ(summary.answers.size(), 5u) << "of age, age, sex, vision, the questionnaire";
  EXPECT_TRUE(fixture.consented());
}

TEST(Runner, WhoDeclinesIsAskedNothingFurtherAndLeavesNoConsent) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["consent"] = {"Up", "Return"};
  EXPECT_EQ(fixture.run(stage), SessionState::kDeclined);
  EXPECT_EQ(fixture.summary().answers.size(), 1u) << "only whether of age";
  EXPECT_FALSE(fixture.consented());
  EXPECT_EQ(fixture.run(stage), SessionState::kDeclined) << "it stays so";
}

TEST(Runner, ATornConsentIsNoConsent) {
  for (const char* text : {"", "{\"participant\": \"real-001\", \"te"}) {
    Fixture fixture;
    create_private_folder(fixture.sessions() / "consent");
    write_text_file(fixture.sessions() / "consent" / "real-001.json", text);
    ScriptedStage stage;
    const std::string message = message_of([&] { fixture.run(stage); });
    EXPECT_NE(message.find("is damaged"), std::string::npos) << message;
    EXPECT_EQ(fixture.count("consent"), 0);
  }
}

TEST(Runner, TheConsentOfAnotherSessionOrToAnotherTextIsNoConsent) {
  for (const bool other_session : {true, false}) {
    Fixture fixture;
    ConsentRecord record{.participant = "real-001",
                         .session_created_utc = fixture.store.identity().created_utc,
                         .given_utc = utc_now(),
                         .text = fixture.study.consent.text};
    (other_session ? record.session_created_utc : record.text) = "another";
    store_consent(fixture.sessions(), record, Durability::kPowerCut);
    ScriptedStage stage;
    const std::string message = message_of([&] { fixture.run(stage); });
    EXPECT_NE(message.find(other_session ? "for another session" : "to another text"), std::string::npos)
        << message;
    EXPECT_EQ(fixture.count("consent"), 0);
  }
}

TEST(Runner, WhoIsUnderAgeNeedsTheGuardiansConsentToo) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["adult"] = {"Up", "Return"};
  stage.answers["guardian_consent"] = {"Up", "Return"};
  EXPECT_EQ(fixture.run(stage), SessionState::kDeclined);
  EXPECT_EQ(std::count(stage.pages.begin(), stage.pages.end(), "age"), 0);
}

TEST(Runner, FarSightedParticipantsAreExcluded) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  stage.answers["vision"] = {"Up", "Return"};
  EXPECT_EQ(fixture.run(stage), SessionState::kExcluded);
  EXPECT_EQ(fixture.count("trial_started"), 0);
}

TEST(Runner, AStoppedSessionGoesOnWithTheInterruptedTrialAndAsksNothingTwice) {
  Fixture fixture;
  ScriptedStage first;
  first.answers["age"] = {"Return"};
  first.stop_at = 5;
  EXPECT_EQ(fixture.run(first), SessionState::kInterrupted);
  EXPECT_EQ(fixture.summary().trials.size(), 4u);
  EXPECT_EQ(fixture.count("stopped"), 1);
  ScriptedStage second;
  EXPECT_EQ(fixture.run(second), SessionState::kDone);
  EXPECT_EQ(std::count(second.pages.begin(), second.pages.end(), "adult"), 0);
  EXPECT_EQ(std::count(second.pages.begin(), second.pages.end(), "vision"), 0);
  const SessionSummary summary = fixture.summary();
  ASSERT_EQ(summary.trials.size(), 6u);
  EXPECT_EQ(summary.trials[4].attempt, 2);
  EXPECT_EQ(summary.trials[5].attempt, 1);
  EXPECT_EQ(summary.runs, 2);
}

RawInput pad_button(const char* name, bool down) {
  return {.kind = RawInput::Kind::kPadButton, .name = name, .down = down};
}

RawInput key(const char* name) {
  return {.kind = RawInput::Kind::kKey, .name = name, .down = true};
}

TEST(Runner, BumpersReleasedWhileTheSessionAsksWhetherToStopDoNotHalfChoose) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  int step = 0;
  stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
    const bool stop_page = picture.kind == Picture::Kind::kPage && picture.question.empty();
    if (step == 0 && picture.kind == Picture::Kind::kImage)
      return ++step, std::vector{pad_button("leftshoulder", true), key("Escape")};
    if (step == 1 && stop_page) return ++step, std::vector{pad_button("leftshoulder", false), key("Escape")};
    if (step == 2 && picture.kind == Picture::Kind::kImage)
      return ++step, std::vector{pad_button("rightshoulder", true), pad_button("rightshoulder", false)};
    return {};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  EXPECT_EQ(step, 3);
  const auto events = fixture.store.events();
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const SessionEvent& e) {
                            return e.kind == "press" && e.detail.find("rightshoulder") != std::string::npos;
                          }),
            0);
  EXPECT_EQ(fixture.count("continued"), 1);
}

TEST(Runner, APauseIsNotPartOfTheResponseTimeNorADroppedFrame) {
  double response_s[2];
  for (const bool pauses : {false, true}) {
    Fixture fixture;
    ScriptedStage stage;
    stage.answers["age"] = {"Return"};
    int step = pauses ? 0 : 2;
    std::int64_t asked_us = 0;
    stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
      const bool stop_page = picture.kind == Picture::Kind::kPage && picture.question.empty();
      if (step == 0 && picture.kind == Picture::Kind::kImage)
        return asked_us = stage.now_us(), ++step, std::vector{key("Escape")};
      if (step == 1 && stop_page && stage.now_us() > asked_us + 5'000'000)
        return ++step, std::vector{key("Escape")};
      if (step == 1 && stop_page) return {key("Space")};
      return {};
    };
    EXPECT_EQ(fixture.run(stage), SessionState::kDone);
    EXPECT_EQ(step, 2);
    const TrialRecord trial = fixture.summary().trials.front();
    response_s[pauses] = trial.response_s;
    EXPECT_EQ(trial.paused_us > 5'000'000, pauses);
    EXPECT_EQ(trial.dropped_frames, 0);
  }
  EXPECT_LT(response_s[1], response_s[0] + 2);
}

TEST(Runner, APadUnpluggedWithTheChoiceOrOnAPagePausesTheNextTrial) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  bool unplugged = false, waits = false;
  stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
    if (picture.question == "instructions" && !unplugged) {
      unplugged = true;
      return {{.kind = RawInput::Kind::kDisconnected}};
    }
    const bool pause_page = picture.kind == Picture::Kind::kPage && picture.question.empty();
    if (!pause_page || waits) return {};
    waits = true;
    return {{.kind = RawInput::Kind::kConnected, .name = "spare pad"}};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  EXPECT_TRUE(waits);
  EXPECT_EQ(fixture.count("unplugged"), 1);
  const auto events = fixture.store.events();
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const SessionEvent& e) { return e.kind == "plugged" && e.what == "spare pad"; }),
            1);
}

TEST(Runner, ClosingTheWindowTogetherWithTheChoiceStoresTheChoiceAndStops) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  bool left = false, right = false;
  stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
    left = left || picture.stimulus == Stimulus::kLeft;
    right = right || picture.stimulus == Stimulus::kRight;
    if (!left || !right || picture.kind != Picture::Kind::kImage) return {};
    return {key("Return"), {.kind = RawInput::Kind::kClose}};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kInterrupted);
  EXPECT_EQ(fixture.count("choice"), 1);
  EXPECT_EQ(fixture.count("stopped"), 1);
}

TEST(Runner, ClosingTheWindowOnTheLastPageLeavesASessionDone) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  stage.pad = [](const Picture& picture) {
    return picture.question == "end" ? std::vector<RawInput>{{.kind = RawInput::Kind::kClose}}
                                     : std::vector<RawInput>{};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  EXPECT_EQ(fixture.summary().state, SessionState::kDone);
  EXPECT_EQ(fixture.count("stopped"), 1);
}

TEST(Runner, WhatItWasRunWithIsStored) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  stage.audio = false;
  run_session(
      fixture.store, stage,
      {.images = fixture.folder.path() / "study", .any_timing = true, .keyboard = true, .note = "a\"b"});
  const auto run = nlohmann::json::parse(fixture.store.events().front().detail);
  EXPECT_EQ(run.at("pad"), "none");
  EXPECT_EQ(run.at("keyboard"), true);
  EXPECT_EQ(run.at("audio"), "none");
  EXPECT_EQ(run.at("any_timing"), true);
  EXPECT_EQ(run.at("note"), "a\"b");
}

TEST(Runner, TonesAndVibrationsAreStoredWithWhatCameOfThem) {
  for (const bool audio : {true, false}) {
    Fixture fixture;
    ScriptedStage stage;
    stage.answers["age"] = {"Return"};
    stage.audio = audio;
    bool pressed = false;
    stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
      if (pressed || picture.stimulus != Stimulus::kReference) return {};
      pressed = true;
      return {key("Return")};  // the reference cannot be chosen
    };
    EXPECT_EQ(fixture.run(stage), SessionState::kDone);
    int refused = 0;
    for (const SessionEvent& event : fixture.store.events()) {
      if (event.kind != "press") continue;
      const auto detail = nlohmann::json::parse(event.detail);
      const bool is_refused = event.outcome == "refused_reference";
      refused += is_refused ? 1 : 0;
      ASSERT_EQ(detail.contains("tone"), is_refused);
      ASSERT_EQ(detail.contains("vibration"), is_refused);
      EXPECT_EQ(detail.value("tone", audio), audio);
    }
    EXPECT_EQ(refused, 1);
  }
}

TEST(Runner, RealSessionsRefuseADisplayThatDoesNotKeepTime) {
  for (const bool real : {true, false}) {
    Fixture fixture(real ? SessionMode::kReal : SessionMode::kPilot);
    ScriptedStage stage;
    stage.answers["age"] = {"Return"};
    stage.vsync = false;
    const std::string message = message_of([&] { fixture.run(stage); });
    EXPECT_EQ(message.find("cannot be trusted with time") != std::string::npos, real) << message;
    ScriptedStage slow;
    slow.answers["age"] = {"Return"};
    slow.stated_hz = 60;  // but 10 ms a flip
    EXPECT_EQ(message_of([&] { fixture.run(slow); }).empty(), !real);
    ScriptedStage unknown;
    unknown.answers["age"] = {"Return"};
    unknown.stated_hz = 0;
    if (real) {
      EXPECT_NE(message_of([&] { fixture.run(unknown); }).find("unknown"), std::string::npos);
    }
  }
}

TEST(Runner, APilotSaysSoOnItsPages) {
  Fixture fixture(SessionMode::kPilot);
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  fixture.run(stage);
  EXPECT_EQ(stage.banner, "PILOT: answers do not count");
}

}  // namespace
}  // namespace plenolab
