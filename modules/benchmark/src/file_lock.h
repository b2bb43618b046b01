// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lock on a folder or file for one process at a time, held until the object and all processes that have
// inherited it are gone; a killed process leaves no lock behind.
#include <optional>
#include <string>

namespace edgevo {

/// An exclusive lock on a folder or file.
class FileLock {
 public:
  /// Waits for the lock on `path` (a folder or a file). On a file system without locks it neither locks nor
  /// waits.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(FileLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Lock on `path`, or nullopt if another process holds it. Child processes inherit the lock until they end.
  static std::optional<FileLock> try_lock_for_all(const std::string& path);

 private:
  FileLock(const std::string& path, int open_flags, int lock_kind);
  int descriptor_ = -1;
  bool refused_ = false;
};

}  // namespace edgevo
