// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Values as bytes, least significant byte first, and pieces of such bytes that are compressed one by one:
// values of one kind, next to each other, compress best.
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace edgevo {

/// A value as its bytes in the order of this machine, which is that of the file on all machines that edgevo
/// is built for.
template <class T>
void append_value(std::string* bytes, const T& v) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes->append(reinterpret_cast<const char*>(&v), sizeof v);
}

/// Reads what append_value() wrote. Past the end it returns zeros and is no longer ok().
class ValueReader {
 public:
  /// `bytes` must outlive it.
  explicit ValueReader(std::string_view bytes) : rest_(bytes) {}

  /// The next value.
  template <class T>
  T value() {
    T v{};
    if (const std::string_view taken = take(sizeof v); !taken.empty())
      std::memcpy(&v, taken.data(), sizeof v);
    return v;
  }
  /// The next bytes; empty if there are not so many.
  std::string_view take(size_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return {};
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  /// Whether all that was read was there.
  bool ok() const { return ok_; }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

/// Bytes of a row, from pieces that are compressed by Zstandard, each with a checksum.
class PieceWriter {
 public:
  /// Appends a piece.
  void add(std::string_view bytes);
  /// Appends values of 16 bits, as a piece of the lower bytes and one of the upper ones.
  void add(const std::vector<uint16_t>& values);
  /// Appends small whole numbers, as two pieces: a byte each, and what does not fit into one.
  void add_small(const std::vector<int>& values);
  /// All pieces.
  const std::string& bytes() const { return packed_; }

 private:
  std::string packed_;
};

/// Reads what a PieceWriter wrote. Damage is returned by ok(); what was read is then of no use.
class PieceReader {
 public:
  /// `bytes` must outlive it.
  explicit PieceReader(std::string_view bytes) : packed_(bytes) {}

  /// The next piece.
  std::string next();
  /// The next `count` values of 16 bits.
  std::vector<uint16_t> next_16(size_t count);
  /// The next `count` small numbers.
  std::vector<int> next_small(size_t count);
  /// Whether all pieces so far were there, undamaged and of their sizes.
  bool ok() const { return ok_; }

 private:
  ValueReader packed_;
  bool ok_ = true;
};

}  // namespace edgevo
