// SPDX-License-Identifier: BSD-3-Clause
#include "message_reader.h"
#include "printable.h"

#include <algorithm>

namespace edgevo {

MessageReader::MessageReader(std::string_view bytes, Serialization serialization, const std::string& where)
    : bytes_(bytes), where_(where), is_cdr_(serialization == Serialization::kCdr) {
  if (serialization == Serialization::kOther) fail("its serialization is not read");
  if (!is_cdr_) return;
  const std::string_view head = take(4);
  const int kind = uint8_t(head[0]) << 8 | uint8_t(head[1]);
  const bool is_first = kind == 0 || kind == 1, is_second = kind == 6 || kind == 7;  // versions of CDR
  if (!is_first && !is_second) fail("its CDR is of kind " + std::to_string(kind) + ", which is not read");
  is_big_endian_ = kind % 2 == 0;
  largest_alignment_ = is_second ? 4 : 8;
  origin_ = at_;
}

void MessageReader::fail(const std::string& what) const {
  throw InputError(where_, "the message is damaged: " + what, "it is skipped");
}

void MessageReader::align(size_t size) {
  if (!is_cdr_) return;
  const size_t alignment = std::min(size, largest_alignment_);
  const size_t over = (at_ - origin_) % alignment;
  if (over > 0) take(alignment - over);
}

std::string_view MessageReader::take(size_t length) {
  if (length > bytes_.size() - at_) fail("it ends within a field");
  const std::string_view taken = bytes_.substr(at_, length);
  at_ += length;
  return taken;
}

std::string MessageReader::text() {
  std::string text(take(number<uint32_t>()));
  if (is_cdr_ && !text.empty() && text.back() == '\0') text.pop_back();
  return printable(text);
}

std::string_view MessageReader::bytes() { return take(number<uint32_t>()); }

size_t MessageReader::length(size_t min_bytes) {
  const size_t count = number<uint32_t>();
  if (count > (bytes_.size() - at_) / min_bytes) fail("a list is longer than it");
  return count;
}

std::vector<double> MessageReader::numbers() {
  std::vector<double> values(length(sizeof(double)));
  fill(values.data(), values.size());
  return values;
}

void MessageReader::fill(double* values, size_t count) {
  for (size_t i = 0; i < count; ++i) values[i] = number<double>();
}

MessageHeader MessageReader::header() {
  constexpr int64_t kNanoseconds = 1'000'000'000;
  MessageHeader header;
  if (is_ros1()) number<uint32_t>();  // sequence number
  const int64_t seconds = is_ros1() ? int64_t(number<uint32_t>()) : int64_t(number<int32_t>());
  header.stamp = Timestamp::from_nanoseconds(seconds * kNanoseconds + number<uint32_t>());
  header.frame = text();
  if (!header.frame.empty() && header.frame.front() == '/') header.frame.erase(0, 1);
  return header;
}

Eigen::Vector3d MessageReader::vector() {
  Eigen::Vector3d v;
  fill(v.data(), 3);
  return v;
}

SE3 MessageReader::pose() {
  const Eigen::Vector3d t = vector();
  Eigen::Vector4d q;
  fill(q.data(), 4);
  const bool is_rotation = q.allFinite() && q.norm() > 1e-6;
  return {is_rotation ? Eigen::Quaterniond(q[3], q[0], q[1], q[2]) : Eigen::Quaterniond::Identity(), t};
}

}  // namespace edgevo
