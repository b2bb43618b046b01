#pragma once
// One process at a time in a place: a folder or file that is locked as long as this lives, or a process that
// has inherited it; a process that is killed leaves no lock behind.
#include <optional>
#include <string>

namespace edgevo::app {

class PlaceLock {
 public:
  /// Waits until no other holds `path` (a folder, or a file). On a file system without such locks there is
  /// none, and no wait.
  explicit PlaceLock(const std::string& path);
  ~PlaceLock();
  PlaceLock(PlaceLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  PlaceLock(const PlaceLock&) = delete;
  PlaceLock& operator=(const PlaceLock&) = delete;

  /// nullopt where another holds it now. Processes that this one starts hold it, too, until they end.
  static std::optional<PlaceLock> try_lock_for_all(const std::string& path);

 private:
  PlaceLock(const std::string& path, int open_flags, int lock_kind);
  int descriptor_ = -1;
  bool refused_ = false;
};

}  // namespace edgevo::app
