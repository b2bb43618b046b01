// SPDX-License-Identifier: BSD-3-Clause
#include "whole_pages.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace edgevo {
namespace {

constexpr const char* kName = "edgevo_whole_pages";
constexpr int kSector = 4096;  // bytes

struct WholePagesFile {
  sqlite3_file base;
  int file;
  sqlite3_int64 size;
};

WholePagesFile* of(sqlite3_file* file) { return reinterpret_cast<WholePagesFile*>(file); }

int close_file(sqlite3_file* file) { return close(of(file)->file), SQLITE_OK; }

// What lies beyond the end is zero, as SQLite requires.
int read_file(sqlite3_file* file, void* bytes, int count, sqlite3_int64 at) {
  const sqlite3_int64 there = std::clamp(of(file)->size - at, sqlite3_int64(0), sqlite3_int64(count));
  ssize_t done = 0;
  while (done < there) {
    const ssize_t got =
        pread(of(file)->file, static_cast<char*>(bytes) + done, size_t(there - done), off_t(at + done));
    if (got < 0) return SQLITE_IOERR_READ;
    if (got == 0) break;
    done += got;
  }
  std::memset(static_cast<char*>(bytes) + done, 0, size_t(count - done));
  return done == count ? SQLITE_OK : SQLITE_IOERR_SHORT_READ;
}

int write_file(sqlite3_file*, const void*, int, sqlite3_int64) { return SQLITE_READONLY; }
int truncate_file(sqlite3_file*, sqlite3_int64) { return SQLITE_READONLY; }
int accept(sqlite3_file*, int) { return SQLITE_OK; }
int get_size(sqlite3_file* file, sqlite3_int64* size) { return *size = of(file)->size, SQLITE_OK; }
int get_reserved(sqlite3_file*, int* is_reserved) { return *is_reserved = 0, SQLITE_OK; }
int control(sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; }
int sector_size(sqlite3_file*) { return kSector; }
int characteristics(sqlite3_file*) { return SQLITE_IOCAP_IMMUTABLE; }

const sqlite3_io_methods kMethods{1,       close_file,  read_file,       write_file, truncate_file,
                                  accept,  get_size,    accept,          accept,     get_reserved,
                                  control, sector_size, characteristics, nullptr,    nullptr,
                                  nullptr, nullptr,     nullptr,         nullptr};

// The first bytes of a database hold the size of its pages, 1 for 65536.
sqlite3_int64 page_size(int file) {
  constexpr off_t kPlace = 16;
  uint8_t bytes[2] = {0, 0};
  if (pread(file, bytes, 2, kPlace) != 2) return 1;
  const int size = bytes[0] << 8 | bytes[1];
  return size == 1 ? 65536 : std::max(size, 1);
}

int open_file(sqlite3_vfs*, const char* path, sqlite3_file* opened, int flags, int* out_flags) {
  opened->pMethods = nullptr;
  if (!path || !(flags & SQLITE_OPEN_MAIN_DB)) return SQLITE_CANTOPEN;
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (file < 0) return SQLITE_CANTOPEN;
  if (fstat(file, &status) != 0) return close(file), SQLITE_CANTOPEN;
  of(opened)->file = file;
  of(opened)->size = status.st_size - status.st_size % page_size(file);
  opened->pMethods = &kMethods;
  if (out_flags) *out_flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB;
  return SQLITE_OK;
}

// No other file belongs to it: nothing changes it.
int is_there(sqlite3_vfs*, const char*, int, int* answer) { return *answer = 0, SQLITE_OK; }

sqlite3_vfs make_vfs() {
  sqlite3_vfs vfs = *sqlite3_vfs_find(nullptr);
  vfs.szOsFile = sizeof(WholePagesFile);
  vfs.zName = kName;
  vfs.pNext = nullptr;
  vfs.xOpen = open_file;
  vfs.xAccess = is_there;
  return vfs;
}

}  // namespace

const char* whole_pages_vfs() {
  static sqlite3_vfs vfs = make_vfs();
  static const int registered = sqlite3_vfs_register(&vfs, 0);
  return registered == SQLITE_OK ? kName : nullptr;
}

}  // namespace edgevo
