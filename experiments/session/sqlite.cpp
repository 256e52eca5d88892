#include "experiments/session/sqlite.h"

#include <fmt/format.h>
#include <unistd.h>

namespace plenolab {

namespace {

[[noreturn]] void fail(sqlite3* database, const std::string& name) {
  const int code = sqlite3_errcode(database);
  if (code == SQLITE_BUSY)
    throw DatabaseInUse(fmt::format("{} is in use by another program: let that one end first", name));
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
    throw InputError(fmt::format("{} is damaged or no database: {}", name, sqlite3_errmsg(database)));
  throw InputError(fmt::format("{}: {}", name, sqlite3_errmsg(database)));
}

std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string())
    uri += c == '?' || c == '#' || c == '%' ? fmt::format("%{:02x}", static_cast<unsigned char>(c))
                                            : std::string(1, c);
  return uri + "?immutable=1";
}

}  // namespace

SqliteStatement::SqliteStatement(sqlite3* database, const std::string& name, const std::string& sql)
    : database_(database), name_(name) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) fail(database, name);
  statement_.reset(statement);
}

SqliteStatement& SqliteStatement::bind(int index, std::int64_t value) {
  if (sqlite3_bind_int64(statement_.get(), index, value) != SQLITE_OK) fail(database_, name_);
  return *this;
}

SqliteStatement& SqliteStatement::bind(int index, const std::string& text) {
  if (sqlite3_bind_text(statement_.get(), index, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT) != SQLITE_OK)
    fail(database_, name_);
  return *this;
}

bool SqliteStatement::step() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  fail(database_, name_);
}

void SqliteStatement::reset() {
  sqlite3_reset(statement_.get());
}

std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteStatement::text(int column) const {
  const void* text = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return text ? std::string(static_cast<const char*>(text), static_cast<std::size_t>(size)) : std::string();
}

SqliteDatabase::SqliteDatabase(const std::filesystem::path& file, Access access) : name_(file.string()) {
  // Without a log nobody has it open, and SQLite can be told to read the file as it stands. With one only a
  // connection that could write finds what is in it.
  const bool log = std::filesystem::exists(name_ + "-wal") || std::filesystem::exists(name_ + "-journal");
  const bool immutable = access == Access::kUnchanged && !log;
  if (access == Access::kUnchanged && log && ::access(name_.c_str(), W_OK) != 0)
    throw InputError(
        fmt::format("{} was not closed and cannot be written: copy its folder to read it", name_));
  sqlite3* database = nullptr;
  const int result = immutable ? sqlite3_open_v2(immutable_uri(file).c_str(), &database,
                                                 SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr)
                               : sqlite3_open_v2(name_.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) fail(database, name_);
  if (access == Access::kReadWrite || immutable) return;
  sqlite3_db_config(database, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  execute("PRAGMA query_only=ON; PRAGMA locking_mode=EXCLUSIVE");
}

void SqliteDatabase::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(database_.get(), name_);
}

SqliteStatement SqliteDatabase::prepare(const std::string& sql) {
  return SqliteStatement(database_.get(), name_, sql);
}

std::string SqliteDatabase::value(const std::string& sql) {
  SqliteStatement statement = prepare(sql);
  return statement.step() ? statement.text(0) : "";
}

}  // namespace plenolab
