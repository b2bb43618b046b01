// SPDX-License-Identifier: BSD-3-Clause
#include "gz_archive.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr size_t kChunk = size_t(1) << 30;  // zlib counts in int

gzFile open_for_reading(const std::string& path) {
  const gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw InputError(path, std::string("cannot be read: ") + std::strerror(errno), "check the path");
  gzbuffer(file, 1 << 17);
  return file;
}

// gzread turns "the file ends inside the compressed data" into Z_BUF_ERROR and everything else that is wrong
// with the data into Z_DATA_ERROR.
std::string describe(gzFile file) {
  int code = Z_OK;
  const char* text = gzerror(file, &code);
  if (code == Z_OK || code == Z_STREAM_END) return {};
  if (code == Z_BUF_ERROR) return "the file is cut short";
  if (code == Z_ERRNO) return std::string("it cannot be read: ") + std::strerror(errno);
  return std::string("its compressed data are damaged (") +
         (code == Z_DATA_ERROR ? "checksum or code" : text) + ")";
}

}  // namespace

GzInputArchive::GzInputArchive(const std::string& path) : file_(open_for_reading(path)) {}

GzInputArchive::~GzInputArchive() { gzclose(file_); }

bool GzInputArchive::at_end() {
  const int byte = gzgetc(file_);
  if (byte < 0) return true;
  gzungetc(byte, file_);
  return false;
}

std::string GzInputArchive::damage() const {
  const std::string reason = describe(file_);
  if (reason.empty() && ran_short_) return "the file is cut short";
  return reason;
}

size_t GzInputArchive::read(void* buffer, size_t size) {
  auto* target = static_cast<char*>(buffer);
  for (size_t left = size; left > 0;) {
    const int count = gzread(file_, target, unsigned(std::min(left, kChunk)));
    if (count <= 0) {
      ran_short_ = true;
      throw std::runtime_error("end of the stream inside an object");
    }
    target += count;
    left -= size_t(count);
  }
  return size;
}

size_t GzInputArchive::write(const void*, size_t) { throw std::logic_error("opened for reading"); }

std::string gz_checksum_damage(const std::string& path, int64_t limit) {
  const gzFile file = open_for_reading(path);
  std::vector<char> buffer(1 << 17);
  while (gzread(file, buffer.data(), unsigned(buffer.size())) > 0 && gzoffset(file) < limit) {
  }
  int code = Z_OK;
  gzerror(file, &code);
  const std::string reason = code == Z_BUF_ERROR ? std::string() : describe(file);
  gzclose(file);
  return reason;
}

}  // namespace edgevo
