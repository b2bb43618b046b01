// SPDX-License-Identifier: BSD-3-Clause
#include "colmap_database.h"

#include <sqlite3.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "colmap_models.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr char kMagic[] = "SQLite format 3";  // with its final zero, the first 16 bytes

using Database = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;
using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

[[noreturn]] void database_fail(const std::string& path, sqlite3* database) {
  throw InputError(path, std::string("is no database of COLMAP: ") + sqlite3_errmsg(database),
                   "give database.db, cameras.txt or cameras.bin");
}

Database open_database(const std::string& path) {
  sqlite3* handle = nullptr;
  const int result = sqlite3_open_v2(path.c_str(), &handle, SQLITE_OPEN_READONLY, nullptr);
  Database database(handle, sqlite3_close);
  if (result != SQLITE_OK) database_fail(path, handle);
  // A damaged schema must not be believed.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  return database;
}

Statement query(const std::string& path, sqlite3* database, const char* text) {
  sqlite3_stmt* handle = nullptr;
  const int result = sqlite3_prepare_v2(database, text, -1, &handle, nullptr);
  Statement statement(handle, sqlite3_finalize);
  if (result != SQLITE_OK) database_fail(path, database);
  return statement;
}

ColmapCamera camera_of_row(sqlite3_stmt* row, const std::string& where) {
  ColmapCamera camera;
  camera.model = sqlite3_column_int(row, 1);
  camera.width = sqlite3_column_double(row, 2);
  camera.height = sqlite3_column_double(row, 3);
  const void* const blob = sqlite3_column_blob(row, 4);
  const size_t bytes = size_t(sqlite3_column_bytes(row, 4));
  if (!blob || bytes % sizeof(double) != 0)
    throw InputError(where, "the parameters of a camera are damaged", "restore the file");
  camera.params.resize(bytes / sizeof(double));
  std::memcpy(camera.params.data(), blob, bytes);
  for (const double p : camera.params)
    if (!std::isfinite(p)) throw InputError(where, "a parameter is not a finite number", "restore the file");
  return camera;
}

CameraText with_doubt(CameraText text, bool is_prior) {
  if (!is_prior)
    text.doubt =
        "The focal length is COLMAP's initial guess: take cameras.bin of a reconstruction instead, which has "
        "the estimate.";
  return text;
}

}  // namespace

bool is_sqlite_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;  // a pipe may block
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  char head[sizeof kMagic];
  return file && std::fread(head, sizeof head, 1, file.get()) == 1 &&
         std::memcmp(head, kMagic, sizeof head) == 0;
}

NamedCameras colmap_database_cameras(const std::string& path) {
  const Database database = open_database(path);
  const Statement rows =
      query(path, database.get(),
            "SELECT camera_id, model, width, height, params, prior_focal_length FROM cameras ORDER BY 1");
  NamedCameras cameras;
  int result = sqlite3_step(rows.get());
  for (; result == SQLITE_ROW; result = sqlite3_step(rows.get())) {
    const ColmapCamera camera = camera_of_row(rows.get(), path);
    const bool is_prior = sqlite3_column_int(rows.get(), 5) != 0;
    cameras.push_back({std::to_string(sqlite3_column_int64(rows.get(), 0)),
                       [=] { return with_doubt(colmap_camera(camera, path), is_prior); }});
  }
  if (result != SQLITE_DONE) database_fail(path, database.get());
  return cameras;
}

}  // namespace edgevo
