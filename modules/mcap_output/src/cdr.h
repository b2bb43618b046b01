// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// CDR, the form in which ROS 2 stores messages (OMG, Common Data Representation; DDS-RTPS 10.2): a head of
// four bytes, then the fields in their order, little endian, each number aligned to its own size counted from
// after the head. A string has its length, with the closing zero, before it; a sequence the number of its
// elements.
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace edgevo {

/// Appends fields of a message, in the order of its definition.
class CdrWriter {
 public:
  /// Begins a message.
  CdrWriter() : bytes_("\0\1\0\0", kHead) {}

  /// A bool, an integer, a float32 or a float64.
  template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
  void add(Number value) {
    align(sizeof value);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);  // x86-64 is little endian
  }
  /// A string.
  void add(std::string_view text) {
    add(uint32_t(text.size() + 1));
    bytes_.append(text).push_back('\0');
  }
  /// The number of elements of a sequence, which follow.
  void begin_sequence(size_t count) { add(uint32_t(count)); }
  /// A sequence of bytes.
  void add_bytes(std::string_view bytes) {
    begin_sequence(bytes.size());
    bytes_.append(bytes);
  }

  /// The message. Call once.
  std::string take() { return std::move(bytes_); }

 private:
  static constexpr size_t kHead = 4;
  void align(size_t size) { bytes_.resize(kHead + (bytes_.size() - kHead + size - 1) / size * size); }

  std::string bytes_;
};

}  // namespace edgevo
