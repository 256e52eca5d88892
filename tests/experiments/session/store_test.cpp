#include "experiments/session/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <thread>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/session/same_study.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/sqlite.h"
#include "experiments/session/study_files.h"
#include "tests/experiments/session/tiny_study.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

unsigned mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 0777;
}

struct Sessions {
  TemporaryFolder folder;
  fs::path path = folder.path() / "sessions";
  StudyDefinition study = write_tiny_study(folder.path() / "study");
  SessionIdentity identity(int number) const { return new_identity(study, SessionMode::kReal, number); }
};

SessionEvent event_of(const std::string& kind) {
  SessionEvent event;
  event.kind = kind;
  event.t_us = 1'000'000'000'000;
  event.detail = "{\"ö\":\"\n,\"}";
  return event;
}

TEST(Store, GivesBackWhatWasStoredInOrder) {
  const Sessions sessions;
  {
    SessionStore store = SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
    for (const char* kind : {"first", "second", "third"}) {
      SessionEvent event = event_of(kind);
      store.append(event);
    }
  }
  const StoredSession stored = read_session(sessions.path / "real-001");
  ASSERT_EQ(stored.events.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(stored.events[i].sequence, static_cast<std::int64_t>(i) + 1);
  EXPECT_EQ(stored.events[2].kind, "third");
  EXPECT_EQ(stored.events[2].t_us, 1'000'000'000'000);
  EXPECT_EQ(stored.events[2].detail, "{\"ö\":\"\n,\"}");
  EXPECT_EQ(stored.identity.mode, SessionMode::kReal);
  EXPECT_EQ(stored.identity.study_hash, study_hash(sessions.study));
}

TEST(Store, IsPrivate) {
  const Sessions sessions;
  SessionStore store = SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
  SessionEvent event = event_of("x");
  store.append(event);
  EXPECT_EQ(mode_of(sessions.path), 0700u);
  EXPECT_EQ(mode_of(sessions.path / "real-001"), 0700u);
  for (const auto& file : fs::directory_iterator(sessions.path / "real-001"))
    EXPECT_EQ(mode_of(file.path()), 0600u) << file.path();
}

TEST(Store, NeverOverwritesASession) {
  const Sessions sessions;
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut); }
  const std::string message =
      message_of([&] { SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut); });
  EXPECT_NE(message.find("never overwritten"), std::string::npos) << message;
  EXPECT_EQ(next_number(sessions.path, SessionMode::kReal), 2);
  EXPECT_EQ(next_number(sessions.path, SessionMode::kPilot), 1);
}

TEST(Store, NoPseudonymIsGivenTwice) {
  const Sessions sessions;
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut); }
  create_private_folder(sessions.path / "consent");
  create_private_file(sessions.path / "consent" / "real-003.json", "{}", Durability::kPowerCut);
  EXPECT_EQ(next_number(sessions.path, SessionMode::kReal), 4) << "real-003 has left its consent";
}

TEST(Store, AnEmptyDatabaseOfASessionThatHadBegunIsDamagedAndItsLogStays) {
  const Sessions sessions;
  const fs::path folder = sessions.path / "real-001", database = folder / "session.db";
  create_private_folder(folder);
  create_private_file(database, "", Durability::kProcessEnd);
  EXPECT_FALSE(holds_session(folder)) << "cut off while it was created";
  create_private_folder(sessions.path / "consent");
  create_private_file(sessions.path / "consent" / "real-001.json", "{}", Durability::kProcessEnd);
  EXPECT_NE(message_of([&] { holds_session(folder); }).find("although"), std::string::npos);
  EXPECT_NE(message_of([&] {
              SessionStore::create(sessions.path, sessions.identity(1), Durability::kProcessEnd);
            }).find("session.db-wal"),
            std::string::npos);
  create_private_file(folder / "session.db-wal", "events", Durability::kProcessEnd);
  for (const auto& attempt :
       std::vector<std::function<void()>>{[&] { holds_session(folder); }, [&] { read_session(folder); },
                                          [&] { SessionStore::open(folder, Durability::kProcessEnd); }}) {
    const std::string message = message_of(attempt);
    EXPECT_NE(message.find("is empty, although"), std::string::npos) << message;
    EXPECT_EQ(read_text_file(folder / "session.db-wal"), "events");
  }
}

TEST(Store, WhoWithdrawsIsRemovedAndLeavesOnlyThatThePseudonymIsTaken) {
  const Sessions sessions;
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut); }
  create_private_folder(sessions.path / "consent");
  create_private_file(sessions.path / "consent" / "real-001.json", "{}", Durability::kPowerCut);
  {
    const SessionStore running = SessionStore::open(sessions.path / "real-001", Durability::kPowerCut);
    EXPECT_NE(message_of([&] { withdraw_session(sessions.path, "real-001"); }).find("in use"),
              std::string::npos);
  }
  withdraw_session(sessions.path, "real-001");
  EXPECT_FALSE(fs::exists(sessions.path / "real-001"));
  EXPECT_TRUE(fs::is_empty(sessions.path / "consent"));
  EXPECT_TRUE(session_folders(sessions.path).empty());
  EXPECT_EQ(next_number(sessions.path, SessionMode::kReal), 2);
  EXPECT_NE(message_of([&] {
              SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
            }).find("was withdrawn"),
            std::string::npos);
  for (const char* name : {"real-001", "real-009", "../study", ""})
    EXPECT_NE(message_of([&] { withdraw_session(sessions.path, name); }).find("holds no session"),
              std::string::npos)
        << name;
}

TEST(Store, FilesAppearWholeOrNotAtAll) {
  const Sessions sessions;
  create_private_folder(sessions.path);
  const fs::path file = sessions.path / "consent.json";
  create_private_file(file.string() + ".abcdef.partial", "half of an attempt that was cut off",
                      Durability::kPowerCut);
  create_private_file(file, "whole", Durability::kPowerCut);
  EXPECT_EQ(read_text_file(file), "whole");
  EXPECT_EQ(mode_of(file), 0600u);
  EXPECT_TRUE(is_partial_of(file, file.string() + ".abcdef.partial"));
  EXPECT_FALSE(is_partial_of(file, file));
  remove_partial_files(file);
  EXPECT_EQ(std::distance(fs::directory_iterator(sessions.path), {}), 1) << "nothing partial is left";
  EXPECT_NE(
      message_of([&] { create_private_file(file, "other", Durability::kPowerCut); }).find("File exists"),
      std::string::npos);
  EXPECT_EQ(read_text_file(file), "whole");
}

TEST(Store, ManyProgramsMayWantAFileAndOneWritesIt) {
  const Sessions sessions;
  create_private_folder(sessions.path);
  std::atomic<int> refused = 0, other = 0;
  std::vector<std::thread> writers;
  for (int i = 0; i < 8; ++i)
    writers.emplace_back([&] {
      const std::string message = message_of([&] {
        create_private_file(sessions.path / "file", std::string(100'000, 'x'), Durability::kPowerCut);
      });
      refused += message.find("File exists") != std::string::npos ? 1 : 0;
      other += message.empty() || message.find("File exists") != std::string::npos ? 0 : 1;
    });
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(refused, 7);
  EXPECT_EQ(other, 0);
  EXPECT_EQ(read_text_file(sessions.path / "file"), std::string(100'000, 'x'));
}

TEST(Store, StationsThatStartAtTheSameTimeGetNumbersOfTheirOwn) {
  const Sessions sessions;
  std::atomic<int> failed = 0;
  std::vector<std::thread> stations;
  for (int i = 0; i < 6; ++i)
    stations.emplace_back([&] {
      const std::string message = message_of([&] {
        create_next_session(sessions.path, sessions.study, SessionMode::kReal, Durability::kProcessEnd);
      });
      failed += message.empty() ? 0 : 1;
    });
  for (std::thread& station : stations) station.join();
  EXPECT_EQ(failed, 0);
  const auto folders = session_folders(sessions.path);
  ASSERT_EQ(folders.size(), 6u);
  for (const fs::path& folder : folders)
    EXPECT_EQ(read_session(folder).identity.participant, folder.filename().string());
}

TEST(Store, TheBeginningOfASessionOfAnotherStationIsNotTakenOver) {
  const Sessions sessions;
  create_private_folder(sessions.path / "real-001");
  const std::string message = message_of([&] {
    SessionStore::create(sessions.path, sessions.identity(1), Durability::kProcessEnd,
                         SessionStore::CutOff::kRefuse);
  });
  EXPECT_NE(message.find("never overwritten"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_empty(sessions.path / "real-001"));
}

TEST(Store, CopiesAndRenamedFoldersAreNotGoneOnWith) {
  const Sessions sessions;
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kProcessEnd); }
  fs::copy(sessions.path / "real-001", sessions.path / "real-009");
  fs::copy(sessions.path / "real-001", sessions.path / "pilot-001");
  for (const char* copy : {"real-009", "pilot-001"})
    EXPECT_NE(message_of([&] {
                SessionStore::open(sessions.path / copy, Durability::kProcessEnd);
              }).find("holds the real session real-001 (number 1): a copy"),
              std::string::npos)
        << copy;
  const auto unread = require_same_study(sessions.path, sessions.study, SessionMode::kReal);
  ASSERT_EQ(unread.size(), 1u);
  EXPECT_NE(unread[0].find("real-009 holds the real session real-001"), std::string::npos) << unread[0];
  EXPECT_EQ(message_of([&] { SessionStore::open(sessions.path / "real-001", Durability::kProcessEnd); }), "");
}

TEST(Store, WithdrawingRemovesNobodyElseAndFollowsNoLinks) {
  const Sessions sessions;
  for (const int number : {1, 2})
    SessionStore::create(sessions.path, sessions.identity(number), Durability::kProcessEnd);
  fs::copy(sessions.path / "real-001", sessions.path / "real-009");
  const auto message = [&](const char* who) {
    return message_of([&] { withdraw_session(sessions.path, who); });
  };
  EXPECT_NE(message("real-009").find("holds the real session real-001"), std::string::npos);
  EXPECT_TRUE(fs::exists(sessions.path / "real-009" / "session.db"));
  fs::rename(sessions.path / "real-002", sessions.folder.path() / "elsewhere");
  fs::create_directory_symlink(sessions.folder.path() / "elsewhere", sessions.path / "real-002");
  EXPECT_NE(message("real-002").find("is a link"), std::string::npos) << message("real-002");
  EXPECT_FALSE(is_withdrawn(sessions.path, "real-002"));
  EXPECT_TRUE(fs::exists(sessions.path / "real-002" / "session.db"));
  create_private_folder(sessions.path / "consent");
  create_private_file(sessions.path / "consent" / "real-001.json.abcdef.partial", "a name",
                      Durability::kProcessEnd);
  const Withdrawal removed = withdraw_session(sessions.path, "real-001");
  EXPECT_TRUE(removed.session);
  EXPECT_FALSE(removed.consent);
  EXPECT_EQ(removed.copies, std::vector{sessions.path / "real-009"});
  EXPECT_TRUE(fs::is_empty(sessions.path / "consent"));
}

TEST(Store, RefusesASecondProgramButNotLaterOnes) {
  const Sessions sessions;
  {
    const SessionStore store =
        SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
    for (const auto& attempt : {std::function<void()>([&] {
                                  SessionStore::open(sessions.path / "real-001", Durability::kPowerCut);
                                }),
                                std::function<void()>([&] { read_session(sessions.path / "real-001"); })})
      EXPECT_NE(message_of(attempt).find("in use by another program"), std::string::npos);
  }
  EXPECT_EQ(message_of([&] { SessionStore::open(sessions.path / "real-001", Durability::kPowerCut); }), "");
}

std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& file : fs::directory_iterator(folder))
    contents[file.path().filename().string()] = read_text_file(file.path());
  return contents;
}

TEST(Store, ReadingChangesNothingInAnInterruptedOrAClosedSession) {
  const Sessions sessions;
  const fs::path cut = sessions.folder.path() / "cut", closed = sessions.path / "real-001";
  {
    SessionStore store = SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
    SessionEvent event = event_of("kept");
    store.append(event);
    fs::copy(closed, cut);  // as a power cut leaves it
  }
  EXPECT_TRUE(contents_of(cut).contains("session.db-wal"));
  for (const fs::path& folder : {cut, closed}) {
    const auto before = contents_of(folder);
    EXPECT_TRUE(holds_session(folder));
    EXPECT_EQ(read_session(folder).events.size(), 1u);
    EXPECT_TRUE(contents_of(folder) == before) << folder;
  }
}

TEST(Store, ManyMayReadAnInterruptedSessionAtTheSameTime) {
  const Sessions sessions;
  const fs::path cut = sessions.folder.path() / "cut";
  {
    SessionStore store = SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
    fs::copy(sessions.path / "real-001", cut);
  }
  std::atomic<int> failed = 0;
  std::vector<std::thread> readers;
  for (int i = 0; i < 4; ++i)
    readers.emplace_back([&] {
      for (int n = 0; n < 20; ++n) failed += message_of([&] { read_session(cut); }).empty() ? 0 : 1;
    });
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(failed, 0);
}

TEST(Store, RealSessionsFollowPilotsOfAnEarlierVersionButNotRealOnes) {
  const Sessions sessions;
  {
    SessionStore::create(sessions.path, new_identity(sessions.study, SessionMode::kPilot, 1),
                         Durability::kProcessEnd);
  }
  StudyDefinition changed = sessions.study;
  changed.title = "With better texts";
  const auto check = [&] { require_same_study(sessions.path, changed, SessionMode::kReal); };
  EXPECT_EQ(message_of(check), "");
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kProcessEnd); }
  EXPECT_NE(message_of(check).find("real-001 ran another version"), std::string::npos);
}

TEST(Store, OneDamagedOrCutOffSessionDoesNotStopAStudy) {
  const Sessions sessions;
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kProcessEnd); }
  create_private_folder(sessions.path / "real-002");
  create_private_file(sessions.path / "real-002" / "session.db", "", Durability::kProcessEnd);
  const auto unread = [&] { return require_same_study(sessions.path, sessions.study, SessionMode::kReal); };
  EXPECT_TRUE(unread().empty()) << "nothing had begun";
  create_private_folder(sessions.path / "real-003");
  create_private_file(sessions.path / "real-003" / "session.db", std::string(8192, 'x'),
                      Durability::kProcessEnd);
  ASSERT_EQ(unread().size(), 1u);
  EXPECT_NE(unread().front().find("real-003"), std::string::npos);
  EXPECT_EQ(next_number(sessions.path, SessionMode::kReal), 4);
}

TEST(Store, RealSessionsDoNotGoOnWithImagesThatHaveChanged) {
  const Sessions sessions;
  const StudyDefinition before = read_study(sessions.folder.path() / "study");
  {
    SessionStore::create(sessions.path, new_identity(before, SessionMode::kReal, 1), Durability::kProcessEnd);
  }
  write_display_image(sessions.folder.path() / "study" / "two-test.png", DisplayImage(2, 2));
  const StudyDefinition after = read_study(sessions.folder.path() / "study");
  EXPECT_EQ(format_study(before), format_study(after));
  const StoredSession stored = read_session(sessions.path / "real-001");
  EXPECT_EQ(difference(stored.identity, before), "");
  EXPECT_EQ(difference(stored.identity, after), "saw another image in two-test.png");
  EXPECT_NE(message_of([&] {
              require_same_study(sessions.path, after, SessionMode::kReal);
            }).find("real-001 saw another image in two-test.png"),
            std::string::npos);
}

TEST(Store, TheDatabaseItselfRefusesChangesAndRemovals) {
  const Sessions sessions;
  {
    SessionStore store = SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
    SessionEvent event = event_of("kept");
    store.append(event);
  }
  SqliteDatabase database(sessions.path / "real-001" / "session.db", SqliteDatabase::Access::kReadWrite);
  for (const char* sql : {"DELETE FROM events", "UPDATE events SET kind = 'x'", "DELETE FROM meta",
                          "UPDATE meta SET value = 'x'", "INSERT INTO meta VALUES ('y', 'z')",
                          "INSERT OR REPLACE INTO meta VALUES ('mode', 'pilot')",
                          "INSERT OR REPLACE INTO events SELECT 1, run, t_us, t_low_us, utc, position, "
                          "trial, attempt, block, image, "
                          "'changed', what, outcome, detail FROM events"})
    EXPECT_NE(message_of([&] { database.execute(sql); }), "") << sql;
  EXPECT_EQ(database.value("SELECT kind FROM events"), "kept");
  EXPECT_EQ(database.value("SELECT value FROM meta WHERE key = 'mode'"), "real");
}

TEST(Store, ACreationThatWasCutOffIsCompleted) {
  const Sessions sessions;
  create_private_folder(sessions.path / "real-001");
  EXPECT_FALSE(holds_session(sessions.path / "real-001"));
  create_private_file(sessions.path / "real-001" / "session.db", "", Durability::kPowerCut);
  EXPECT_FALSE(holds_session(sessions.path / "real-001"));
  EXPECT_NE(message_of([&] { read_session(sessions.path / "real-001"); }).find("cut off"), std::string::npos);
  { SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut); }
  EXPECT_TRUE(holds_session(sessions.path / "real-001"));
}

TEST(Store, DamagedFilesAreToldFromSessions) {
  const Sessions sessions;
  create_private_folder(sessions.path / "real-001");
  create_private_file(sessions.path / "real-001" / "session.db", std::string(8192, 'x'),
                      Durability::kPowerCut);
  EXPECT_NE(message_of([&] { read_session(sessions.path / "real-001"); }).find("damaged"), std::string::npos);
  EXPECT_NE(message_of([&] { read_session(sessions.path / "real-002"); }).find("is no session"),
            std::string::npos);
}

/// No file may grow beyond `bytes` as long as this exists: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  sighandler_t handler_;
  rlimit before_{};
};

TEST(Store, AFullDiskStopsTheSessionWithEverythingBeforeStored) {
  const Sessions sessions;
  std::size_t stored = 0;
  {
    SessionStore store = SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut);
    EXPECT_EQ(message_of([&] { store.require_space(1); }), "");
    EXPECT_NE(message_of([&] { store.require_space(std::uintmax_t{1} << 43); }).find("MiB are free"),
              std::string::npos);
    const auto fill = [&] {
      for (; stored < 10'000; ++stored) {
        SessionEvent event = event_of("press");
        store.append(event);
      }
    };
    std::string message;
    {
      const FullDisk full(200'000);
      message = message_of(fill);
    }
    EXPECT_NE(message.find("everything before is stored"), std::string::npos) << message;
    EXPECT_GT(stored, 10u);
    EXPECT_EQ(store.events().size(), stored);
  }
  EXPECT_EQ(read_session(sessions.path / "real-001").events.size(), stored);
  SessionStore again = SessionStore::open(sessions.path / "real-001", Durability::kPowerCut);
  SessionEvent event = event_of("resumed");
  again.append(event);
  EXPECT_EQ(event.sequence, static_cast<std::int64_t>(stored) + 1);
}

TEST(Store, AFolderThatCannotBeMadeIsNamedWithItsReason) {
  const Sessions sessions;
  const std::string message = message_of(
      [&] { SessionStore::create("/proc/plenolab/sessions", sessions.identity(1), Durability::kPowerCut); });
  EXPECT_NE(message.find("cannot create the folder /proc/plenolab"), std::string::npos) << message;
}

TEST(Store, AReadOnlyFolderIsNamedWithItsReason) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const Sessions sessions;
  create_private_folder(sessions.path);
  fs::permissions(sessions.path, fs::perms::owner_read | fs::perms::owner_exec);
  const std::string message =
      message_of([&] { SessionStore::create(sessions.path, sessions.identity(1), Durability::kPowerCut); });
  EXPECT_NE(message.find("Permission denied"), std::string::npos) << message;
  fs::permissions(sessions.path, fs::perms::owner_all);
}

}  // namespace
}  // namespace plenolab
