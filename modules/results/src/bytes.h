// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Values as bytes in this machine's layout and back, for files that are read again on the same machine only.
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace edgevo {

/// Appends values and strings to a string of bytes.
class ByteWriter {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void text(std::string_view t) {
    value(uint32_t(t.size()));
    bytes_ += t;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Past the end it returns zeros and is no longer ok().
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T value() {
    T v{};
    if (take(sizeof v)) std::memcpy(&v, taken_.data(), sizeof v);
    return v;
  }
  std::string text() {
    const auto size = value<uint32_t>();
    return take(size) ? std::string(taken_) : std::string();
  }
  /// Whether all values read so far were complete.
  bool ok() const { return ok_; }

 private:
  bool take(size_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return false;
    taken_ = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }

  std::string_view rest_, taken_;
  bool ok_ = true;
};

}  // namespace edgevo
