// SPDX-License-Identifier: BSD-3-Clause
#include "record_file.h"

#include <string_view>

#include "bytes.h"

namespace edgevo {
namespace {

// Bytes. A keyframe has a thousandth of that.
constexpr uint32_t kLargestRecord = 1u << 28;

// Begin of the first line in all versions.
constexpr std::string_view kAnyVersion = "edgevo ";

}  // namespace

RecordFile::RecordFile(const std::string& path) : file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
  is_whole_ = file_ && read(kRecoveryFirstLine.size(), &first_line_) && first_line_ == kRecoveryFirstLine;
}

bool RecordFile::is_of_another_version() const {
  return first_line_ != kRecoveryFirstLine && first_line_.compare(0, kAnyVersion.size(), kAnyVersion) == 0;
}

bool RecordFile::next(RecoveryRecord* record) {
  std::string head, tail;
  if (!is_whole_ || !read(sizeof(RecoveryKind) + sizeof(uint32_t), &head)) return false;
  ByteReader in(head);
  record->kind = in.value<RecoveryKind>();
  const auto size = in.value<uint32_t>();
  is_whole_ =
      size <= kLargestRecord && read(size, &record->content) && read(sizeof(uint32_t), &tail) &&
      ByteReader(tail).value<uint32_t>() == recovery_checksum(recovery_checksum(0, head), record->content);
  return is_whole_;
}

bool RecordFile::read(size_t size, std::string* bytes) {
  bytes->resize(size);
  return std::fread(bytes->data(), 1, size, file_.get()) == size;
}

}  // namespace edgevo
