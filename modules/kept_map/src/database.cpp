// SPDX-License-Identifier: BSD-3-Clause
#include "database.h"

#include <sqlite3.h>

#include <cctype>

namespace edgevo {
namespace {

[[noreturn]] void fail(sqlite3* database) { throw DatabaseError(sqlite3_errmsg(database)); }

// A path as part of a URI.
std::string escaped(const std::string& path) {
  static const char* const kDigits = "0123456789ABCDEF";
  std::string text;
  for (const char c : path) {
    const auto byte = uint8_t(c);
    if (std::isalnum(byte) || c == '/' || c == '.' || c == '_' || c == '-')
      text += c;
    else
      text += std::string("%") + kDigits[byte >> 4] + kDigits[byte & 15];
  }
  return text;
}

std::string uri_of(const std::string& path, Database::Access access) {
  const std::string base = "file:" + escaped(path);
  return access == Database::Access::kUnchanging ? base + "?immutable=1" : base;
}

int flags_of(Database::Access access) {
  switch (access) {
    case Database::Access::kCreate:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case Database::Access::kWrite:
      return SQLITE_OPEN_READWRITE;
    case Database::Access::kUnchanging:
      break;
  }
  return SQLITE_OPEN_READONLY;
}

}  // namespace

Statement::Statement(sqlite3* database, const std::string& sql) : statement_(nullptr, sqlite3_finalize) {
  sqlite3_stmt* made = nullptr;
  const int result = sqlite3_prepare_v2(database, sql.c_str(), -1, &made, nullptr);
  statement_.reset(made);
  if (result != SQLITE_OK) fail(database);
}

Statement& Statement::bind(int number, int64_t value) {
  sqlite3_bind_int64(statement_.get(), number, value);
  return *this;
}

Statement& Statement::bind_text(int number, const std::string& value) {
  sqlite3_bind_text(statement_.get(), number, value.data(), int(value.size()), SQLITE_TRANSIENT);
  return *this;
}

Statement& Statement::bind_bytes(int number, std::string_view value) {
  sqlite3_bind_blob(statement_.get(), number, value.data(), int(value.size()), SQLITE_STATIC);
  return *this;
}

bool Statement::step() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) fail(sqlite3_db_handle(statement_.get()));
  return false;
}

void Statement::execute() {
  step();
  reset();
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string_view Statement::bytes(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  return bytes ? std::string_view(bytes, size_t(sqlite3_column_bytes(statement_.get(), column)))
               : std::string_view();
}

Database::Database(const std::string& path, Access access) : database_(nullptr, sqlite3_close) {
  sqlite3* opened = nullptr;
  const int result = sqlite3_open_v2(uri_of(path, access).c_str(), &opened,
                                     flags_of(access) | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (result != SQLITE_OK) throw DatabaseError(opened ? sqlite3_errmsg(opened) : "no memory");
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, access == Access::kUnchanging ? 0 : 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  // A file that is shorter than it says is read as far as it goes.
  if (access == Access::kUnchanging) execute("PRAGMA writable_schema=ON; PRAGMA cell_size_check=ON");
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(database_.get());
}

}  // namespace edgevo
