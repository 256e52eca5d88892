#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/error.h"

namespace plenolab {

/// The database is locked by another program, or by another connection of this one.
class DatabaseInUse : public InputError {
 public:
  using InputError::InputError;
};

/// A prepared statement of SqliteDatabase.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const std::string& name, const std::string& sql);

  SqliteStatement& bind(int index, std::int64_t value);
  SqliteStatement& bind(int index, const std::string& text);
  /// Runs to the next row; false when there is none. Throws InputError with SQLite's reason.
  bool step();
  /// Makes it ready for other values.
  void reset();
  std::int64_t integer(int column) const;
  std::string text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  sqlite3* database_;
  std::string name_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A connection to one database file. All functions throw InputError with the file's name and SQLite's
/// reason.
class SqliteDatabase {
 public:
  enum class Access {
    kUnchanged,  ///< to read: file and log stay as they are, also when the connection closes
    kReadWrite,
  };
  /// Opens a file that exists. To read one that was not closed (its log is there) takes its lock, and the
  /// file must be writable.
  SqliteDatabase(const std::filesystem::path& file, Access access);

  void execute(const std::string& sql);
  SqliteStatement prepare(const std::string& sql);
  /// The first value of the first row.
  std::string value(const std::string& sql);

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  std::string name_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace plenolab
