#include "experiments/session/simulate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/file.h"
#include "experiments/session/export.h"
#include "experiments/session/same_study.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/study_files.h"
#include "tests/experiments/session/tiny_study.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

struct Simulated {
  explicit Simulated(SimulationOptions options, const std::function<void(StudyDefinition&)>& change = {}) {
    StudyDefinition study = write_tiny_study(folder.path() / "study");
    if (change) change(study);
    write_text_file(folder.path() / "study" / "study.json", format_study(study));
    trials = simulate_study(folder.path() / "study", folder.path() / "sessions", options);
  }
  int events(const std::string& kind, const std::string& outcome = {}) const {
    int count = 0;
    for (const fs::path& session : session_folders(folder.path() / "sessions"))
      for (const SessionEvent& e : read_session(session).events)
        count += e.kind == kind && (outcome.empty() || e.outcome == outcome) ? 1 : 0;
    return count;
  }
  double share(const std::function<bool(const TrialRecord&)>& is) const {
    double count = 0;
    for (const TrialRecord& trial : trials) count += is(trial) ? 1 : 0;
    return count / static_cast<double>(trials.size());
  }
  TemporaryFolder folder;
  std::vector<TrialRecord> trials;
};

SimulationOptions with(ObserverKind kind, int participants, WrongProbabilities wrong = {}) {
  SimulationOptions options;
  options.participants = participants;
  options.observer.kind = kind;
  options.observer.rate = default_rate(kind);
  options.observer.wrong = std::move(wrong);
  return options;
}

constexpr auto kWrong = [](const TrialRecord& trial) { return trial.chose_test; };

TEST(Simulation, TheIdealObserverIsNeverWrong) {
  const Simulated simulated(with(ObserverKind::kIdeal, 5));
  EXPECT_EQ(simulated.trials.size(), 30u);
  EXPECT_EQ(simulated.share(kWrong), 0);
  EXPECT_EQ(simulated.events("session_done"), 5);
}

// Every bound below is five standard deviations of the binomial distribution.
TEST(Simulation, GivenProbabilitiesComeBack) {
  const Simulated simulated(with(ObserverKind::kIdeal, 80, {{"one", 0.3}, {"monitor/two", 0.6}}));
  const auto share = [&](const std::string& block, const std::string& image) {
    int wrong = 0;
    for (const TrialRecord& t : simulated.trials)
      wrong += t.block == block && t.image == image && t.chose_test;
    return wrong / 80.0;
  };
  EXPECT_NEAR(share("headset", "one"), 0.3, 5 * std::sqrt(0.3 * 0.7 / 80));
  EXPECT_NEAR(share("monitor", "one"), 0.3, 5 * std::sqrt(0.3 * 0.7 / 80));
  EXPECT_NEAR(share("monitor", "two"), 0.6, 5 * std::sqrt(0.6 * 0.4 / 80));
  EXPECT_EQ(share("headset", "two"), 0);
  EXPECT_EQ(share("headset", "odd"), 0);
}

TEST(Simulation, GuessingObserversAreWrongHalfTheTimeAlsoOnCatchTrials) {
  const Simulated simulated(with(ObserverKind::kGuessing, 30));
  EXPECT_NEAR(simulated.share(kWrong), 0.5, 5 * std::sqrt(0.25 / 180));
  EXPECT_GT(simulated.share([](const TrialRecord& t) { return t.catch_trial && t.chose_test; }), 0);
}

TEST(Simulation, LapsingObserversAreWrongInHalfOfTheirLapses) {
  SimulationOptions options = with(ObserverKind::kLapsing, 50);
  options.observer.rate = 0.4;
  EXPECT_NEAR(Simulated(options).share(kWrong), 0.2, 5 * std::sqrt(0.2 * 0.8 / 300));
}

TEST(Simulation, BiasedObserversTakeTheLeftImage) {
  SimulationOptions options = with(ObserverKind::kPositionBiased, 10);
  options.observer.rate = 1;
  const Simulated simulated(options);
  EXPECT_EQ(simulated.share([](const TrialRecord& t) { return t.chose_test == t.test_first; }), 1);
}

TEST(Simulation, ImpatientObserversAreRefusedAndComeToTheSameChoices) {
  SimulationOptions options = with(ObserverKind::kImpatient, 10);
  options.observer.rate = 1;
  const Simulated simulated(options);
  EXPECT_EQ(simulated.trials.size(), 60u);
  EXPECT_EQ(simulated.share(kWrong), 0);
  EXPECT_EQ(simulated.share([](const TrialRecord& t) { return t.refused == 1; }), 1);
  for (const char* outcome :
       {"refused_reference", "same_image", "ignored_too_soon", "ignored_during_blank", "ignored_not_started"})
    EXPECT_EQ(simulated.events("press", outcome), 60) << outcome;
}

TEST(Simulation, UnpluggingChoosesNothingAndCountsNoView) {
  SimulationOptions options = with(ObserverKind::kUnplugging, 10);
  options.observer.rate = 1;
  const Simulated simulated(options);
  EXPECT_EQ(simulated.trials.size(), 60u);
  EXPECT_EQ(simulated.share(kWrong), 0);
  EXPECT_EQ(simulated.events("unplugged"), 60);
  EXPECT_EQ(simulated.events("shown_again"), 60);
  EXPECT_EQ(simulated.events("choice"), 60);
  // The pad is out for 0.8 s; then a quarter of a second of black, and frames of 17 ms for it to begin and
  // end.
  EXPECT_EQ(simulated.share([](const TrialRecord& t) { return std::abs(t.paused_us - 1'075'000) < 25'000; }),
            1);
  const Simulated calm(with(ObserverKind::kIdeal, 10));
  const auto views = [](const Simulated& s) {
    int count = 0;
    for (const TrialRecord& t : s.trials) count += t.views_reference + t.views_a + t.views_b;
    return count;
  };
  EXPECT_EQ(views(simulated), views(calm));
}

TEST(Simulation, BlackLastsAQuarterOfASecondBeforeEveryImageOfEveryone) {
  for (const std::string& name : observer_names()) {
    const Simulated simulated(with(observer_named(name), 3));
    int images = 0;
    for (const fs::path& folder : session_folders(simulated.folder.path() / "sessions")) {
      std::int64_t black_since_us = -1;
      for (const SessionEvent& e : read_session(folder).events) {
        if (e.kind != "shown" && e.kind != "shown_again") continue;
        if (e.what == "black") {
          black_since_us = e.t_us;
          continue;
        }
        ++images;
        EXPECT_GE(e.t_us - black_since_us, 250'000) << name;
      }
    }
    EXPECT_GE(images, 54) << name;
  }
}

TEST(Simulation, SessionsThatAreThereStayAndOthersAreRefused) {
  const Simulated simulated(with(ObserverKind::kIdeal, 2));
  const fs::path study = simulated.folder.path() / "study", sessions = simulated.folder.path() / "sessions";
  const std::string before = read_text_file(sessions / "simulated-001" / "session.db");
  EXPECT_EQ(simulate_study(study, sessions, with(ObserverKind::kIdeal, 3)).size(), 18u);
  EXPECT_EQ(read_text_file(sessions / "simulated-001" / "session.db"), before);
  StudyDefinition other = read_study(study);
  EXPECT_NE(message_of([&] {
              require_same_study(sessions, other, SessionMode::kReal);
            }).find("folder of their own"),
            std::string::npos);
  EXPECT_EQ(message_of([&] { require_same_study(sessions, other, SessionMode::kSimulated); }), "");
  other.blank_ms = 300;
  EXPECT_NE(message_of([&] {
              require_same_study(sessions, other, SessionMode::kSimulated);
            }).find("another version"),
            std::string::npos);
}

TEST(Simulation, OneDamagedSessionIsToldAndTheOthersGoOn) {
  const Simulated simulated(with(ObserverKind::kIdeal, 3));
  const fs::path study = simulated.folder.path() / "study", sessions = simulated.folder.path() / "sessions";
  write_text_file(sessions / "simulated-002" / "session.db", std::string(8192, 'x'));
  SimulationOptions options = with(ObserverKind::kIdeal, 4);
  EXPECT_NE(message_of([&] { simulate_study(study, sessions, options); }).find("simulated-002"),
            std::string::npos);
  std::vector<std::string> unread;
  options.on_unread = [&](const std::string& why) { unread.push_back(why); };
  EXPECT_EQ(simulate_study(study, sessions, options).size(), 18u);
  ASSERT_EQ(unread.size(), 1u);
  EXPECT_NE(unread[0].find("simulated-002"), std::string::npos) << unread[0];
  EXPECT_EQ(read_text_file(sessions / "simulated-002" / "session.db"), std::string(8192, 'x'));
}

TEST(Simulation, TheFolderOfPeoplesSessionsIsRefused) {
  const TemporaryFolder folder;
  write_tiny_study(folder.path());
  EXPECT_NE(message_of([&] {
              simulate_study(folder.path(), folder.path() / "." / "sessions", with(ObserverKind::kIdeal, 1));
            }).find("is where the sessions of people go"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "sessions"));
}

TEST(Simulation, AFolderOfOtherOptionsOrOfSomethingElseIsRefused) {
  const Simulated simulated(with(ObserverKind::kIdeal, 1, {{"one", 0.25}}));
  const fs::path study = simulated.folder.path() / "study", sessions = simulated.folder.path() / "sessions";
  const auto message = [&](const SimulationOptions& options, const fs::path& folder) {
    return message_of([&] { simulate_study(study, folder, options); });
  };
  EXPECT_EQ(message(with(ObserverKind::kIdeal, 2, {{"one", 0.25}}), sessions), "");
  EXPECT_NE(message(with(ObserverKind::kIdeal, 1, {{"one", 0.5}}), sessions)
                .find("was simulated with observer ideal, rate 0, seed 1, wrong one 0.25, not with"),
            std::string::npos);
  SimulationOptions seeded = with(ObserverKind::kIdeal, 1, {{"one", 0.25}});
  seeded.observer.seed = 2;
  EXPECT_NE(message(seeded, sessions).find("seed 2"), std::string::npos);
  EXPECT_NE(message(with(ObserverKind::kGuessing, 1), sessions).find("observer guessing"), std::string::npos);
  EXPECT_EQ(session_folders(sessions).size(), 2u);
  EXPECT_NE(message(with(ObserverKind::kIdeal, 1), study).find("is there and no simulation"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(study / "simulated-001"));
  write_text_file(sessions / "simulation.json", "{}");
  EXPECT_NE(message(seeded, sessions).find("simulation.json is damaged"), std::string::npos);
}

TEST(Export, HoldsEveryTrialAndNoName) {
  const Simulated simulated(with(ObserverKind::kIdeal, 3),
                            [](StudyDefinition& study) { study.consent.signature = true; });
  const fs::path sessions = simulated.folder.path() / "sessions", out = simulated.folder.path() / "out";
  const ExportCounts counts = export_sessions(sessions, SessionMode::kSimulated, out);
  EXPECT_EQ(counts.trials, 18);
  EXPECT_NE(read_text_file(sessions / "consent" / "simulated-001.json").find("Simulated 1"),
            std::string::npos);
  std::string everything = read_text_file(sessions / "simulated-001" / "session.db");
  for (const auto& entry : fs::recursive_directory_iterator(out))
    if (entry.is_regular_file()) everything += read_text_file(entry.path());
  EXPECT_EQ(everything.find("Simulated 1"), std::string::npos);
  const std::string csv = read_text_file(out / "trials.csv");
  EXPECT_EQ(
      csv.substr(0, csv.find("\r\n")),
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused,attempt,paused_s,dropped_frames,session_state");
  EXPECT_TRUE(csv.ends_with(",1,0.000000,0,done\r\n")) << csv.substr(csv.size() - 100);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 19);
  for (const char* file : {"dataset_description.json", "participants.tsv", "task-matching_beh.json",
                           "sub-simulated002/beh/sub-simulated002_task-matching_run-2_beh.tsv",
                           "sub-simulated002/beh/sub-simulated002_task-matching_run-2_events.tsv"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  EXPECT_NE(
      message_of([&] { export_sessions(sessions, SessionMode::kReal, out); }).find("holds no real sessions"),
      std::string::npos);
}

TEST(Export, RefusesCopiesAndRenamedFoldersOfSessions) {
  const Simulated simulated(with(ObserverKind::kIdeal, 2));
  const fs::path sessions = simulated.folder.path() / "sessions", out = simulated.folder.path() / "out";
  const auto message = [&](SessionMode mode) {
    return message_of([&] { export_sessions(sessions, mode, out); });
  };
  fs::copy(sessions / "simulated-002", sessions / "simulated-002-copy");
  EXPECT_NE(message(SessionMode::kSimulated).find("a copy"), std::string::npos);
  fs::remove_all(sessions / "simulated-002-copy");
  EXPECT_EQ(message(SessionMode::kSimulated), "");
  fs::rename(sessions / "simulated-002", sessions / "real-002");
  EXPECT_NE(message(SessionMode::kReal).find("holds the simulated session simulated-002"), std::string::npos);
}

TEST(Export, FailsOnDamageAndOnNothingToExportAndNamesWhatItLeavesOut) {
  const Simulated simulated(with(ObserverKind::kIdeal, 2));
  const fs::path sessions = simulated.folder.path() / "sessions", out = simulated.folder.path() / "out";
  const auto message = [&](ExportOptions options = {}) {
    return message_of([&] { export_sessions(sessions, SessionMode::kSimulated, out, options); });
  };
  write_text_file(sessions / "simulated-003" / "session.db", "");
  {
    const SessionStore running = SessionStore::open(sessions / "simulated-001", Durability::kProcessEnd);
    EXPECT_EQ(message(), "");
    EXPECT_EQ(read_text_file(out / "left_out.csv"),
              "session,reason\r\nsimulated-001,in use\r\nsimulated-003,cut off while it was created\r\n");
    const SessionStore too = SessionStore::open(sessions / "simulated-002", Durability::kProcessEnd);
    EXPECT_NE(message().find("nothing to export"), std::string::npos) << message();
    EXPECT_NE(message().find("simulated-002 (in use)"), std::string::npos) << message();
  }
  fs::resize_file(sessions / "simulated-002" / "session.db", 5000);
  EXPECT_NE(message().find("nothing is exported (--leave-out-damaged"), std::string::npos) << message();
  EXPECT_EQ(message({.leave_out_damaged = true}), "");
  EXPECT_NE(read_text_file(out / "left_out.csv").find("simulated-002,damaged\r\n"), std::string::npos);
  EXPECT_EQ(read_text_file(out / "trials.csv").find("simulated-002"), std::string::npos);
}

TEST(Export, IsForItsOwnerAloneAndTellsNoDates) {
  const Simulated simulated(with(ObserverKind::kIdeal, 3));
  const fs::path sessions = simulated.folder.path() / "sessions", out = simulated.folder.path() / "out";
  const ExportCounts counts = export_sessions(sessions, SessionMode::kSimulated, out);
  EXPECT_EQ(counts.orders.at("headset-first"), 2);
  EXPECT_EQ(counts.orders.at("monitor-first"), 1);
  const auto others = fs::perms::group_all | fs::perms::others_all;
  const std::string day = utc_now().substr(0, 10);
  EXPECT_EQ(fs::status(out).permissions() & others, fs::perms::none);
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    EXPECT_EQ(entry.status().permissions() & others, fs::perms::none) << entry.path();
    if (entry.is_directory()) continue;
    EXPECT_EQ(read_text_file(entry.path()).find(day), std::string::npos) << entry.path();
  }
  EXPECT_NE(read_text_file(out / "events.csv").find(",since_start_s,"), std::string::npos);
  export_sessions(sessions, SessionMode::kSimulated, out, {.wall_clock = true});
  EXPECT_NE(read_text_file(out / "events.csv").find(day), std::string::npos);
  EXPECT_EQ(seconds_between("2026-02-28T23:59:59.900Z", "2026-03-01T00:00:01.150Z"), 1.25);
}

TEST(Export, NamesWhatIsNotBidsForItsValidator) {
  const Simulated simulated(with(ObserverKind::kIdeal, 1));
  const fs::path out = simulated.folder.path() / "out";
  export_sessions(simulated.folder.path() / "sessions", SessionMode::kSimulated, out);
  const std::string ignored = read_text_file(out / ".bidsignore");
  for (const auto& entry : fs::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    const bool bids = name == "README" || name == "dataset_description.json" || name == ".bidsignore" ||
                      name.starts_with("participants.") || name.starts_with("task-") ||
                      name.starts_with("sub-");
    EXPECT_EQ(ignored.find(name + "\n") != std::string::npos, !bids) << name;
  }
}

TEST(WrongProbabilities, AreReadFromATableAndBadLinesAreNamed) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "wrong.csv";
  write_text_file(file, "block,image,wrong\r\nmonitor,one,0.25\r\n,two,1\r\n");
  const WrongProbabilities wrong = read_wrong_probabilities(file);
  EXPECT_EQ(wrong.at("monitor/one"), 0.25);
  EXPECT_EQ(wrong.at("two"), 1);
  for (const char* text : {"block,image\n", "block,image,wrong\na,b,2\n", "block,image,wrong\na,b,nan\n",
                           "block,image,wrong\na,b\n"}) {
    write_text_file(file, text);
    EXPECT_NE(message_of([&] { read_wrong_probabilities(file); }).find("wrong.csv"), std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace plenolab
