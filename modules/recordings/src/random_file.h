// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bytes at any place of a file that may be larger than the memory.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// A file open for reading.
class RandomFile {
 public:
  /// Throws InputError: no such file, a device, no permission.
  explicit RandomFile(std::string path);
  ~RandomFile();
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;

  /// Path as given.
  const std::string& path() const { return path_; }
  /// Size in bytes when it was opened.
  uint64_t size() const { return size_; }
  /// `length` bytes at `offset`, fewer at the end of the file; valid until the next call. Throws InputError
  /// for an error of the disk. Short pieces come from a window of 64 KB.
  std::string_view read(uint64_t offset, size_t length);

 private:
  size_t read_into(uint64_t offset, size_t length, std::vector<char>* bytes) const;

  std::string path_;
  int file_ = -1;
  uint64_t size_ = 0;
  std::vector<char> window_, large_;
  uint64_t window_at_ = 0;
};

}  // namespace edgevo
