// SPDX-License-Identifier: BSD-3-Clause
#include "growing_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace edgevo {

bool GrowingFile::open(const std::string& path) {
  close();
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  // The system releases the lock however the program ends.
  if (file_ >= 0 && (flock(file_, LOCK_EX | LOCK_NB) != 0 || !empty_it())) close();
  return is_open();
}

bool GrowingFile::empty_it() { return lseek(file_, 0, SEEK_END) <= 0 || ftruncate(file_, 0) == 0; }

bool GrowingFile::append(std::string_view bytes) {
  while (is_open() && !bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(size_t(written));
  }
  return is_open();
}

void GrowingFile::close() {
  if (is_open()) ::close(std::exchange(file_, -1));
}

bool GrowingFile::is_growing(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  const bool is_locked = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return is_locked;
}

}  // namespace edgevo
