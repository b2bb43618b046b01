// SPDX-License-Identifier: BSD-3-Clause
#include "object_file.h"

#include <mrpt/serialization/CArchive.h>

#include <exception>
#include <new>

namespace edgevo {
namespace {

constexpr int kLevel = 3;  // MRPT's own choice for rawlogs: most of the gain, little of the time
constexpr size_t kMemberBytes = 1 << 18;

}  // namespace

ObjectFile::ObjectFile(const std::string& path)
    : file_(path), gzip_(libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor) {
  if (!gzip_) throw std::bad_alloc();
}

ObjectFile::~ObjectFile() {
  try {
    if (is_open_) close();
  } catch (const std::exception&) {  // disk full: close() would have reported it
  }
}

void ObjectFile::write(const mrpt::serialization::CSerializable& object) {
  auto archive = mrpt::serialization::archiveFrom(memory_);
  archive << object;
  if (memory_.getTotalBytesCount() >= kMemberBytes) write_member();
}

// An empty file has a member, too.
void ObjectFile::close() {
  is_open_ = false;
  write_member();
  file_.close();
}

void ObjectFile::write_member() {
  const size_t bytes = size_t(memory_.getTotalBytesCount());
  member_.resize(libdeflate_gzip_compress_bound(gzip_.get(), bytes));
  const size_t count = libdeflate_gzip_compress(gzip_.get(), memory_.getRawBufferData(), bytes,
                                                member_.data(), member_.size());
  memory_.clear();
  file_.write({member_.data(), count});
}

}  // namespace edgevo
