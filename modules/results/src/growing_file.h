// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file that grows while the program runs: appended bytes are passed to the operating system at once and
// survive the death of the program.
#include <string>
#include <string_view>

namespace edgevo {

/// An append-only file, locked while it is open.
class GrowingFile {
 public:
  GrowingFile() = default;
  ~GrowingFile() { close(); }
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Opens an empty file and locks it, so that no other program opens it meanwhile (see is_growing). Returns
  /// false on failure.
  [[nodiscard]] bool open(const std::string& path);
  /// Appends `bytes`. Returns false if the disk is full or the file is not open.
  [[nodiscard]] bool append(std::string_view bytes);
  void close();
  bool is_open() const { return file_ >= 0; }

  /// Whether a program has `path` open as a GrowingFile.
  static bool is_growing(const std::string& path);

 private:
  bool empty_it();

  int file_ = -1;
};

}  // namespace edgevo
