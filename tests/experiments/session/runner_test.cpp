#include "experiments/session/runner.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/session/consent.h"
#include "experiments/session/export.h"
#include "experiments/session/same_study.h"
#include "experiments/session/study_files.h"
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
    ++opened;
    return {screen, "scripted", 1000, 800, stated_hz, vsync, 10};
  }
  void load(const std::vector<Picture>& pictures) override {
    for (const Picture& picture : pictures)
      loaded.push_back(fmt::format("{} at {}", picture.file.filename().string(), picture.zoom));
  }
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
  int opened = 0;  // displays
  std::vector<std::string> loaded;
  double stated_hz = 100;
  bool vsync = true;
  std::vector<std::string> pages;
  std::string banner;
  /// Takes the place of the keys for this picture, if it gives anything.
  std::function<std::vector<RawInput>(const Picture&)> pad;
  std::int64_t now_us() const override { return now_us_; }

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

TEST(Runner, ASessionThatHadConsentNeedsItWhenItGoesOn) {
  const auto message = [](const std::function<void(const fs::path&)>& change) {
    Fixture fixture;
    ScriptedStage first;
    first.answers["age"] = {"Return"};
    first.stop_at = 2;
    EXPECT_EQ(fixture.run(first), SessionState::kInterrupted);
    change(fixture.sessions() / "consent" / "real-001.json");
    ScriptedStage second;
    const std::string text = message_of([&] { fixture.run(second); });
    EXPECT_EQ(fixture.count("trial_started") == 2, !text.empty());
    return text;
  };
  EXPECT_EQ(message([](const fs::path&) {}), "");
  EXPECT_NE(message([](const fs::path& file) { fs::remove(file); }).find("is no longer there"),
            std::string::npos);
  EXPECT_NE(message([](const fs::path& file) { write_text_file(file, "{"); }).find("is damaged, although"),
            std::string::npos);
  const auto other_text = [](const fs::path& file) {
    auto json = nlohmann::json::parse(read_text_file(file));
    json["text"] = "another";
    write_text_file(file, json.dump());
  };
  EXPECT_NE(message(other_text).find("was given to another text, although"), std::string::npos);
}

TEST(Runner, WhoStopsBeforeConsentIsNotExported) {
  Fixture fixture;
  ScriptedStage stage;
  stage.pad = [](const Picture& picture) {
    return picture.question == "consent" ? std::vector<RawInput>{{.kind = RawInput::Kind::kClose}}
                                         : std::vector<RawInput>{};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kInterrupted);
  ASSERT_EQ(fixture.summary().answers.size(), 1u) << "whether of age";
  const fs::path closed = fixture.folder.path() / "closed";  // the session itself is open here
  fs::create_directories(closed);
  fs::copy(fixture.sessions() / "real-001", closed / "real-001");
  const fs::path out = fixture.folder.path() / "out";
  const auto exported = [&] { return message_of([&] { export_sessions(closed, SessionMode::kReal, out); }); };
  EXPECT_NE(exported().find("nothing to export"), std::string::npos) << exported();
  EXPECT_NE(exported().find("real-001 (no consent)"), std::string::npos) << exported();
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
  // It presses at the 60th poll after an image was drawn, the 58th frame after the first flip that had it.
  EXPECT_NEAR(response_s[1] - response_s[0], 0.58, 1e-9) << "for which it looked before the pause";
}

TEST(Runner, APadUnpluggedWithTheChoiceOrOnAPagePausesTheNextTrial) {
  for (const bool with_the_choice : {true, false}) {
    Fixture fixture;
    ScriptedStage stage;
    stage.answers["age"] = {"Return"};
    bool unplugged = false, waits = false, left = false, right = false;
    stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
      left = left || picture.stimulus == Stimulus::kLeft;
      right = right || picture.stimulus == Stimulus::kRight;
      const bool now = with_the_choice ? left && right && picture.kind == Picture::Kind::kImage
                                       : picture.question == "instructions";
      if (now && !unplugged) {
        unplugged = true;
        return {key("Return"), {.kind = RawInput::Kind::kDisconnected}};
      }
      const bool pause_page = picture.kind == Picture::Kind::kPage && picture.question.empty();
      if (!pause_page || waits) return {};
      waits = true;
      return {{.kind = RawInput::Kind::kConnected, .name = "spare pad"}};
    };
    EXPECT_EQ(fixture.run(stage), SessionState::kDone);
    EXPECT_TRUE(waits);
    EXPECT_EQ(fixture.count("unplugged"), 1);
    EXPECT_EQ(fixture.count("choice"), 6);
    const auto events = fixture.store.events();
    const auto plugged = std::find_if(events.begin(), events.end(), [](const SessionEvent& e) {
      return e.kind == "plugged" && e.what == "spare pad";
    });
    ASSERT_NE(plugged, events.end());
    EXPECT_EQ(plugged->trial, with_the_choice ? 2 : 1) << "the trial that waited for it";
  }
}

TEST(Runner, ReferencesThatAPauseDelaysAreViewsOfTheirTrial) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  int step = 0;
  stage.pad = [&](const Picture& picture) -> std::vector<RawInput> {
    const bool stop_page = picture.kind == Picture::Kind::kPage && picture.question.empty();
    if ((step == 0 && picture.kind == Picture::Kind::kBlack && !picture.image.empty()) ||
        (step == 1 && stop_page))
      return ++step, std::vector{key("Escape")};
    return {};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  EXPECT_EQ(step, 2);
  EXPECT_EQ(fixture.count("continued"), 1);
  EXPECT_EQ(fixture.count("shown_again"), 0);
  for (const TrialRecord& trial : fixture.summary().trials) EXPECT_EQ(trial.views_reference, 1);
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
  const auto message = [](SessionMode mode, bool vsync, double stated_hz) {
    Fixture fixture(mode);
    ScriptedStage stage;
    stage.answers["age"] = {"Return"};
    stage.vsync = vsync;
    stage.stated_hz = stated_hz;  // it takes 10 ms a flip
    return message_of([&] { fixture.run(stage); });
  };
  const struct {
    bool vsync;
    double stated_hz;
    const char* fault;
  } cases[]{{false, 100, "do not wait"}, {true, 60, "but flips take 10.00 ms"}, {true, 0, "unknown"}};
  for (const auto& display : cases) {
    const std::string refused = message(SessionMode::kReal, display.vsync, display.stated_hz);
    EXPECT_NE(refused.find("cannot be trusted with time"), std::string::npos) << refused;
    EXPECT_NE(refused.find(display.fault), std::string::npos) << refused;
    EXPECT_EQ(message(SessionMode::kPilot, display.vsync, display.stated_hz), "") << display.fault;
  }
  EXPECT_EQ(message(SessionMode::kReal, true, 100), "");
}

std::string summary_fault(Fixture& fixture, const std::function<void(SessionEvent&)>& change) {
  std::vector<SessionEvent> events = fixture.store.events();
  std::for_each(events.begin(), events.end(), change);
  return message_of([&] { summarise(fixture.store.identity(), fixture.study, events); });
}

TEST(Runner, AChoiceThatWasChangedOnTheDiskIsDamageAndNoAnswer) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  ASSERT_EQ(fixture.run(stage), SessionState::kDone);
  EXPECT_EQ(summary_fault(fixture, [](SessionEvent&) {}), "");
  const auto other = [](std::string& text, const std::string& one, const std::string& two) {
    text = text == one ? two : one;
  };
  const std::pair<const char*, std::function<void(SessionEvent&)>> changes[]{
      {"choice", [&](SessionEvent& e) { other(e.what, "left", "right"); }},
      {"choice", [&](SessionEvent& e) { e.what = "lefu"; }},
      {"choice", [&](SessionEvent& e) { other(e.outcome, "test", "reference"); }},
      {"choice",
       [&](SessionEvent& e) {
         other(e.what, "left", "right");
         other(e.outcome, "test", "reference");
       }},
      {"choice", [](SessionEvent& e) { e.image = "other"; }},
      {"choice", [](SessionEvent& e) { ++e.trial; }},
      {"choice", [](SessionEvent& e) { e.kind = "trial_started"; }},
      {"shown", [&](SessionEvent& e) { e.what.push_back('?'); }},
      {"shown",
       [&](SessionEvent& e) {
         if (e.what == "left" || e.what == "right") other(e.outcome, "test", "reference");
       }},
      {"trial_started", [&](SessionEvent& e) { other(e.outcome, "test_left", "test_right"); }},
      {"trial_started", [](SessionEvent& e) { e.image = "other"; }},
      {"trial_started", [](SessionEvent& e) { e.block = "other"; }},
      {"trial_started", [](SessionEvent& e) { e.position = 3; }},
      {"trial_started", [](SessionEvent& e) { e.kind = "answer"; }}};
  for (const auto& change : changes) {
    const std::string message = summary_fault(fixture, [&](SessionEvent& e) {
      if (e.kind == change.first) change.second(e);
    });
    EXPECT_NE(message.find("it is damaged"), std::string::npos)
        << change.first << " " << &change - changes << ": " << message;
  }
}

TEST(Runner, TheDisplayThatWasTriedIsTheOneTheSessionBeginsOn) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  const DisplayReport display =
      require_displays(stage, fixture.study, fixture.folder.path() / "study", SessionMode::kReal, false);
  const int opened = stage.opened;
  stage.stated_hz = 60;  // what would be found now does not count
  EXPECT_EQ(
      run_session(fixture.store, stage, {.images = fixture.folder.path() / "study", .display = display}),
      SessionState::kDone);
  EXPECT_EQ(stage.opened, opened) << "all is on one display";
  EXPECT_EQ(fixture.count("display"), 1);
}

TEST(Runner, EveryImageIsLoadedBeforeASessionBegins) {
  const TemporaryFolder folder;
  StudyDefinition study = write_tiny_study(folder.path());
  study.blocks.back().zoom = 3;
  ScriptedStage stage;
  require_displays(stage, study, folder.path(), SessionMode::kPilot, false);
  for (const StudyBlock& block : study.blocks)
    for (const std::string& id : block.images)
      for (const std::string& file :
           {study.image(id).on(block.display).reference, study.image(id).on(block.display).test})
        EXPECT_EQ(
            std::count(stage.loaded.begin(), stage.loaded.end(), fmt::format("{} at {}", file, block.zoom)),
            1)
            << block.id << " " << file;
}

TEST(Runner, EveryEventHasItsTime) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  stage.flip();
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  std::int64_t last_us = 1;
  for (const SessionEvent& event : fixture.store.events()) {
    EXPECT_GE(event.t_us, last_us) << event.kind;
    last_us = event.t_us;
  }
}

TEST(Runner, AConsentIsDatedWhenItIsGiven) {
  Fixture fixture;
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  std::string shown_utc;
  stage.pad = [&](const Picture& picture) {
    if (picture.question != "consent" || !shown_utc.empty()) return std::vector<RawInput>{};
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    shown_utc = utc_now();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return std::vector<RawInput>{};
  };
  EXPECT_EQ(fixture.run(stage), SessionState::kDone);
  const auto json = nlohmann::json::parse(read_text_file(fixture.sessions() / "consent" / "real-001.json"));
  ASSERT_FALSE(shown_utc.empty());
  EXPECT_GT(json.at("given_utc").get<std::string>(), shown_utc);
}

TEST(Runner, AnImageThatChangesWhileASessionRunsIsNotShown) {
  const TemporaryFolder folder;
  write_tiny_study(folder.path(), SessionMode::kReal);
  const StudyDefinition study = read_study(folder.path());
  SessionStore store = SessionStore::create(
      folder.path() / "sessions", new_identity(study, SessionMode::kReal, 1), Durability::kProcessEnd);
  ScriptedStage stage;
  stage.answers["age"] = {"Return"};
  int blocks = 0;
  stage.pad = [&](const Picture& picture) {
    if (picture.question.starts_with("block_") && ++blocks == 2)
      write_display_image(folder.path() / "two-test.png", DisplayImage(2, 2));
    return std::vector<RawInput>{};
  };
  const std::string message = message_of([&] { run_session(store, stage, {.images = folder.path()}); });
  EXPECT_NE(message.find("two-test.png has changed since session real-001 began"), std::string::npos)
      << message;
  EXPECT_EQ(summarise(store.identity(), study, store.events()).trials.size(), 3u) << "the first block";
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
