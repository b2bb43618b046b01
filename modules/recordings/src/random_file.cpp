// SPDX-License-Identifier: BSD-3-Clause
#include "random_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr size_t kWindow = 1 << 16;  // bytes; heads of records are a hundred
constexpr const char* kRemedy = "check the file and its permissions";

}  // namespace

RandomFile::RandomFile(std::string path) : path_(std::move(path)) {
  struct stat status {};
  if (stat(path_.c_str(), &status) != 0)
    throw InputError(path_, std::string("cannot be read: ") + std::strerror(errno), kRemedy);
  if (!S_ISREG(status.st_mode)) throw InputError(path_, "is not a file", "give a recording");
  file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw InputError(path_, std::string("cannot be read: ") + std::strerror(errno), kRemedy);
  size_ = uint64_t(status.st_size);
}

RandomFile::~RandomFile() { close(file_); }

std::string_view RandomFile::read(uint64_t offset, size_t length) {
  if (offset >= size_) return {};
  length = size_t(std::min(uint64_t(length), size_ - offset));
  if (length > kWindow / 2) {
    const size_t got = read_into(offset, length, &large_);
    return {large_.data(), got};
  }
  if (offset < window_at_ || offset + length > window_at_ + window_.size()) {
    const size_t got = read_into(offset, kWindow, &window_);
    window_at_ = offset;
    window_.resize(got);
  }
  const size_t at = size_t(offset - window_at_);
  return {window_.data() + at, std::min(length, window_.size() - at)};
}

size_t RandomFile::read_into(uint64_t offset, size_t length, std::vector<char>* bytes) const {
  bytes->resize(length);
  size_t done = 0;
  while (done < length) {
    const ssize_t got = pread(file_, bytes->data() + done, length - done, off_t(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(path_, std::string("cannot be read: ") + std::strerror(errno), kRemedy);
    if (got == 0) break;
    done += size_t(got);
  }
  return done;
}

}  // namespace edgevo
