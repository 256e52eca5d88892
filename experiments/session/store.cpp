#include "experiments/session/store.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/error.h"
#include "experiments/session/private_files.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/sqlite.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "plenolab-session";
constexpr const char* kVersion = "1";
constexpr const char* kLogSuffix = "-wal";  // SQLite's, beside a database that is open or was not closed

constexpr const char* kSchema = R"sql(
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE events (
  sequence INTEGER PRIMARY KEY AUTOINCREMENT, run INTEGER NOT NULL, t_us INTEGER NOT NULL, t_low_us INTEGER NOT NULL,
  utc TEXT NOT NULL, position INTEGER NOT NULL, trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
  block TEXT NOT NULL, image TEXT NOT NULL, kind TEXT NOT NULL, what TEXT NOT NULL, outcome TEXT NOT NULL,
  detail TEXT NOT NULL);
CREATE TRIGGER events_are_kept BEFORE DELETE ON events BEGIN SELECT RAISE(ABORT, 'events are never removed'); END;
CREATE TRIGGER events_stay BEFORE UPDATE ON events BEGIN SELECT RAISE(ABORT, 'events are never changed'); END;
CREATE TRIGGER events_follow BEFORE INSERT ON events
  WHEN NEW.sequence <> -1 AND NEW.sequence <= (SELECT coalesce(max(sequence), 0) FROM events)
  BEGIN SELECT RAISE(ABORT, 'events are never replaced'); END;
CREATE TRIGGER meta_is_kept BEFORE DELETE ON meta BEGIN SELECT RAISE(ABORT, 'meta is never removed'); END;
CREATE TRIGGER meta_stays BEFORE UPDATE ON meta BEGIN SELECT RAISE(ABORT, 'meta is never changed'); END;
CREATE TRIGGER meta_is_complete BEFORE INSERT ON meta WHEN EXISTS (SELECT 1 FROM meta WHERE key = 'complete')
  BEGIN SELECT RAISE(ABORT, 'meta is complete'); END;
)sql";

constexpr const char* kColumns =
    "run, t_us, t_low_us, utc, position, trial, attempt, block, image, kind, what, outcome, detail";

SessionMode mode_named(const std::string& name, const fs::path& file) {
  for (const SessionMode mode : {SessionMode::kReal, SessionMode::kPilot, SessionMode::kSimulated})
    if (name == name_of(mode)) return mode;
  throw InputError(fmt::format("{} has the unknown mode '{}'", file.string(), name));
}

/// Rolls an interrupted creation back by leaving it empty: all is in one transaction.
void write_identity(SqliteDatabase& database, const SessionIdentity& identity) {
  database.execute("BEGIN IMMEDIATE");
  database.execute(kSchema);
  SqliteStatement insert = database.prepare("INSERT INTO meta VALUES (?, ?)");
  const std::vector<std::pair<std::string, std::string>> values{
      {"format", kFormat},
      {"version", kVersion},
      {"participant", identity.participant},
      {"number", std::to_string(identity.number)},
      {"mode", name_of(identity.mode)},
      {"study", identity.study_json},
      {"study_hash", identity.study_hash},
      {"image_hashes", nlohmann::json(identity.image_hashes).dump()},
      {"created_utc", identity.created_utc},
      {"program", identity.program},
      {"complete", "1"}};
  for (const auto& entry : values) {
    insert.bind(1, entry.first).bind(2, entry.second).step();
    insert.reset();
  }
  database.execute("COMMIT");
}

bool has_no_tables(SqliteDatabase& database) {
  return database.value("SELECT count(*) FROM sqlite_master") == "0";
}

SessionIdentity read_identity(SqliteDatabase& database, const fs::path& file) {
  if (has_no_tables(database))
    throw InputError(fmt::format("{} holds nothing: it was cut off while it was created", file.string()));
  const auto meta = [&](const std::string& key) {
    SqliteStatement statement = database.prepare("SELECT value FROM meta WHERE key = ?");
    statement.bind(1, key);
    if (!statement.step()) throw InputError(fmt::format("{} has no entry '{}' in meta", file.string(), key));
    return statement.text(0);
  };
  if (meta("format") != kFormat || meta("version") != kVersion)
    throw InputError(fmt::format("{} is not a session of this version of the program", file.string()));
  SessionIdentity identity;
  identity.participant = meta("participant");
  const std::string number = meta("number");
  std::from_chars(number.data(), number.data() + number.size(), identity.number);
  identity.mode = mode_named(meta("mode"), file);
  identity.study_json = meta("study");
  identity.study_hash = meta("study_hash");
  const auto hashes = nlohmann::json::parse(meta("image_hashes"), nullptr, false);
  for (const auto& entry : hashes.items())
    if (entry.value().is_string()) identity.image_hashes[entry.key()] = entry.value();
  identity.created_utc = meta("created_utc");
  identity.program = meta("program");
  return identity;
}

std::vector<SessionEvent> read_events(SqliteDatabase& database) {
  SqliteStatement rows =
      database.prepare(fmt::format("SELECT sequence, {} FROM events ORDER BY sequence", kColumns));
  std::vector<SessionEvent> events;
  while (rows.step()) {
    const auto whole = [&](int column) { return static_cast<int>(rows.integer(column)); };
    events.push_back({rows.integer(0), whole(1), rows.integer(2), rows.integer(3), rows.text(4), whole(5),
                      whole(6), whole(7), rows.text(8), rows.text(9), rows.text(10), rows.text(11),
                      rows.text(12), rows.text(13)});
  }
  return events;
}

/// Tries again for a quarter of a second while others have the database: reading takes a moment, a session
/// longer.
void while_briefly_in_use(const std::function<void()>& action) {
  for (int attempt = 0; attempt < 12; ++attempt) {
    try {
      return action();
    } catch (const DatabaseInUse&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  action();
}

/// SQLite takes an empty file for a new database, and removes the log beside it, with all that is in there.
void require_with_its_log(const fs::path& database) {
  const fs::path log = database.string() + kLogSuffix;
  if (fs::file_size(database) == 0 && fs::exists(log) && fs::file_size(log) > 0)
    throw InputError(
        fmt::format("{} is empty, although {} is not: it is damaged; bring back the one the log belongs to",
                    database.string(), log.string()));
}

void require_private(const fs::path& database) {
  for (const char* suffix : {"", kLogSuffix}) {
    const std::string file = database.string() + suffix;
    if (fs::exists(file)) ::chmod(file.c_str(), 0600);
  }
}

}  // namespace

struct SessionStore::Connection {
  Connection(const fs::path& file, Durability durability)
      : database(file, SqliteDatabase::Access::kReadWrite) {
    while_briefly_in_use([&] { take(file, durability); });
  }
  void take(const fs::path& file, Durability durability) {
    // Exclusive locking keeps the WAL index in memory, and everybody else out until the connection closes.
    database.execute("PRAGMA locking_mode=EXCLUSIVE");
    database.execute(durability == Durability::kPowerCut ? "PRAGMA synchronous=FULL"
                                                         : "PRAGMA synchronous=OFF");
    if (database.value("PRAGMA journal_mode=WAL") != "wal")
      throw InputError(fmt::format("{}: this file system cannot keep a write-ahead log", file.string()));
    database.execute("BEGIN IMMEDIATE; COMMIT");  // takes the lock
  }
  SqliteDatabase database;
  std::optional<SqliteStatement> insert;
};

SessionStore::SessionStore(fs::path folder, Durability durability)
    : folder_(std::move(folder)),
      durability_(durability),
      connection_(std::make_shared<Connection>(folder_ / kDatabaseFile, durability)) {
  require_private(folder_ / kDatabaseFile);
}

SessionStore SessionStore::create(const fs::path& sessions, const SessionIdentity& identity,
                                  Durability durability, CutOff cut_off) {
  create_private_folder(sessions);
  const fs::path folder = sessions / identity.participant;
  if (is_withdrawn(sessions, identity.participant))
    throw InputError(fmt::format("{} was withdrawn: its pseudonym is not given again", identity.participant));
  // Of two programs that want the same pseudonym one makes the folder.
  const bool made = ::mkdir(folder.c_str(), 0700) == 0;
  if (!made && errno != EEXIST)
    throw InputError(fmt::format("cannot create {}: {}", folder.string(), std::strerror(errno)));
  if (!made && (cut_off == CutOff::kRefuse || holds_session(folder)))
    throw SessionExists(fmt::format("{} exists: a session is never overwritten", folder.string()));
  if (!fs::exists(folder / kDatabaseFile)) create_private_file(folder / kDatabaseFile, "", durability);
  SessionStore store(folder, durability);
  write_identity(store.connection_->database, identity);
  if (durability == Durability::kPowerCut) sync_folder(sessions);
  store.identity_ = identity;
  return store;
}

SessionStore SessionStore::open(const fs::path& folder, Durability durability) {
  if (!fs::is_regular_file(folder / kDatabaseFile))
    throw InputError(fmt::format("{} is no session: it has no {}", folder.string(), kDatabaseFile));
  require_with_its_log(folder / kDatabaseFile);
  SessionStore store(folder, durability);
  store.identity_ = read_identity(store.connection_->database, folder / kDatabaseFile);
  require_own_folder(store.identity_, folder);
  return store;
}

void SessionStore::append(SessionEvent& event) {
  auto& insert = connection_->insert;
  if (!insert)
    insert.emplace(connection_->database.prepare(fmt::format(
        "INSERT INTO events ({}) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?) RETURNING sequence", kColumns)));
  event.utc = utc_now();
  insert->reset();
  insert->bind(1, event.run)
      .bind(2, event.t_us)
      .bind(3, event.t_low_us)
      .bind(4, event.utc)
      .bind(5, event.position);
  insert->bind(6, event.trial).bind(7, event.attempt).bind(8, event.block).bind(9, event.image);
  insert->bind(10, event.kind).bind(11, event.what).bind(12, event.outcome).bind(13, event.detail);
  try {
    insert->step();
    event.sequence = insert->integer(0);
    insert->step();  // the row is committed when the statement has run to its end
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "cannot store what happens ({}); everything before is stored: make room or repair the disk, "
        "then resume the session",
        error.what()));
  }
}

std::vector<SessionEvent> SessionStore::events() {
  return read_events(connection_->database);
}

void SessionStore::require_space(std::uintmax_t mib) const {
  std::error_code error;
  const fs::space_info space = fs::space(folder_, error);
  if (!error && space.available < mib << 20)
    throw InputError(fmt::format("only {} MiB are free for {}: make room, then resume the session",
                                 space.available >> 20, folder_.string()));
}

bool holds_session(const fs::path& folder) {
  const fs::path file = folder / kDatabaseFile;
  if (!fs::is_regular_file(file)) return false;
  require_with_its_log(file);
  bool holds = false;
  while_briefly_in_use([&] {
    SqliteDatabase database(file, SqliteDatabase::Access::kUnchanged);
    holds = !has_no_tables(database);
  });
  const fs::path consent = consent_file(folder.parent_path(), folder.filename().string());
  if (!holds && fs::exists(consent))
    throw InputError(fmt::format(
        "{} holds nothing, although {} shows that the session had begun: bring its log {}{} back, "
        "without which a copy of it is not whole",
        file.string(), consent.string(), kDatabaseFile, kLogSuffix));
  return holds;
}

void require_own_folder(const SessionIdentity& identity, const fs::path& folder) {
  const std::string name = folder.filename().string();
  if (name != identity.participant || name != pseudonym(identity.mode, identity.number))
    throw InputError(
        fmt::format("{} holds the {} session {} (number {}): a copy, or a folder that was renamed",
                    folder.string(), name_of(identity.mode), identity.participant, identity.number));
}

StoredSession read_session(const fs::path& folder) {
  const fs::path file = folder / kDatabaseFile;
  if (!fs::is_regular_file(file))
    throw InputError(fmt::format("{} is no session: it has no {}", folder.string(), kDatabaseFile));
  require_with_its_log(file);
  StoredSession session;
  while_briefly_in_use([&] {
    SqliteDatabase database(file, SqliteDatabase::Access::kUnchanged);
    session = {read_identity(database, file), read_events(database)};
    if (database.value("PRAGMA quick_check") != "ok")
      throw InputError(fmt::format("{} is damaged", file.string()));
  });
  return session;
}

std::string utc_now() {
  const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), (now - seconds).count());
}

double seconds_between(const std::string& from_utc, const std::string& to_utc) {
  const auto milliseconds = [](const std::string& utc) {
    std::tm time{};
    int ms = 0;
    const int found = std::sscanf(utc.c_str(), "%d-%d-%dT%d:%d:%d.%dZ", &time.tm_year, &time.tm_mon,
                                  &time.tm_mday, &time.tm_hour, &time.tm_min, &time.tm_sec, &ms);
    if (found != 7) throw InputError(fmt::format("'{}' is no time: the session is damaged", utc));
    time.tm_year -= 1900;
    --time.tm_mon;
    return static_cast<double>(::timegm(&time)) * 1000 + ms;
  };
  return (milliseconds(to_utc) - milliseconds(from_utc)) / 1000;
}

}  // namespace plenolab
