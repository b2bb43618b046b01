// SPDX-License-Identifier: BSD-3-Clause
#include "record_file.h"

#include <string_view>
#include <variant>

#include "bytes.h"

namespace edgevo {
namespace {

// Bytes. A keyframe has a thousandth of that.
constexpr uint32_t kLargestRecord = 1u << 28;
// Kind and size before the content.
constexpr size_t kHeadBytes = sizeof(RecoveryKind) + sizeof(uint32_t);

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
  if (is_whole_) begin_ = std::ftell(file_.get());
  if (!is_whole_ || !read(kHeadBytes, &head)) return false;
  ByteReader in(head);
  record->kind = in.value<RecoveryKind>();
  const auto size = in.value<uint32_t>();
  is_whole_ =
      size <= kLargestRecord && read(size, &record->content) && read(sizeof(uint32_t), &tail) &&
      ByteReader(tail).value<uint32_t>() == recovery_checksum(recovery_checksum(0, head), record->content);
  return is_whole_;
}

// A damaged length hides where the next record begins: the first place from where the checksum is right.
std::vector<RecoveryRecord> RecordFile::beyond_damage() {
  std::vector<RecoveryRecord> records;
  if (is_whole_ || !file_ || std::fseek(file_.get(), begin_, SEEK_SET) != 0) return records;
  std::string rest, part;
  while (read_some(&part)) rest += part;
  for (std::string_view left = rest; left.size() >= kHeadBytes + sizeof(uint32_t);) {
    ByteReader in(left);
    const auto kind = in.value<RecoveryKind>();
    const size_t size = in.value<uint32_t>();
    const bool is_event =
        kind >= kFirstEventRecord && kind < kFirstEventRecord + std::variant_size_v<MapEvent>;
    const size_t whole = kHeadBytes + size + sizeof(uint32_t);
    if (is_event && whole <= left.size() &&
        ByteReader(left.substr(kHeadBytes + size)).value<uint32_t>() ==
            recovery_checksum(0, left.substr(0, kHeadBytes + size))) {
      records.push_back({kind, std::string(left.substr(kHeadBytes, size))});
      left.remove_prefix(whole);
    } else {
      left.remove_prefix(1);
    }
  }
  return records;
}

bool RecordFile::read_some(std::string* bytes) {
  bytes->resize(size_t(1) << 20);
  bytes->resize(std::fread(bytes->data(), 1, bytes->size(), file_.get()));
  return !bytes->empty();
}

bool RecordFile::read(size_t size, std::string* bytes) {
  bytes->resize(size);
  return std::fread(bytes->data(), 1, size, file_.get()) == size;
}

}  // namespace edgevo
