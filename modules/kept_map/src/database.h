// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SQLite as values that close themselves and failures that are exceptions.
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace edgevo {

/// What SQLite says of a failure, without a place or a remedy: the caller knows them.
class DatabaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A statement of SQL with values.
class Statement {
 public:
  /// Throws DatabaseError.
  Statement(sqlite3* database, const std::string& sql);

  /// Sets the value of the `number`-th question mark, from 1. Bytes must outlive the next step().
  Statement& bind(int number, int64_t value);
  /// As above; text.
  Statement& bind_text(int number, const std::string& value);
  /// As above; bytes.
  Statement& bind_bytes(int number, std::string_view value);
  /// The next row; false after the last one. Throws DatabaseError.
  bool step();
  /// Executes a statement that returns no row, and makes it ready for other values. Throws DatabaseError.
  void execute();
  /// Makes it ready for other values.
  void reset();

  /// Value of a column of the row, from 0.
  int64_t integer(int column) const;
  /// As above; valid until the next step().
  std::string_view bytes(int column) const;

 private:
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};

/// An open database.
class Database {
 public:
  /// How to open a file.
  enum class Access {
    kCreate,     ///< A new file; one of that name must not be there.
    kWrite,      ///< A file that is there.
    kUnchanging  ///< To be read, by nobody written: no lock is taken, and nothing is written next to it.
  };

  /// Throws DatabaseError.
  Database(const std::string& path, Access access);

  /// Executes statements without values. Throws DatabaseError.
  void execute(const std::string& sql);
  /// Where SQLite keeps what a transaction needs to be undone or done: "WAL", a file next to it; "MEMORY".
  /// Throws DatabaseError.
  void set_log(const std::string& mode) { execute(std::string("PRAGMA ") + "journal_mode" + "=" + mode); }
  /// A statement. Throws DatabaseError.
  Statement statement(const std::string& sql) { return {database_.get(), sql}; }

 private:
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

}  // namespace edgevo
