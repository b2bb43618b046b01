#pragma once
// Room on the disk that is taken before a run and given back for its last words: a full disk must not cost
// the trajectory.
//
// A run fills a disk with images and maps, which are large; the trajectories, frames.csv and summary.yaml
// come last and are small. They are what a user would miss most, so their room is held from the start. The
// file that holds it has no name: it is gone when the process is, however that ends.
#include <cstddef>
#include <string>

namespace edgevo {

class SpaceReserve {
 public:
  /// Holds `bytes` on the disk of `folder`, where the file system can do that. Throws InputError when that
  /// much is not free.
  SpaceReserve(const std::string& folder, size_t bytes);
  ~SpaceReserve() { release(); }
  SpaceReserve(const SpaceReserve&) = delete;
  SpaceReserve& operator=(const SpaceReserve&) = delete;

  /// Gives the room back; more than once does nothing.
  void release();

 private:
  int file_ = -1;
};

}  // namespace edgevo
