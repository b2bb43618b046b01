// SPDX-License-Identifier: BSD-3-Clause
#include "object_file.h"

#include <mrpt/serialization/CArchive.h>

#include <array>
#include <new>

namespace edgevo {
namespace {

constexpr int kLevel = 3;  // MRPT's own choice for rawlogs: most of the gain, little of the time
constexpr int kGzipWindowBits = 15 + 16;  // 15: largest window; 16: gzip header, without time or name

}  // namespace

ObjectFile::ObjectFile(const std::string& path) : file_(path) {
  if (deflateInit2(&gzip_, kLevel, Z_DEFLATED, kGzipWindowBits, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

ObjectFile::~ObjectFile() {
  try {
    if (is_open_) close();
  } catch (const std::exception&) {  // disk full: close() would have reported it
  }
  deflateEnd(&gzip_);
}

void ObjectFile::write(const mrpt::serialization::CSerializable& object) {
  memory_.clear();
  auto archive = mrpt::serialization::archiveFrom(memory_);
  archive << object;
  deflate_bytes(memory_.getRawBufferData(), size_t(memory_.getTotalBytesCount()), Z_NO_FLUSH);
}

void ObjectFile::close() {
  is_open_ = false;
  deflate_bytes(nullptr, 0, Z_FINISH);
  file_.close();
}

void ObjectFile::deflate_bytes(const void* bytes, size_t count, int flush) {
  std::array<unsigned char, 65536> out;
  gzip_.next_in = static_cast<Bytef*>(const_cast<void*>(bytes));
  gzip_.avail_in = uInt(count);
  do {
    gzip_.next_out = out.data();
    gzip_.avail_out = uInt(out.size());
    deflate(&gzip_, flush);
    file_.write({reinterpret_cast<const char*>(out.data()), out.size() - gzip_.avail_out});
  } while (gzip_.avail_out == 0);
}

}  // namespace edgevo
