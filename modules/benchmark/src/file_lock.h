#pragma once
// One process at a time in a folder or file, which is locked as long as this lives, or a process that
// has inherited it; a process that is killed leaves no lock behind.
#include <optional>
#include <string>

namespace edgevo {

class FileLock {
 public:
  /// Waits until no other holds `path` (a folder, or a file). On a file system without such locks there is
  /// none, and no wait.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(FileLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// nullopt where another holds it now. Processes that this one starts hold it, too, until they end.
  static std::optional<FileLock> try_lock_for_all(const std::string& path);

 private:
  FileLock(const std::string& path, int open_flags, int lock_kind);
  int descriptor_ = -1;
  bool refused_ = false;
};

}  // namespace edgevo
