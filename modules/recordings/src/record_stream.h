// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Records one after the other, in memory or in a part of a file.
#include <cstdint>
#include <string>
#include <string_view>

#include "random_file.h"

namespace edgevo {

/// Bytes that are read from the beginning to the end. What is read stays valid until the next call.
class RecordStream {
 public:
  virtual ~RecordStream() = default;
  /// Number of bytes that follow.
  virtual uint64_t remaining() const = 0;
  /// The next `length` bytes. Throws DamagedPart if fewer follow.
  std::string_view read(uint64_t length);
  /// The first `head` of the next `length` bytes; the rest is skipped. Throws DamagedPart.
  std::string_view read_head(uint64_t length, uint64_t head);
  /// Skips. Throws DamagedPart.
  void skip(uint64_t length);
  /// The next unsigned number in little endian.
  template <class T>
  T number() {
    return number_in<T>(read(sizeof(T)));
  }
  /// The number that the bytes begin with, in little endian; they must be enough.
  template <class T>
  static T number_in(std::string_view bytes) {
    T value = 0;
    for (size_t i = 0; i < sizeof(T); ++i) value = T(value | T(T(uint8_t(bytes[i])) << (8 * i)));
    return value;
  }

 protected:
  /// `where` opens messages.
  explicit RecordStream(std::string where) : where_(std::move(where)) {}

 private:
  virtual std::string_view take(uint64_t length, uint64_t head) = 0;
  void require(uint64_t length) const;

  std::string where_;
};

/// Bytes in memory that it owns.
class MemoryStream : public RecordStream {
 public:
  MemoryStream(std::string bytes, const std::string& where) : RecordStream(where), bytes_(std::move(bytes)) {}
  uint64_t remaining() const override { return bytes_.size() - at_; }

 private:
  std::string_view take(uint64_t length, uint64_t head) override {
    const std::string_view bytes(bytes_.data() + at_, size_t(head));
    at_ += size_t(length);
    return bytes;
  }

  std::string bytes_;
  size_t at_ = 0;
};

/// The bytes of a file from `begin` to before `end`; the file must outlive it.
class FileStream : public RecordStream {
 public:
  FileStream(RandomFile* file, uint64_t begin, uint64_t end, const std::string& where)
      : RecordStream(where), file_(file), at_(begin), end_(end) {}
  uint64_t remaining() const override { return end_ - at_; }
  /// Place in the file.
  uint64_t position() const { return at_; }

 private:
  std::string_view take(uint64_t length, uint64_t head) override {
    const std::string_view bytes = file_->read(at_, size_t(head));
    at_ += length;
    return bytes;
  }

  RandomFile* file_;
  uint64_t at_, end_;
};

}  // namespace edgevo
