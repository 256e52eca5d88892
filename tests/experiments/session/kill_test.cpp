#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "analysis/psychophysics/csv.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/random.h"
#include "experiments/session/example_study.h"
#include "experiments/session/export.h"
#include "experiments/session/same_study.h"
#include "experiments/session/simulate.h"
#include "experiments/session/sqlite.h"
#include "experiments/session/study_files.h"
#include "tests/experiments/plane_field.h"
#include "tests/experiments/session/tiny_study.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> simulate_arguments(const fs::path& study, const fs::path& out) {
  return {PLENOLAB_PROGRAM, "session", "simulate", study,       "--participants", "1",  "--observer",
          "unplugging",     "--wrong", "one=0.5",  "--durable", "--echo",         "-o", out};
}

struct Killed {
  std::int64_t last = 0;  ///< event that was acknowledged; more may be stored
  int status = 0;         ///< as of waitpid
  std::string rest;       ///< what it said after the signal
};

/// Runs the program and sends it a signal once it has acknowledged `events` events.
Killed run_and_kill(const std::vector<std::string>& arguments, int events, int number = SIGKILL) {
  int ends[2];
  PLENOLAB_CHECK(::pipe(ends) == 0, "pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  std::FILE* lines = ::fdopen(ends[0], "r");
  Killed killed;
  char line[512];
  for (int i = 0; i < events && std::fgets(line, sizeof line, lines); ++i)
    if (line[0] >= '0' && line[0] <= '9' && std::string(line).back() == '\n') killed.last = std::atoll(line);
  ::kill(child, number);
  while (number != SIGKILL && std::fgets(line, sizeof line, lines)) killed.rest += line;
  ::waitpid(child, &killed.status, 0);
  std::fclose(lines);
  return killed;
}

/// Without the attempt, in which trials that were interrupted differ.
std::string exported_trials(const fs::path& sessions, const fs::path& out) {
  export_sessions(sessions, SessionMode::kSimulated, out);
  const CsvTable table = parse_csv(read_text_file(out / "trials.csv"), "trials.csv");
  std::string text;
  for (const CsvRow& row : table.rows)
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      if (table.columns[column] != "attempt") text += row.fields[column] + "\n";
  return text;
}

void expect_sound(const fs::path& session, std::int64_t acknowledged) {
  {
    SqliteDatabase database(session / "session.db", SqliteDatabase::Access::kReadWrite);
    EXPECT_EQ(database.value("PRAGMA integrity_check"), "ok");
  }
  const StoredSession stored = read_session(session);
  ASSERT_GE(static_cast<std::int64_t>(stored.events.size()), acknowledged);
  for (std::size_t i = 0; i < stored.events.size(); ++i)
    ASSERT_EQ(stored.events[i].sequence, static_cast<std::int64_t>(i) + 1);
}

/// PLENOLAB_KILLS sets another number of kills (scripts/kill-session.sh).
int kills_wanted() {
  const char* wanted = std::getenv("PLENOLAB_KILLS");
  return wanted ? std::atoi(wanted) : 10;
}

TEST(KilledSession, KeepsEveryAcknowledgedEventAndGoesOnAsIfNothingHadHappened) {
  const TemporaryFolder folder;
  const fs::path study = folder.path() / "study";
  write_tiny_study(study);
  run_and_kill(simulate_arguments(study, folder.path() / "whole"), 100'000);
  const std::string whole = exported_trials(folder.path() / "whole", folder.path() / "whole-out");
  int kills = 0, repeated = 0;
  for (int session = 0; kills < kills_wanted(); ++session) {
    const fs::path out = folder.path() / ("killed-" + std::to_string(session));
    bool ended = false;
    for (std::uint64_t attempt = 0; !ended; ++attempt) {
      // At most six times within a session: later runs then come to the end.
      const std::uint64_t word = random_u64(7, static_cast<std::uint64_t>(session), attempt);
      const int events = attempt < 6 ? 1 + static_cast<int>(word % 60) : 100'000;
      const Killed killed = run_and_kill(simulate_arguments(study, out), events);
      ended = WIFEXITED(killed.status);
      kills += ended ? 0 : 1;
      if (holds_session(out / "simulated-001")) expect_sound(out / "simulated-001", killed.last);
    }
    EXPECT_EQ(exported_trials(out, folder.path() / ("out-" + std::to_string(session))), whole) << session;
    const StoredSession stored = read_session(out / "simulated-001");
    for (const TrialRecord& t : summarise(stored.identity, study_of(stored.identity), stored.events).trials)
      repeated += t.attempt > 1 ? 1 : 0;
  }
  EXPECT_GT(repeated, 0) << "no kill hit a trial: the test tests nothing";
}

TEST(KilledSession, AFullDiskIsOneSentenceAndNothingIsLost) {
  const TemporaryFolder folder;
  const fs::path study = folder.path() / "study", out = folder.path() / "sessions";
  write_tiny_study(study);
  std::vector<std::string> arguments = simulate_arguments(study, out);
  arguments.erase(arguments.begin());
  const ProgramResult full = run_program(arguments, [] {
    const rlimit limit{90'000, 90'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  });
  expect_one_clear_sentence(full, "everything before is stored", 1);
  const std::size_t stored = read_session(out / "simulated-001").events.size();
  EXPECT_GT(stored, 5u);
  EXPECT_EQ(run_program(arguments).status, 0);
  EXPECT_GT(read_session(out / "simulated-001").events.size(), stored);
}

TEST(KilledSession, ASignalToStopEndsItInGoodOrderAndTellsHowToGoOn) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "it's a study";
  write_tiny_study(folder);
  ::setenv("SDL_VIDEODRIVER", "dummy", 1), ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
    const Killed killed = run_and_kill(
        {PLENOLAB_PROGRAM, "session", "run", folder, "--pilot", "--keyboard", "--echo"}, 3, number);
    EXPECT_TRUE(WIFSIGNALED(killed.status) && WTERMSIG(killed.status) == number) << killed.status;
    const std::string who = fmt::format("pilot-{:03}", number == SIGTERM ? 1 : number == SIGINT ? 2 : 3);
    EXPECT_NE(killed.rest.find(fmt::format("session {} was stopped; everything so far is stored in ", who)),
              std::string::npos)
        << killed.rest;
    const std::string quoted = fmt::format("'{}'", (parent.path() / "it'\\''s a study").string());
    EXPECT_NE(killed.rest.find(fmt::format("; to go on: plenolab session resume {} {}\n", quoted, who)),
              std::string::npos)
        << killed.rest;
    const StoredSession stored = read_session(folder / "sessions" / who);
    EXPECT_EQ(stored.events.back().kind, "stopped");
    EXPECT_NE(stored.events.front().detail.find(R"("audio":"yes")"), std::string::npos);
  }
  ::unsetenv("SDL_VIDEODRIVER"), ::unsetenv("SDL_AUDIODRIVER");
}

TEST(SessionCommand, RefusesToMixPilotsWithData) {
  const TemporaryFolder folder;
  write_tiny_study(folder.path() / "pilot");
  write_tiny_study(folder.path() / "real", SessionMode::kReal);
  expect_one_clear_sentence(run_program({"session", "run", folder.path() / "pilot", "--keyboard"}),
                            "this study is in pilot mode", 2);
  expect_one_clear_sentence(run_program({"session", "run", folder.path() / "real", "--window"}),
                            "--window is for pilots", 2);
  EXPECT_FALSE(fs::exists(folder.path() / "real" / "sessions"));
  expect_one_clear_sentence(run_program({"session", "rum"}),
                            "'plenolab session' has no 'rum'; did you mean 'run'?", 2);
  expect_one_clear_sentence(run_program({"session", "run", "x", "--pilott"}),
                            "'plenolab session run' has no option --pilott; did you mean '--pilot'?", 2);
  expect_one_clear_sentence(run_program({"session", "simulate", folder.path() / "pilot", "--wrong", "one=2",
                                         "-o", folder.path() / "x"}),
                            "--wrong: 'one=2' is not", 2);
  expect_one_clear_sentence(run_program({"session", "simulate", folder.path() / "pilot", "--wrong", "oen=0.2",
                                         "-o", folder.path() / "x"}),
                            "--wrong: the study shows no image 'oen'; did you mean 'one'?", 2);
  expect_one_clear_sentence(run_program({"session", "new", folder.path()}), "never overwritten", 1);
}

TEST(SessionCommand, BadValuesOfOptionsAreWrongUse) {
  const TemporaryFolder folder;
  write_tiny_study(folder.path() / "study");
  const std::string study = folder.path() / "study", out = folder.path() / "out";
  create_private_folder(folder.path() / "study" / "sessions" / "pilot-001");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"session", "new", ""}, "give a name, not ''"},
      {{"session", "list", ""}, "give a name, not ''"},
      {{"session", "run", ""}, "give a name, not ''"},
      {{"session", "simulate", study, "-o", out, "--wrong", "one=0.1", "--wrong", "one=0.2"},
       "'one' is given twice"},
      {{"session", "simulate", study, "-o", out, "--wrong", "monitr/one=0.1"}, "did you mean 'monitor/one'?"},
      {{"session", "withdraw", study, "pilot-010"}, "holds no session 'pilot-010'"}};
  for (const auto& entry : cases) expect_one_clear_sentence(run_program(entry.first), entry.second, 2);
  EXPECT_FALSE(fs::exists(out));
  write_text_file(folder.path() / "wrong.csv", "block,image,wrong\n,oen,0.5\n");
  expect_one_clear_sentence(
      run_program({"session", "simulate", study, "-o", out, "--wrong-file", folder.path() / "wrong.csv"}),
      "wrong.csv: the study shows no image 'oen'; did you mean 'one'?", 1);
}

TEST(SessionCommand, ThePlaceholderOfTheConsentIsForPilotsOnly) {
  const TemporaryFolder folder;
  const auto headless = [] {
    ::setenv("SDL_VIDEODRIVER", "dummy", 1), ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  };
  StudyDefinition study = write_tiny_study(folder.path(), SessionMode::kReal);
  study.consent.text = example_study().consent.text;
  write_text_file(folder.path() / "study.json", format_study(study));
  expect_one_clear_sentence(run_program({"session", "run", folder.path(), "--keyboard"}, headless),
                            "is still the placeholder", 1);
  const ProgramResult pilot = run_program({"session", "run", folder.path(), "--pilot"}, headless);
  EXPECT_NE(pilot.err.find("is still the placeholder"), std::string::npos) << pilot.err;
  EXPECT_NE(pilot.err.find("no pad is connected"), std::string::npos) << "it goes on: " << pilot.err;
}

TEST(SessionCommand, AStartThatFailsLeavesNoSession) {
  const TemporaryFolder folder;
  write_tiny_study(folder.path());
  const auto headless = [] {
    ::setenv("SDL_VIDEODRIVER", "dummy", 1), ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  };
  expect_one_clear_sentence(run_program({"session", "run", folder.path(), "--pilot"}, headless),
                            "no pad is connected", 1);
  EXPECT_FALSE(fs::exists(folder.path() / "sessions"));
  write_tiny_study(folder.path(), SessionMode::kReal);
  expect_one_clear_sentence(run_program({"session", "run", folder.path(), "--keyboard"}, headless),
                            "cannot be trusted with time", 1);
  StudyDefinition two_screens = write_tiny_study(folder.path());
  two_screens.blocks[1].screen = 1;
  write_text_file(folder.path() / "study.json", format_study(two_screens));
  expect_one_clear_sentence(run_program({"session", "run", folder.path(), "--pilot", "--keyboard"}, headless),
                            "the study wants display 1, but there are only 1", 1);
  EXPECT_FALSE(fs::exists(folder.path() / "sessions"));
  const auto no_screen = [] {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"}) ::unsetenv(name);
    ::setenv("XDG_RUNTIME_DIR", "/nonexistent", 1);
  };
  const ProgramResult blind =
      run_program({"session", "run", folder.path(), "--pilot", "--keyboard"}, no_screen);
  EXPECT_EQ(blind.status, 1) << blind.err;
  EXPECT_FALSE(fs::exists(folder.path() / "sessions"));
  expect_one_clear_sentence(run_program({"session", "resume", folder.path()}, headless),
                            "is no folder of sessions", 1);
}

TEST(SessionCommand, ListsAndExportsWhatCanBeReadAndTellsWhatCannot) {
  const TemporaryFolder folder;
  const StudyDefinition study = write_tiny_study(folder.path() / "study");
  SimulationOptions options;
  options.participants = 2;
  simulate_study(folder.path() / "study", folder.path() / "sessions", options);
  const std::string sessions = folder.path() / "sessions", out = folder.path() / "out";
  write_text_file(folder.path() / "sessions" / "simulated-003" / "session.db", std::string(8192, 'x'));
  const ProgramResult listed = run_program({"session", "list", sessions});
  EXPECT_NE(listed.out.find("in the order headset-first: 1"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("not read: "), std::string::npos) << listed.out;
  {
    const SessionStore running =
        SessionStore::open(folder.path() / "sessions" / "simulated-001", Durability::kProcessEnd);
    const ProgramResult meanwhile = run_program({"session", "list", sessions});
    EXPECT_NE(meanwhile.out.find("running: simulated-001\n"), std::string::npos) << meanwhile.out;
  }
  const ProgramResult json = run_program({"session", "list", sessions, "--json", "-"});
  const auto rows = nlohmann::json::parse(json.out).at("rows");
  EXPECT_EQ(rows.back().at("quantity"), "sessions_not_read");
  EXPECT_EQ(rows.back().at("value"), 1);
  expect_one_clear_sentence(run_program({"session", "export", sessions, "--mode", "simulated", "-o", out}),
                            "is damaged or no database", 1);
  EXPECT_FALSE(fs::exists(out));
  const ProgramResult exported = run_program(
      {"session", "export", sessions, "--mode", "simulated", "-o", out, "--leave-out-damaged", "--csv", "-"});
  EXPECT_EQ(exported.status, 0) << exported.err;
  for (const auto& entry : fs::recursive_directory_iterator(out))
    EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all), fs::perms::none)
        << entry.path();
  EXPECT_TRUE(fs::exists(fs::path(out) / "run.json"));
  EXPECT_NE(exported.out.find("simulated,,sessions_done,2,sessions"), std::string::npos) << exported.out;
  EXPECT_NE(exported.out.find("simulated,,sessions_left_out,1,sessions"), std::string::npos) << exported.out;
}

TEST(SessionCommand, CopiesOfSessionsAreNeitherResumedNorListed) {
  const TemporaryFolder folder;
  const StudyDefinition study = write_tiny_study(folder.path());
  {
    SessionStore::create(folder.path() / "sessions",
                         new_identity(read_study(folder.path()), SessionMode::kPilot, 1),
                         Durability::kProcessEnd);
  }
  fs::copy(folder.path() / "sessions" / "pilot-001", folder.path() / "sessions" / "pilot-009");
  const char* why = "pilot-009 holds the pilot session pilot-001 (number 1): a copy";
  expect_one_clear_sentence(run_program({"session", "resume", folder.path(), "pilot-009", "--yes"}), why, 1);
  const ProgramResult listed = run_program({"session", "list", folder.path()});
  EXPECT_NE(listed.out.find(why), std::string::npos) << listed.out;
  expect_one_clear_sentence(run_program({"session", "withdraw", folder.path(), "pilot-009", "--yes"}), why,
                            1);
  const ProgramResult withdrawn = run_program({"session", "withdraw", folder.path(), "pilot-001", "--yes"});
  EXPECT_NE(withdrawn.out.find("removed session pilot-001, which had no consent"), std::string::npos)
      << withdrawn.out;
  EXPECT_NE(withdrawn.out.find("pilot-009 holds a copy of the session"), std::string::npos) << withdrawn.out;
}

TEST(SessionCommand, EverySubcommandExplainsItselfWithAnExample) {
  for (const char* command : {"new", "run", "resume", "withdraw", "simulate", "list", "export"}) {
    const ProgramResult result = run_program({"session", command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_NE(result.out.find(std::string("Example: plenolab session ") + command), std::string::npos)
        << command;
  }
}

}  // namespace
}  // namespace plenolab
