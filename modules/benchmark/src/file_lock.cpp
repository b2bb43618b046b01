// SPDX-License-Identifier: BSD-3-Clause
#include "file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace edgevo {

FileLock::FileLock(const std::string& path, int open_flags, int lock_kind)
    : descriptor_(open(path.c_str(), O_RDONLY | open_flags)) {
  int result = -1;
  do result = descriptor_ < 0 ? 0 : flock(descriptor_, lock_kind);
  while (result != 0 && errno == EINTR);
  refused_ = result != 0 && errno == EWOULDBLOCK;
}

FileLock::FileLock(const std::string& path) : FileLock(path, O_CLOEXEC, LOCK_EX) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<FileLock> FileLock::try_lock_for_all(const std::string& path) {
  FileLock lock(path, 0, LOCK_EX | LOCK_NB);
  if (lock.refused_) return std::nullopt;
  return lock;
}

}  // namespace edgevo
